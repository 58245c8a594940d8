/* opencl_split.c - how a batch is cut between devices. */
#include "opencl_split.h"

void lobe_cl_split(const lobe_cl_measure *m, size_t count, size_t n, size_t *to)
{
	double total = 0.0, sum = 0.0;
	size_t fastest = 0;
	int known = 1;
	for (size_t i = 0; i < count; i++) {
		known = known && m[i].speed > 0.0;
		total += m[i].speed;
		fastest = m[i].speed > m[fastest].speed ? i : fastest;
	}
	to[0] = 0;
	for (size_t i = 0; i < count; i++) {
		if (n < count * LOBE_CL_SPLIT_PART) {
			to[i + 1] = i < fastest ? 0 : n;
			continue;
		}
		sum += known ? m[i].speed / total : 1.0 / (double)count;
		/* What is left for the devices after this one is a part for each at least. */
		const size_t least = to[i] + LOBE_CL_SPLIT_PART;
		const size_t last = (n / LOBE_CL_SPLIT_PART - (count - 1 - i)) * LOBE_CL_SPLIT_PART;
		size_t end = (size_t)((double)n * sum) / LOBE_CL_SPLIT_PART * LOBE_CL_SPLIT_PART;
		end = end < least ? least : end;
		to[i + 1] = i + 1 == count ? n : (end > last ? last : end);
	}
}

/* The mean of what was known and what is new, so that one slow moment does not count for long. */
void lobe_cl_measure_add(lobe_cl_measure *m, size_t n, double seconds)
{
	const double speed = (double)n / (seconds > 1e-9 ? seconds : 1e-9);
	if (m->speed > 0.0 && !m->first) {
		m->speed = 0.5 * (m->speed + speed);
	} else {
		m->first = m->speed == 0.0;
		m->speed = speed;
	}
}
