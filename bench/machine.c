/* machine.c - the head of a benchmark's output. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

#include "../examples/common/folders.h"
#include "../examples/common/processors.h"
#include "machine.h"

#if defined(__clang__)
#define COMPILER "clang " __clang_version__
#elif defined(__GNUC__)
#define COMPILER "gcc " __VERSION__
#else
#define COMPILER "unknown"
#endif

int bench_command(const char *command, char *line, size_t size)
{
	char next[1024];
	FILE *out = popen(command, "r");
	line[0] = '\0';
	if (!out)
		return 0;
	while (fgets(next, sizeof next, out)) {
		next[strcspn(next, "\n")] = '\0';
		snprintf(line, size, "%s", next);
	}
	return pclose(out) == 0 && line[0];
}

/* What follows the colon in the first line of a file that begins with key. */
static int find_line(const char *path, const char *key, char *value, size_t size)
{
	char line[1024];
	int found = 0;
	FILE *file = fopen(path, "r");
	while (file && !found && fgets(line, sizeof line, file)) {
		const char *colon = strchr(line, ':');
		found = colon && strncmp(line, key, strlen(key)) == 0;
		if (found)
			snprintf(value, size, "%.*s", (int)strcspn(colon + 1, "\n"), colon + 1);
	}
	if (file)
		fclose(file);
	return found;
}

double bench_memory(void)
{
	char text[256];
	if (find_line("/proc/meminfo", "MemAvailable", text, sizeof text))
		return 1024.0 * strtod(text, NULL);
	return (double)sysconf(_SC_PAGESIZE) * 65536.0;
}

void bench_processor_name(char *text, size_t size)
{
	char line[256];
	struct utsname system;
	if (find_line("/proc/cpuinfo", "model name", line, sizeof line))
		snprintf(text, size, "%s", line + strspn(line, " "));
	else
		snprintf(text, size, "%s", uname(&system) >= 0 ? system.machine : "unknown");
}

void bench_print_machine(FILE *to)
{
	char text[1024];
	struct utsname system;
	const time_t now = time(NULL);
	const int known = uname(&system) >= 0;
	bench_processor_name(text, sizeof text);
	fprintf(to, "processor  %s, %zu for this process\n", text, processor_count());
	if (known)
		fprintf(to, "system     %s %s %s\n", system.sysname, system.release, system.machine);
	fprintf(to, "compiler   %s\n", COMPILER);
	strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", gmtime(&now));
	fprintf(to, "date       %s\n", text);
	if (bench_command("git describe --always --dirty --abbrev=12 2>/dev/null", text, sizeof text))
		fprintf(to, "commit     %s\n", text);
	if (bench_command("cut -d' ' -f1-3 /proc/loadavg 2>/dev/null", text, sizeof text))
		fprintf(to, "load       %s before the start (processes, mean of the last 1, 5 and 15 minutes)\n", text);
}

void bench_progress(const char *what, size_t i, size_t n)
{
	if (isatty(STDERR_FILENO)) {
		fprintf(stderr, "\r%60s\r", "");
		if (what)
			fprintf(stderr, "%s: %zu of %zu", what, i, n);
	} else if (what && i == 0) {
		fprintf(stderr, "%s, %zu runs\n", what, n);
	}
}

FILE *bench_create_file(const char *path)
{
	make_folders_of(path); /* where that fails, so does fopen */
	FILE *const file = fopen(path, "w");
	if (!file)
		fprintf(stderr, "bench: %s: %s\n", path, strerror(errno));
	return file;
}
