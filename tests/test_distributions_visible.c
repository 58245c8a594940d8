/* test_distributions_visible.c - visible and plain normals of every distribution that is chosen at run time
 * (microfacet/distribution.h): their cumulative distributions against quadrature, chi-square of a million samples,
 * order, extremes, and what a wrong table does to all that. */
#include "chi_square.h"
#include "distribution_cases.h"
#include "measured.h"
#include "support.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const distribution_case *cases;
static size_t count;

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static void test_made(void)
{
	cases = distribution_cases(&count);
	TEST_ASSERT_NOT_NULL(cases);
}

/* Directions by v.z/|v.xy| in units of the median slope, so that every width is looked at where it is interesting. */
static const double heights[] = {1e30, 4.0, 1.0, 0.3, 1e-3, 0.0, -1e-3, -0.3, -1.0, -3.0};
enum { VIEWS = sizeof heights / sizeof *heights };

static double median(const distribution_case *c) { return sqrt((double)lobe_distribution_tail_inverse(c->d, 0.5f)); }

/* Unit, with azimuth 1. */
static lobe_vec3 view(const distribution_case *c, size_t k)
{
	const double z = heights[k] * median(c), len = hypot(1.0, z);
	if (heights[k] > 1e20)
		return lobe_vec3_make(0.0f, 0.0f, 1.0f);
	return lobe_vec3_make((float)(cos(1.0) / len), (float)(sin(1.0) / len), (float)(z / len));
}

/* What v sees, as the reference has it. psi: from the azimuth of v on. */
typedef struct {
	const distribution_case *c;
	double s, z, psi0, psi1;
} seen;

static seen seen_from(const distribution_case *c, lobe_vec3 v)
{
	const seen q = {c, hypot((double)v.x, (double)v.y), (double)v.z, -PI, PI};
	return q;
}

/* int max(0, z + s r cos psi) over [psi0, psi1], over 2 pi. */
static double ring_seen(void *context, double r)
{
	const seen *q = context;
	if (q->psi0 == -PI && q->psi1 == PI)
		return reference_kernel(q->s, q->z, r) / TWO_PI;
	const double a = q->s * r;
	const double edge = q->z >= a ? PI : q->z <= -a ? 0.0 : 2.0 * asin(sqrt(0.5 * (a + q->z) / a));
	const double p0 = fmax(q->psi0, -edge), p1 = fmin(q->psi1, edge);
	return p1 > p0 ? (q->z * (p1 - p0) + a * (sin(p1) - sin(p0))) / TWO_PI : 0.0;
}

/* Of the rings r0 to r1; in two pieces where one is not smooth. */
static double seen_between(const seen *q, double r0, double r1)
{
	const double z = q->s > 0.0 ? fabs(q->z) / q->s : HUGE_VAL;
	seen copy = *q;
	if (z > r0 && z < r1)
		return ring_integral(q->c, r0, z, ring_seen, &copy) + ring_integral(q->c, z, r1, ring_seen, &copy);
	return ring_integral(q->c, r0, r1, ring_seen, &copy);
}

static double steepness(lobe_vec3 m) { return hypot((double)m.x, (double)m.y) / (double)m.z; }

/* --- cumulative distributions ------------------------------------------------------------------------------------- */

enum { RINGS = 16 };

/* Steeper than this nothing is told apart: the horizon is 1e-15 away. */
#define FLAT 1e15

static float ring_u(int i)
{
	return i == 0 ? 0.0f : i == 1 ? 0x1p-12f : i == RINGS - 1 ? 1.0f - 0x1p-24f : (float)i / RINGS;
}

/* Largest distance of u.x from the share of what v sees that is flatter than the ring it gives. */
static double ring_error(const distribution_case *c, lobe_distribution d, lobe_vec3 v)
{
	const seen q = seen_from(c, v);
	const double all = seen_between(&q, 0.0, HUGE_VAL);
	double worst = 0.0;
	if (all < 1e-30)
		return 0.0;
	for (int i = 0; i < RINGS; i++) {
		const float u = ring_u(i);
		const double r = steepness(lobe_distribution_visible(d, v, lobe_vec2_make(u, 0.3f)));
		const double steeper = seen_between(&q, fmin(r, FLAT), HUGE_VAL) / all,
			     off = steeper - (1.0 - (double)u);
		worst = worse(worst, r < FLAT ? fabs(off) : fmax(-off, 0.0));
	}
	return worst;
}

