/* progress.h - the time, and how far a picture is, on stderr: a line that changes on a terminal, one for every tenth
 * elsewhere. */
#ifndef COMMON_PROGRESS_H
#define COMMON_PROGRESS_H

#include <stdint.h>

struct progress {
	const char *label;
	uint64_t total;
	double start;
	int shown, terminal;
};

/* Since some moment in the past. */
double seconds_now(void);

void progress_start(struct progress *progress, const char *label, uint64_t total);

/* context: a struct progress. */
void progress_show(void *context, uint64_t done);

#endif
