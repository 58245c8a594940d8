/* test_stability.c - stiff and extreme corners of every lobe: what must never come out is counted, errors are held to
 * what the inputs allow, and the sweep finds a defect that is planted. The report's section "stability" (make report)
 * is the same sweep at length, with its plots. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured.h"
#include "stability_studies.h"
#include "support.h"

#include "unity.h"

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_EQUAL_STRING_MESSAGE("", measured_outside(), "measured"); }

/* --- counts ------------------------------------------------------------------------------------------------------------ */

/* Batches are handed out to threads by number: the same ones, whatever the threads. */
typedef struct {
	lobe_uint kind;
	uint64_t next, batches;
	stability_counts counts;
	int failed;
	pthread_mutex_t lock;
} counting;

static void *count_batches(void *context)
{
	counting *job = context;
	for (;;) {
		stability_counts c = {0, 0, 0, 0, 0};
		pthread_mutex_lock(&job->lock);
		const uint64_t batch = job->next++;
		pthread_mutex_unlock(&job->lock);
		if (batch >= job->batches)
			return NULL;
		const int failed = stability_count(job->kind, batch, &c);
		pthread_mutex_lock(&job->lock);
		job->failed |= failed;
		job->counts.elements += c.elements;
		job->counts.kept += c.kept;
		job->counts.non_finite += c.non_finite;
		job->counts.negative += c.negative;
		job->counts.pdf_differs += c.pdf_differs;
		pthread_mutex_unlock(&job->lock);
	}
}

enum { THREADS = 2 };

/* In make test-long 10^8 elements and more, each an eval, a pdf and a sample; lobes that choose at run time take a
 * part. */
static uint64_t batches_of(lobe_uint kind)
{
	if (kind == LOBE_KIND_MICROFACET_DIFFUSE)
		return test_long() ? 20 : 1;
	if (kind >= LOBE_KIND_MICROFACET_CONDUCTOR)
		return test_long() ? 60 : 1;
	return test_long() ? 250 : 2;
}

static void test_nothing_that_must_not_come_out(void)
{
	stability_counts all = {0, 0, 0, 0, 0};
	for (size_t l = 0; l < STABILITY_LOBES; l++) {
		counting job;
		pthread_t threads[THREADS];
		memset(&job, 0, sizeof job);
		job.kind = stability_kinds[l];
		job.batches = batches_of(job.kind);
		pthread_mutex_init(&job.lock, NULL);
		for (int t = 0; t < THREADS; t++)
			TEST_ASSERT_EQUAL_INT(0, pthread_create(&threads[t], NULL, count_batches, &job));
		for (int t = 0; t < THREADS; t++)
			pthread_join(threads[t], NULL);
		pthread_mutex_destroy(&job.lock);
		TEST_ASSERT_EQUAL_INT(0, job.failed);
		if (test_long()) {
			printf("  %-22s %10llu elements, %10llu samples\n", stability_lobe_names[l],
			       (unsigned long long)job.counts.elements, (unsigned long long)job.counts.kept);
			fflush(stdout);
		}
		all.elements += job.counts.elements;
		all.kept += job.counts.kept;
		all.non_finite += job.counts.non_finite;
		all.negative += job.counts.negative;
		all.pdf_differs += job.counts.pdf_differs;
	}
	printf("  %llu elements, %llu samples: %llu results not finite, %llu negative, %llu samples whose pdf is not "
	       "pdf()\n",
	       (unsigned long long)all.elements, (unsigned long long)all.kept, (unsigned long long)all.non_finite,
	       (unsigned long long)all.negative, (unsigned long long)all.pdf_differs);
	TEST_ASSERT_GREATER_THAN_UINT64(test_long() ? 100000000u : 800000u, all.elements);
	TEST_ASSERT_EQUAL_UINT64(0, all.non_finite);
	TEST_ASSERT_EQUAL_UINT64(0, all.negative);
	TEST_ASSERT_EQUAL_UINT64(0, all.pdf_differs);
}

/* --- errors over the floor ------------------------------------------------------------------------------------------------ */

/* The sweep over one lobe, or over a copy of it with a defect. references: 1 adds up what the textbook has, 0 the
 * rest. */
static void sweep(stability_lobe lobe, lobe_uint kind, uint64_t cases, stability_verb verbs, stability_tally tally[2])
{
	for (uint64_t n = 0; n < cases; n++) {
		const stability_case c = stability_draw(kind, n);
		for (stability_verb v = STABILITY_EVAL; v < verbs; v++) {
			const stability_result r = stability_measure_of(lobe, &c, v);
			if (r.defined)
				stability_tally_add(&tally[stability_is_textbook(&c)], &c, v, &r, n);
		}
	}
}

