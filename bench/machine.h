/* machine.h - the head of a benchmark's output: what it ran on and what was compiled. bench_devices_open adds the
 * devices. */
#ifndef LOBE_BENCH_MACHINE_H
#define LOBE_BENCH_MACHINE_H

#include <stdio.h>

/* Processor, compiler, date, commit, and how busy the machine already is. */
void bench_print_machine(FILE *to);

/* The processor's name, or its architecture. */
void bench_processor_name(char *text, size_t size);

/* Bytes of memory that nobody uses. */
double bench_memory(void);

/* Runs a shell command and keeps the last line of its output, without the line's end. 0: it failed or wrote nothing. */
int bench_command(const char *command, char *line, size_t size);

/* Says on stderr how far what is: i of n; what NULL: takes that back. Where stderr is no terminal, a line for i = 0. */
void bench_progress(const char *what, size_t i, size_t n);

/* Makes the folders above a file, and opens it for writing. NULL after a failure, which it reports. */
FILE *bench_create_file(const char *path);

#endif