static void test_rings(void)
{
	double smooth = 0.0, rough = 0.0, narrow = 0.0, wrong = 0.0;
	for (size_t i = 0; i < count; i++) {
		double worst = 0.0;
		for (size_t k = 0; k < VIEWS; k++)
			worst = worse(worst, ring_error(&cases[i], cases[i].d, view(&cases[i], k)));
		printf("  %-20s %.3g\n", cases[i].name, worst);
		/* A ring whose width is a hundredth of its steepness is near the resolution of a float. */
		if (strcmp(cases[i].name, "narrow ring .5") == 0)
			narrow = worst;
		else if (cases[i].smooth)
			smooth = worse(smooth, worst);
		else
			rough = worse(rough, worst);
	}
	measured("cumulative distribution of the ring, smooth densities", smooth, 3e-6);
	measured("cumulative distribution of the ring, with jumps", rough, 3e-6);
	measured("cumulative distribution of the ring, narrow ring", narrow, 4e-5);
	/* Student-T of gamma 3 with the table of gamma 2. */
	const distribution_case *three = distribution_case_named("Student-T 3");
	lobe_distribution d = three->d;
	d.table = distribution_case_named("Student-T 2")->d.table;
	for (size_t k = 0; k < VIEWS; k++)
		wrong = worse(wrong, ring_error(three, d, view(three, k)));
	printf("  planted: the table of another gamma %.3g\n", wrong);
	TEST_ASSERT_TRUE(wrong > 1e-2);
}

/* Azimuth: the share of the ring's visible part up to psi against u.y. */
static void test_azimuth(void)
{
	static const double z[] = {1e20, 10.0, 2.0, 1.001, 1.0, 0.999, 0.5, 1e-3, 0.0, -0.3, -0.9, -0.999, -0.99999};
	double worst = 0.0;
	for (size_t k = 0; k < sizeof z / sizeof *z; k++) {
		const float height = (float)z[k];
		const double end = z[k] >= 1.0 ? PI : 2.0 * asin(sqrt(0.5 * (1.0 + (double)height)));
		double before = -10.0;
		for (int i = 0; i <= 2000; i++) {
			const float u = i < 1990 ? (float)i / 2000.0f : 1.0f - ldexpf(1.0f, 1976 - i);
			const lobe_sincos a = lobe_visible_azimuth(height, 1.0f, u);
			const double psi = atan2((double)a.s, (double)a.c);
			/* Below the horizon the difference of two nearly equal terms needs care here too. */
			const double p = fabs(psi),
				     deficit =
					     p < 0.1 ? p * p * p * (1.0 / 6.0 - p * p * (1.0 / 120.0 - p * p / 5040.0))
						     : p - sin(p);
			const double e =
				end < 0.1
					? end * end * end * (1.0 / 6.0 - end * end * (1.0 / 120.0 - end * end / 5040.0))
					: end - sin(end);
			const double up = 1.0 + (double)height;
			const double share = (up * p - deficit) / (up * end - e);
			const double cdf = 0.5 + (psi < 0.0 ? -0.5 : 0.5) * share;
			worst = worse(worst, fabs(cdf - ((double)u + 0x1p-25)));
			TEST_ASSERT_TRUE_MESSAGE(psi >= before - 2e-6, "azimuth out of order");
			before = psi;
		}
	}
	measured("cumulative distribution of the azimuth", worst, 1e-6);
}

/* --- order and extremes ------------------------------------------------------------------------------------------- */

static void test_order(void)
{
	double back = 0.0;
	for (size_t i = 0; i < count; i++) {
		for (size_t k = 0; k < VIEWS; k++) {
			double before = 0.0;
			for (int n = 0; n < 1000; n++) {
				const lobe_vec2 u = lobe_vec2_make((float)n / 1000.0f, 0.5f);
				const double r =
					steepness(lobe_distribution_visible(cases[i].d, view(&cases[i], k), u));
				if (before > 0.0)
					back = worse(back, (before - r) / before);
				before = r;
			}
		}
	}
	measured("rings that shrink with u.x: relative", back, 1e-4);
}

static int is_direction(lobe_vec3 m)
{
	const float len2 = m.x * m.x + m.y * m.y + m.z * m.z;
	return m.z >= 0.0f && len2 > 1e-9f && len2 <= 1e9f;
}

