#include "measured.h"

#include <stdio.h>

static char outside[160];

void measured(const char *what, double value, double bound)
{
	const int ok = value <= bound;
	printf("  %-60s %11.4g  <= %11.4g%s\n", what, value, bound, ok ? "" : "  OUTSIDE");
	if (!ok && outside[0] == '\0')
		snprintf(outside, sizeof outside, "%s: %g > %g", what, value, bound);
}

void measured_reset(void) { outside[0] = '\0'; }

const char *measured_outside(void) { return outside; }
