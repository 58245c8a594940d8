/* hand.c - the race of the library against loops without it, on one thread. */
#include "hand.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "machine.h"
#include "race.h"

typedef struct {
	bench_hand_loop loop;
	lobe_ggx_conductor p;
	lobe_batch batch;
} hand;

static int run(const void *context)
{
	const hand *h = context;
	h->loop(&h->p, &h->batch);
	return 1;
}

/* The loops of the instruction set that the device runs. */
static bench_hand_loop hand_loop(const lobe_device *device, int sample)
{
	const char *const name = lobe_device_name(device);
#ifdef LOBE_X86
	if (strstr(name, "avx512"))
		return sample ? bench_hand_sample_avx512 : bench_hand_eval_avx512;
	if (strstr(name, "avx2"))
		return sample ? bench_hand_sample_avx2 : bench_hand_eval_avx2;
#endif
	(void)name;
	return sample ? bench_hand_sample_baseline : bench_hand_eval_baseline;
}

/* Largest difference of a result, relative to 1 or to the result; so that nobody races something else. */
static double difference(const lobe_batch *b, hand *h)
{
	double worst = 0.0;
	const float *const out = b->pdf ? b->pdf : b->weight[1];
	float kept[256];
	const size_t n = b->count < 256 ? b->count : 256;
	memcpy(kept, out, n * sizeof *kept);
	run(h);
	for (size_t i = 0; i < n; i++) {
		const double d = fabs((double)kept[i] - (double)out[i]) / fmax(1.0, fabs((double)kept[i]));
		worst = d > worst ? d : worst;
	}
	return worst;
}

static void put(FILE *csv, int verb, size_t n, const char *const *names, const bench_racer *racer, int count,
		size_t runs)
{
	for (int i = 0; i < count; i++) {
		printf("%-9s %9zu %-24s %9.1f %9.1f - %-9.1f %7.3f %7.3f - %.3f\n", bench_verb_name(verb), n, names[i],
		       racer[i].rate.median, racer[i].rate.low, racer[i].rate.high, racer[i].ratio.median,
		       racer[i].ratio.low, racer[i].ratio.high);
		fprintf(csv, "%s,%zu,%s,%zu,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f\n", bench_verb_name(verb), n, names[i], runs,
			racer[i].rate.median, racer[i].rate.low, racer[i].rate.high, racer[i].ratio.median,
			racer[i].ratio.low, racer[i].ratio.high);
	}
}

static int opencl_row(FILE *csv, const bench_arrays *a, int verb, size_t n, size_t runs)
{
	static const char *const names[] = {"the library, OpenCL", "a kernel by hand"};
	bench_racer racer[2];
	const int done = bench_hand_opencl(a, verb, n, runs, racer);
	if (done > 0)
		put(csv, verb, n, names, racer, 2, runs);
	else if (done < 0)
		printf("%-9s %9zu %-24s skipped: %s\n", bench_verb_name(verb), n, names[1], lobe_error_message());
	return done != 0;
}

static int row(FILE *csv, lobe_device *device, const bench_arrays *a, int verb, size_t n, size_t runs)
{
	static const char *const names[] = {"the library", "a loop over the header", "scalar C with libm"};
	const int sample = bench_verb_samples(verb);
	const lobe_bsdf gold = bench_lobe_material(BENCH_LOBE_GGX_CONDUCTOR);
	bench_shading shading = {NULL, verb, bench_batch(a, verb, n)};
	hand by_hand = {hand_loop(device, sample), gold.as.ggx_conductor, shading.batch};
	hand naive = {sample ? bench_naive_sample : bench_naive_eval, gold.as.ggx_conductor, shading.batch};
	if (bench_scene_create(&shading.scene, device, BENCH_LOBE_GGX_CONDUCTOR) != LOBE_OK)
		return 0;
	bench_racer racer[3] = {bench_shading_racer(&shading, 1),
				{.run = run, .context = &by_hand, .elements = (double)n, .base = 1},
				{.run = run, .context = &naive, .elements = (double)n, .base = 1}};
	int ok = bench_run(shading.scene, verb, &shading.batch) == LOBE_OK;
	if (ok && difference(&shading.batch, &by_hand) != 0.0) {
		fprintf(stderr, "throughput: the loop over the header gives other bits than the library\n");
		ok = 0;
	}
	ok = ok && bench_race(racer, 3, runs);
	if (ok)
		put(csv, verb, n, names, racer, 3, runs);
	lobe_scene_destroy(shading.scene);
	return ok;
}

int bench_hand(size_t n, size_t runs, const char *path)
{
	lobe_device *device = NULL;
	bench_arrays a = {0};
	FILE *csv = bench_create_file(path);
	int ok = csv && bench_arrays_create(&a, n) && lobe_device_open(&device, "native:1") == LOBE_OK;
	if (csv && !ok)
		fprintf(stderr, "throughput: out of memory, or no native device\n");
	if (ok) {
		printf("\nggx_conductor on one thread, by the library and without it; x: against the loop over the "
		       "header, which\n"
		       "has the library's compiler options and gives the same bits. Intervals: 95 %% of the "
		       "median.\n\n");
		printf("%-9s %9s %-24s %9s %21s %7s %15s\n", "verb", "elements", "by", "M/s", "", "x", "");
		fputs("verb,elements,by,runs,median_melements_per_s,low,high,ratio,ratio_low,ratio_high\n", csv);
	}
	for (int i = 0; ok && i < 4; i++)
		ok = row(csv, device, &a, i % 2 ? BENCH_SAMPLE : BENCH_EVAL_PDF, i < 2 || n < 4096 ? n : 4096, runs);
	for (int i = 0; ok && i < 2; i++)
		ok = opencl_row(csv, &a, i ? BENCH_SAMPLE : BENCH_EVAL_PDF, n, runs);
	lobe_device_close(device);
	bench_arrays_destroy(&a);
	return csv && fclose(csv) == 0 && ok;
}