/* 99.99 % of all results within 16 floors, reflectances counted as their headers promise them (stability.h); what is
 * beyond is counted, and of all of it the sweep can say why. */
static void test_errors_stay_near_the_floor(void)
{
	static stability_tally tally[2];
	const uint64_t cases = test_long() ? 400000 : 6000;
	memset(tally, 0, sizeof tally);
	for (size_t l = 0; l < STABILITY_LOBES; l++)
		sweep(stability_library, stability_kinds[l],
		      stability_kinds[l] == LOBE_KIND_MICROFACET_DIFFUSE ? cases / 60 : cases, STABILITY_VERBS, tally);
	for (int k = 0; k < 2; k++) {
		printf("  %lu results against the %s: %lu beyond 16 floors", tally[k].compared,
		       k ? "textbook" : "double build", tally[k].above);
		for (int i = 0; i < STABILITY_CLASSES; i++)
			if (tally[k].classes[i])
				printf(", %s %lu", stability_class_names[i], tally[k].classes[i]);
		printf("\n");
	}
	measured("textbook: error over floor, 99.99 %", stability_percentile(tally[1].bins_of_one, 0.9999),
		 STABILITY_LIMIT);
	measured("textbook: the worst", tally[1].worst_of_one, 1.5 * STABILITY_LIMIT);
	measured("textbook: its own error, in floors", tally[1].own_error, 0.1);
	measured("double build: error over floor, 99.99 %", stability_percentile(tally[0].bins_of_one, 0.9999),
		 STABILITY_LIMIT);
	measured("textbook: unexplained", (double)tally[1].classes[STABILITY_PLAIN], 0.0);
	measured("double build: unexplained", (double)tally[0].classes[STABILITY_PLAIN], 0.0);
	TEST_ASSERT_EQUAL_UINT64(0, tally[0].non_finite + tally[1].non_finite);
	TEST_ASSERT_EQUAL_UINT64(0, tally[0].negative + tally[1].negative);
	TEST_ASSERT_GREATER_THAN_UINT64(100000, tally[1].compared);
}

/* --- a planted defect is found ------------------------------------------------------------------------------------------------ */

static void found(const char *name, stability_lobe lobe, int by_error)
{
	static stability_tally tally[2];
	stability_case worst;
	double most = -1.0;
	char text[512];
	memset(tally, 0, sizeof tally);
	memset(&worst, 0, sizeof worst);
	/* pdf, in which there is no reflectance to explain anything. */
	for (uint64_t n = 0; n < 10000; n++) {
		const stability_case c = stability_draw(LOBE_KIND_GGX_CONDUCTOR, n);
		const stability_result r = stability_measure_of(lobe, &c, STABILITY_PDF);
		if (!r.defined)
			continue;
		stability_tally_add(&tally[1], &c, STABILITY_PDF, &r, n);
		const double ratio = r.value - r.value == 0.0 ? stability_ratio_of_one(&r) : (double)INFINITY;
		if (ratio > most) {
			most = ratio;
			worst = c;
		}
	}
	stability_print(&worst, STABILITY_PDF, text, sizeof text);
	printf("  %s: %.3g floors at 99.99 %%, %.3g at 99 %%, %lu unexplained, %lu not finite; worst at %s\n", name,
	       stability_percentile(tally[1].bins_of_one, 0.9999), stability_percentile(tally[1].bins_of_one, 0.99),
	       tally[1].classes[STABILITY_PLAIN], tally[1].non_finite, text);
	if (by_error) {
		TEST_ASSERT_GREATER_THAN_UINT64(20, tally[1].classes[STABILITY_PLAIN]);
		TEST_ASSERT_TRUE(stability_percentile(tally[1].bins_of_one, 0.9999) > 100.0 * STABILITY_LIMIT);
	} else {
		TEST_ASSERT_GREATER_THAN_UINT64(5, tally[1].non_finite);
	}
}

/* As the library has it: nothing; with D from 1 - cos^2: errors; with Lambda from the tangent that 1 - cos^2 gives: no
 * number where a direction is longer than 1 by an ulp. */