static void test_extremes(void)
{
	static const float u[] = {0.0f, 0x1p-149f, 0x1p-24f,       0.25f,         0x1.fffffep-2f,
				  0.5f, 0.75f,     0x1.fffffcp-1f, 0x1.fffffep-1f};
	static const lobe_vec3 v[] = {
		{0.0f, 0.0f, 1.0f},   {1.0f, 0.0f, 0.0f},     {0.0f, -1.0f, -0.0f},  {1e-20f, 1e-20f, 1.0f},
		{1e-6f, 0.0f, 1.0f},  {0.6f, 0.0f, 0.8f},     {1.0f, 0.0f, 1e-6f},   {1.0f, 0.0f, -1e-6f},
		{0.8f, 0.0f, -0.6f},  {1e-6f, 0.0f, -1.0f},   {0.0f, 0.0f, -1.0f},   {1e-4f, 1e-4f, 0x1p-20f},
		{1.0f, 1.0f, 1e-30f}, {1e-12f, 0.0f, 1e-12f}, {1e-4f, 0.0f, -1e-6f}, {0.0f, 1e-10f, 0.1f}};
	const size_t us = sizeof u / sizeof *u;
	uint32_t bad = 0;
	for (size_t i = 0; i < count; i++) {
		const lobe_distribution d = cases[i].d;
		for (size_t k = 0; k < sizeof v / sizeof *v; k++) {
			const float hidden = lobe_distribution_hidden(d, v[k]);
			bad += !(hidden >= 0.0f && hidden <= LOBE_REAL_MAX);
			for (size_t n = 0; n < us * us; n++) {
				const lobe_vec3 m =
					lobe_distribution_visible(d, v[k], lobe_vec2_make(u[n / us], u[n % us]));
				if (!is_direction(m)) {
					if (bad++ < 10)
						printf("  %s: view %zu, u %g %g: %g %g %g\n", cases[i].name, k,
						       (double)u[n / us], (double)u[n % us], (double)m.x, (double)m.y,
						       (double)m.z);
				}
				const lobe_vec3 p = lobe_distribution_plain(d, lobe_vec2_make(u[n / us], u[n % us]));
				bad += !(p.z > 0.0f && p.x - p.x == 0.0f && p.y - p.y == 0.0f);
			}
		}
		for (int e = -80; e <= 80; e++) {
			const float t2 = ldexpf(1.0f, e), q = lobe_distribution_tail(d, t2);
			bad += !(q >= 0.0f && q <= 1.0f + 1e-5f);
			if (e <= 0 && e >= -40) {
				const float back = lobe_distribution_tail_inverse(d, t2);
				bad += !(back >= 0.0f && back <= LOBE_REAL_MAX);
			}
		}
	}
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* --- chi-square --------------------------------------------------------------------------------------------------- */

enum { RING_BINS = 20, PSI_BINS = 16, BINS = RING_BINS * PSI_BINS, SAMPLES = 1000000 };

/* Rings that split what v sees (or, for plain samples, the plane) about evenly: where the table puts them, whether it
 * is right or not. */
static void ring_edges(const distribution_case *c, lobe_vec3 v, int plain, double *edge)
{
	edge[0] = 0.0;
	for (int i = 1; i < RING_BINS; i++) {
		const lobe_vec2 u = lobe_vec2_make((float)i / RING_BINS, 0.5f);
		edge[i] = steepness(plain ? lobe_distribution_plain(c->d, u) : lobe_distribution_visible(c->d, v, u));
	}
	edge[RING_BINS] = HUGE_VAL;
}

static double one(void *context, double r)
{
	(void)context;
	(void)r;
	return 1.0;
}

static int bin_of(const double *edge, lobe_vec3 m, double azimuth)
{
	const double r = steepness(m);
	double turns = (atan2((double)m.y, (double)m.x) - azimuth) / TWO_PI + 0.5;
	int ring = 0;
	while (ring < RING_BINS - 1 && r >= edge[ring + 1])
		ring++;
	turns -= floor(turns);
	const int psi = (int)(turns * PSI_BINS);
	return ring * PSI_BINS + (psi < PSI_BINS ? psi : PSI_BINS - 1);
}

/* Visible normals sampled from d, or plain ones, against what the case's own density says. */
static double p_value(const distribution_case *c, lobe_distribution d, lobe_vec3 v, int plain, uint32_t stream,
		      double *integral)
{
	static double expected[BINS];
	static uint32_t observed[BINS];
	double edge[RING_BINS + 1];
	ring_edges(c, v, plain, edge);
	const double azimuth = plain ? 0.0 : atan2((double)v.y, (double)v.x);
	double all = 0.0;
	seen q = seen_from(c, v);
	for (int i = 0; i < BINS; i++) {
		const int ring = i / PSI_BINS;
		observed[i] = 0;
		q.psi0 = -PI + TWO_PI * (i % PSI_BINS) / PSI_BINS;
		q.psi1 = q.psi0 + TWO_PI / PSI_BINS;
		if (plain)
			expected[i] = ring_integral(c, edge[ring], edge[ring + 1], one, NULL) / PSI_BINS;
		else if (i % PSI_BINS >= PSI_BINS / 2)
			expected[i] = expected[ring * PSI_BINS + PSI_BINS - 1 - i % PSI_BINS];
		else
			expected[i] = seen_between(&q, edge[ring], edge[ring + 1]);
		all += expected[i];
	}
	/* The density of visible normals with the library's own sigma integrates to this. */
	*integral = plain ? all : all / (double)lobe_distribution_sigma(c->d, v);
	for (uint32_t i = 0; i < SAMPLES; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_vec2 u2 = lobe_vec2_make(u[0], u[1]);
		const lobe_vec3 m = plain ? lobe_distribution_plain(d, u2) : lobe_distribution_visible(d, v, u2);
		observed[bin_of(edge, m, azimuth)]++;
	}
	for (int i = 0; i < BINS; i++)
		expected[i] /= all;
	return chi_square_of(expected, observed, BINS).p;
}

static void test_chi_square(void)
{
	/* Sidak over all that may run. */
	const double level = -expm1(log1p(-0.01) / (double)(count * (VIEWS + 1)));
	double worst = 0.0, least = 1.0;
	unsigned n = 0, unseen = 0;
	for (size_t i = 0; i < count; i++) {
		for (size_t k = 0; k <= VIEWS; k++) {
			/* One in 26, so that every distribution and every view has its turn. */
			const int plain = k == VIEWS;
			if (!test_long() && (3 * i + k) % 26 != 0)
				continue;
			const lobe_vec3 v = view(&cases[i], plain ? 0 : k);
			double integral;
			/* From far enough behind a surface without steep facets nothing of it is seen. */
			if (!plain && lobe_distribution_sigma(cases[i].d, v) == 0.0f) {
				seen q = seen_from(&cases[i], v);
				q.psi0 = -PI;
				q.psi1 = PI;
				TEST_ASSERT_EQUAL_DOUBLE(0.0, seen_between(&q, 0.0, HUGE_VAL));
				unseen++;
				continue;
			}
			const double p = p_value(&cases[i], cases[i].d, v, plain, 3000u + n++, &integral);
			printf("  %-16s %-8s %8.2g  integral - 1 %9.2g  p %.3g\n", cases[i].name,
			       plain ? "plain" : "visible", plain ? 0.0 : heights[k], integral - 1.0, p);
			worst = worse(worst, fabs(integral - 1.0));
			least = fmin(least, p);
		}
	}
	printf("  %u chi-square tests of %d samples: least p %.2g, level %.2g; %u views from where nothing is seen\n", n,
	       SAMPLES, least, level, unseen);
	measured("|integral of the density of visible normals - 1|", worst, 1e-5);
	TEST_ASSERT_TRUE(least > level);

	const distribution_case *c = distribution_case_named("Student-T 3");
	lobe_distribution d = c->d;
	double integral;
	d.table = distribution_case_named("Student-T 10")->d.table;
	const double wrong = p_value(c, d, view(c, 3), 0, 2999u, &integral);
	d = c->d;
	d.norm *= 1.2f;
	const double wrong_plain = p_value(c, d, view(c, 3), 1, 2998u, &integral);
	printf("  planted: a table of gamma 10 p %.2g, heavier tails p %.2g\n", wrong, wrong_plain);
	TEST_ASSERT_TRUE(wrong < 1e-9 && wrong_plain < 1e-9);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_made);
	RUN_TEST(test_rings);
	RUN_TEST(test_azimuth);
	RUN_TEST(test_order);
	RUN_TEST(test_extremes);
	RUN_TEST(test_chi_square);
	return UNITY_END();
}
