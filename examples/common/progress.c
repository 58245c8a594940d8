/* progress.c - see progress.h. */
#define _POSIX_C_SOURCE 200809L
#include "progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

double seconds_now(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void progress_start(struct progress *progress, const char *label, uint64_t total)
{
	progress->label = label;
	progress->total = total;
	progress->start = seconds_now();
	progress->shown = 0;
	progress->terminal = isatty(STDERR_FILENO);
}

void progress_show(void *context, uint64_t done)
{
	struct progress *p = context;
	const int percent = p->total ? (int)(100 * done / p->total) : 100;
	if (percent == p->shown || (!p->terminal && percent / 10 == p->shown / 10))
		return;
	p->shown = percent;
	const double passed = seconds_now() - p->start;
	const double left = done ? passed * (double)(p->total - done) / (double)done : 0.0;
	fprintf(stderr, p->terminal ? "\r%-32.32s %3d %%, %.0f s left \033[K" : "%-32.32s %3d %%, %.0f s left\n",
		p->label, percent, left);
	if (p->terminal && percent == 100)
		fputs("\r\033[K", stderr);
}