static void test_planted_defects_are_found(void)
{
	static stability_tally tally[2];
	memset(tally, 0, sizeof tally);
	for (uint64_t n = 0; n < 10000; n++) {
		const stability_case c = stability_draw(LOBE_KIND_GGX_CONDUCTOR, n);
		const stability_result r = stability_measure(&c, STABILITY_PDF);
		if (r.defined)
			stability_tally_add(&tally[1], &c, STABILITY_PDF, &r, n);
	}
	TEST_ASSERT_EQUAL_UINT64(0, tally[1].classes[STABILITY_PLAIN] + tally[1].non_finite);
	found("D by 1 - cos^2", stability_defect_d, 1);
	found("Lambda by the tangent", stability_defect_lambda, 0);
}

/* Two glasses of Gaussian surfaces of which one is seen along its normal from within, by directions eight and twelve
 * roundings off unit; of the other, tilted away, density and visible area are tails of exponents of 31 and 30. */
static void test_rare_reasons_are_found(void)
{
	static const struct {
		uint64_t n;
		stability_class reason;
	} known[] = {{163545, STABILITY_LENGTH}, {640502, STABILITY_SHAPE}};
	for (size_t k = 0; k < sizeof known / sizeof *known; k++)
		for (stability_verb verb = STABILITY_EVAL; verb <= STABILITY_PDF; verb++) {
			const stability_case c = stability_draw(LOBE_KIND_MICROFACET_DIELECTRIC, known[k].n);
			const stability_result r = stability_measure(&c, verb);
			TEST_ASSERT_TRUE(stability_ratio(&r) > STABILITY_LIMIT);
			TEST_ASSERT_EQUAL_STRING(stability_class_names[known[k].reason],
						 stability_class_names[stability_explain(&c, verb, &r)]);
		}
}

static void read_vector(char **at, const char *name, float v[3])
{
	TEST_ASSERT_EQUAL_STRING_LEN(name, *at, strlen(name));
	*at += strlen(name);
	for (int k = 0; k < 3; k++)
		v[k] = strtof(*at, at);
}

/* The case that a text of stability_print is of. */
static stability_case read_case(lobe_uint kind, stability_verb verb, char *at)
{
	const int samples = verb >= STABILITY_WEIGHT || stability_is_delta_only(kind);
	stability_case c;
	memset(&c, 0, sizeof c);
	c.kind = kind;
	read_vector(&at, "wo ", c.wo);
	read_vector(&at, samples ? " u " : " wi ", samples ? c.u : c.wi);
	while (at[0] == ' ' && at[1] == 'p') {
		const long k = strtol(at + 2, &at, 10);
		TEST_ASSERT_TRUE(k >= 0 && k < CASE_PARAMETERS);
		c.parameter[k] = strtod(at, &at);
	}
	TEST_ASSERT_EQUAL_INT(1, sscanf(at, " channel %d", &c.channel));
	return c;
}

static void test_printed_cases_give_the_same_bits(void)
{
	char text[1024];
	for (size_t lobe = 0; lobe < STABILITY_LOBES; lobe++)
		for (uint64_t n = 0; n < 200; n++)
			for (stability_verb verb = STABILITY_EVAL; verb <= STABILITY_WEIGHT; verb++) {
				const stability_case c = stability_draw(stability_kinds[lobe], n);
				stability_print(&c, verb, text, sizeof text);
				const stability_case back = read_case(c.kind, verb, text);
				const double value = stability_library(&c, verb), again = stability_library(&back, verb);
				TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&value, &again, sizeof value, text);
			}
}

/* The search goes uphill, and what it finds is a case of the same lobe. */
static void test_ascents_go_uphill(void)
{
	const stability_case c = stability_draw(LOBE_KIND_GGX_DIELECTRIC, 17);
	const stability_result before = stability_measure(&c, STABILITY_EVAL);
	const stability_case up = stability_ascend(stability_ratio_of_one, c, STABILITY_EVAL, 1500, 1);
	const stability_result after = stability_measure(&up, STABILITY_EVAL);
	printf("  from %.3g floors to %.3g\n", stability_ratio_of_one(&before), stability_ratio_of_one(&after));
	TEST_ASSERT_EQUAL_UINT(c.kind, up.kind);
	TEST_ASSERT_TRUE(stability_ratio_of_one(&after) > 2.0 * stability_ratio_of_one(&before));
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_nothing_that_must_not_come_out);
	RUN_TEST(test_errors_stay_near_the_floor);
	RUN_TEST(test_planted_defects_are_found);
	RUN_TEST(test_rare_reasons_are_found);
	RUN_TEST(test_printed_cases_give_the_same_bits);
	RUN_TEST(test_ascents_go_uphill);
	return UNITY_END() != 0;
}
