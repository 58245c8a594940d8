/* long_real.c - the error of every function of one argument in core/real.h over all 2^32 floats.
 *
 * Each value is measured against libm in double. In each 65536 floats the worst one and one at random are measured
 * again with MPFR; the maximum reported is MPFR's, and the two measures must agree. Usage: long_real [function ...] */
#define _POSIX_C_SOURCE 200809L

#include "real_reference.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#define THREADS          2
#define CHUNK            65536u
#define CHUNKS           65536u
#define SCREEN_TOLERANCE 1e-6

typedef struct {
	double ulp;
	float at;
	uint64_t beyond_1;
	uint64_t asymmetric;
	double screen_error;
} measure;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static const real_function *function;
static uint32_t next_chunk;
static measure total;

static float float_of(uint32_t bits)
{
	float x;
	memcpy(&x, &bits, sizeof x);
	return x;
}

/* The error of chunk[i] with MPFR; keeps the worst. */
static void confirm(measure *m, mpfr_t exact, float x, float got, double screened)
{
	function->exact(exact, x);
	const double ulp = ulp_error(got, exact);
	const double difference = ulp == screened ? 0 : fabs(ulp - screened) / (ulp > 1 ? ulp : 1);
	if (difference > m->screen_error)
		m->screen_error = difference;
	if (ulp > m->ulp || isnan(ulp)) {
		m->ulp = ulp;
		m->at = x;
	}
}

static void measure_chunk(measure *m, mpfr_t exact, uint32_t chunk, float *x, float *got, float *mirrored)
{
	for (uint32_t i = 0; i < CHUNK; i++)
		x[i] = float_of(chunk * CHUNK + i);
	function->row(CHUNK, x, got);
	if (function->symmetry && chunk >= CHUNKS / 2) {
		for (uint32_t i = 0; i < CHUNK; i++)
			x[i] = -x[i];
		function->row(CHUNK, x, mirrored);
		for (uint32_t i = 0; i < CHUNK; i++) {
			const float expected = function->symmetry > 0 ? mirrored[i] : -mirrored[i];
			m->asymmetric += expected != got[i] && !(isnan(expected) && isnan(got[i]));
		}
		return;
	}
	const uint32_t random = (chunk * 2654435761u) >> 16;
	double worst = -1, random_ulp = 0;
	uint32_t worst_at = 0;
	for (uint32_t i = 0; i < CHUNK; i++) {
		const double ulp = ulp_error_double(got[i], function->reference((double)x[i]));
		m->beyond_1 += ulp > 1;
		if (ulp > worst) {
			worst = ulp;
			worst_at = i;
		}
		if (i == random)
			random_ulp = ulp;
	}
	confirm(m, exact, x[worst_at], got[worst_at], worst);
	confirm(m, exact, x[random], got[random], random_ulp);
}

static void *work(void *unused)
{
	static float buffers[THREADS][3][CHUNK];
	static int threads_started;
	measure m = {-1, 0, 0, 0, 0};
	mpfr_t exact;
	mpfr_init2(exact, REFERENCE_BITS);
	pthread_mutex_lock(&lock);
	float(*buffer)[CHUNK] = buffers[threads_started++ % THREADS];
	while (next_chunk < CHUNKS) {
		const uint32_t chunk = next_chunk++;
		if (chunk % (CHUNKS / 16) == 0) {
			fprintf(stderr, "\r%s: %u/16 ", function->name, chunk / (CHUNKS / 16));
			fflush(stderr);
		}
		pthread_mutex_unlock(&lock);
		measure_chunk(&m, exact, chunk, buffer[0], buffer[1], buffer[2]);
		pthread_mutex_lock(&lock);
	}
	if (m.ulp > total.ulp) {
		total.ulp = m.ulp;
		total.at = m.at;
	}
	total.beyond_1 += m.beyond_1;
	total.asymmetric += m.asymmetric;
	total.screen_error = m.screen_error > total.screen_error ? m.screen_error : total.screen_error;
	pthread_mutex_unlock(&lock);
	mpfr_clear(exact);
	mpfr_free_cache();
	return unused;
}

static int run(void)
{
	pthread_t threads[THREADS];
	measure start = {-1, 0, 0, 0, 0};
	total = start;
	next_chunk = 0;
	for (int i = 0; i < THREADS; i++)
		if (pthread_create(&threads[i], NULL, work, NULL)) {
			fprintf(stderr, "cannot start a thread\n");
			exit(2);
		}
	for (int i = 0; i < THREADS; i++)
		pthread_join(threads[i], NULL);
	/* Of a symmetric function only the positive half was measured; the negative half has the same bits. */
	const unsigned long long beyond = total.beyond_1 * (function->symmetry ? 2 : 1);
	const int ok = total.ulp <= function->bound && !total.asymmetric && total.screen_error <= SCREEN_TOLERANCE;
	fprintf(stderr, "\r                    \r");
	printf("%-8s %9.4f  %-16a %-15.9g %11llu  %5.2f  %s\n", function->name, total.ulp, (double)total.at,
	       (double)total.at, beyond, function->bound, ok ? "ok" : "FAILED");
	if (total.asymmetric)
		printf("  %llu floats break the symmetry\n", (unsigned long long)total.asymmetric);
	if (total.screen_error > SCREEN_TOLERANCE)
		printf("  libm and MPFR disagree by %g ulp\n", total.screen_error);
	fflush(stdout);
	return ok;
}

int main(int argc, char **argv)
{
	unsigned passed = 0, failed = 0;
	printf("function   max ulp  at x                             beyond 1 ulp  bound\n");
	for (size_t i = 0; i < REAL_FUNCTION_COUNT; i++) {
		int wanted = argc < 2;
		for (int k = 1; k < argc; k++)
			wanted |= !strcmp(argv[k], real_functions[i].name);
		if (!wanted)
			continue;
		function = &real_functions[i];
		if (run())
			passed++;
		else
			failed++;
	}
	printf("%u Tests %u Failures 0 Ignored\n", passed + failed, failed);
	return failed != 0;
}
