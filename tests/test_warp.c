/* test_warp.c - core/warp.h: domains, densities by chi-square and quadrature, inverses. */
#include "lobe/core/warp.h"

#include "chi_square.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>

#define U     0x1p-24 /* half an ulp of 1: what one rounding takes at most, relative to the result */
#define CASES 500000u

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* Half angles from a thousandth of a degree to the whole sphere. */
static const float heights[] = {0x1p-32f, 1e-4f, 0.3f, 1.0f, 1.7f, 2.0f};
#define HEIGHTS (sizeof heights / sizeof heights[0])

/* A map of the square to directions, for tests that treat all alike. The disk is the point below the direction. */
typedef struct {
	const char *name;
	lobe_vec3 (*map)(lobe_vec2 u, float height);
	float (*pdf)(lobe_vec3 w, float height);
	lobe_vec2 (*inverse)(lobe_vec3 w, float height);
	float height; /* of a cap */
	double top;   /* the map reaches z from 1 down to top */
} warp;

static lobe_vec3 map_cosine(lobe_vec2 u, float height)
{
	(void)height;
	return lobe_cosine_hemisphere(u);
}

static float pdf_cosine(lobe_vec3 w, float height)
{
	(void)height;
	return lobe_cosine_hemisphere_pdf(w);
}

static lobe_vec2 inverse_cosine(lobe_vec3 w, float height)
{
	(void)height;
	return lobe_cosine_hemisphere_inverse(w);
}

static lobe_vec3 map_uniform(lobe_vec2 u, float height)
{
	(void)height;
	return lobe_uniform_hemisphere(u);
}

static float pdf_uniform(lobe_vec3 w, float height)
{
	(void)height;
	return lobe_uniform_hemisphere_pdf(w);
}

static lobe_vec2 inverse_uniform(lobe_vec3 w, float height)
{
	(void)height;
	return lobe_uniform_hemisphere_inverse(w);
}

static float pdf_cap(lobe_vec3 w, float height)
{
	(void)w;
	return lobe_spherical_cap_pdf(height);
}

static const warp warps[] = {
	{"cosine hemisphere", map_cosine, pdf_cosine, inverse_cosine, 1.0f, 0.0},
	{"uniform hemisphere", map_uniform, pdf_uniform, inverse_uniform, 1.0f, 0.0},
	{"cap of height 0.3", lobe_spherical_cap, pdf_cap, lobe_spherical_cap_inverse, 0.3f, 1.0 - (double)0.3f},
	{"cap of height 1.7", lobe_spherical_cap, pdf_cap, lobe_spherical_cap_inverse, 1.7f, 1.0 - (double)1.7f},
	{"sphere", lobe_spherical_cap, pdf_cap, lobe_spherical_cap_inverse, 2.0f, -1.0},
};
#define WARPS (sizeof warps / sizeof warps[0])

/* --- domains ------------------------------------------------------------------------------------------------------ */

static const float corner[] = {0.0f,           0x1p-149f, 0x1p-126f,      0x1p-25f, 0x1p-24f,       0.25f,
			       0x1.fffffep-2f, 0.5f,      0x1.000002p-1f, 0.75f,    0x1.fffffcp-1f, 0x1.fffffep-1f};
#define CORNERS (sizeof corner / sizeof corner[0])

/* Number i of a list that begins with all pairs of corners, goes on along the edges, and ends in random points. */
static lobe_vec2 point(uint64_t i)
{
	const uint64_t pairs = CORNERS * CORNERS;
	if (i < pairs)
		return lobe_vec2_make(corner[i % CORNERS], corner[i / CORNERS]);
	const lobe_vec2 u = lobe_vec2_make(test_uniform(1, 2 * i), test_uniform(1, 2 * i + 1));
	if (i % 4 == 0)
		return lobe_vec2_make(corner[i / 4 % CORNERS], u.y);
	if (i % 4 == 1)
		return lobe_vec2_make(u.x, corner[i / 4 % CORNERS]);
	return u;
}

static double length3(lobe_vec3 w)
{
	return sqrt((double)w.x * (double)w.x + (double)w.y * (double)w.y + (double)w.z * (double)w.z);
}

static double radius(lobe_vec2 d) { return sqrt((double)d.x * (double)d.x + (double)d.y * (double)d.y); }

static void test_disk_domain(void)
{
	double widest = 0.0;
	for (uint64_t i = 0; i < CASES; i++)
		widest = larger(widest, radius(lobe_concentric_disk(point(i))));
	/* |r| <= 1 - 2^-24 before the sine and cosine, whose rounding (2 ulp each) can add up to 2.5e-7. */
	printf("  %-56s %11.4g\n", "disk: largest radius - 1", widest - 1.0);
	TEST_ASSERT_TRUE_MESSAGE(widest < 1.0 + 2.5e-7, "a point of the disk lies outside by more than rounding");
}

static void test_cosine_domain(void)
{
	double off_unit = 0.0, lowest = 1.0;
	for (uint64_t i = 0; i < CASES; i++) {
		const lobe_vec3 w = lobe_cosine_hemisphere(point(i));
		off_unit = larger(off_unit, fabs(length3(w) - 1.0));
		lowest = (double)w.z < lowest ? (double)w.z : lowest;
		TEST_ASSERT_TRUE_MESSAGE(lobe_cosine_hemisphere_pdf(w) > 0.0f, "a sample has no density");
	}
	/* x and y are r times a sine and a cosine off by 1 ulp (2 U) each, rounded once (1 U); z is off by 2.5 U. */
	measured("cosine hemisphere: | |w| - 1 |", off_unit, 3.1 * U);
	measured("cosine hemisphere: 3e-4 - lowest z", 3e-4 - lowest, 0.0);
}

static void test_cap_domain(void)
{
	double off_unit = 0.0, below = 0.0;
	for (size_t k = 0; k < HEIGHTS; k++) {
		for (uint64_t i = 0; i < CASES / HEIGHTS; i++) {
			const lobe_vec3 w = lobe_spherical_cap(point(i), heights[k]);
			off_unit = larger(off_unit, fabs(length3(w) - 1.0));
			/* In the cap, up to the rounding of z itself: 1 - z is at most the height. */
			below = larger(below, (1.0 - (double)w.z) - (double)heights[k]);
			TEST_ASSERT_TRUE_MESSAGE(lobe_spherical_cap_pdf(heights[k]) > 0.0f, "a sample has no density");
		}
	}
	/* As above with s off by 1.5 U in place of r, and z by 1 U. */
	measured("cap: | |w| - 1 |", off_unit, 4.6 * U);
	measured("cap: 1 - z - height", below, 1.0 * U);
}

/* Where the cap is nearly the whole sphere and u.y in its last cells, against the map in long double: what is left of
 * the sphere below a point is small. Planted: that as a difference of what is above. */
static void test_cap_far_end(void)
{
	double off = 0.0, planted = 0.0;
	for (uint32_t k = 0; k < 8192u; k += 61u)
		for (uint32_t i = 1; i <= 8192u; i += 67u) {
			const float height = 2.0f - (float)k * 0x1p-23f;
			const lobe_vec2 u = lobe_vec2_make(0.125f, 1.0f - (float)i * (float)U);
			const long double h = (long double)u.y * (long double)height;
			const double exact = (double)sqrtl(h * (2.0L - h));
			const lobe_vec3 w = lobe_spherical_cap(u, height);
			const float rounded = u.y * height;
			off = larger(off, fabs(hypot((double)w.x, (double)w.y) / exact - 1.0));
			planted = larger(planted, fabs(sqrt((double)(rounded * (2.0f - rounded))) / exact - 1.0));
		}
	/* s is off by 3 U, sine and cosine by 2 U each, and the products by 1 U. */
	measured("cap, last cells: distance from the axis, relative", off, 6.0 * U);
	TEST_ASSERT_TRUE(planted > 100.0 * U);
}

static void test_uniform_hemisphere_domain(void)
{
	double lowest = 1.0;
	for (uint64_t i = 0; i < CASES; i++) {
		const lobe_vec3 w = lobe_uniform_hemisphere(point(i));
		lowest = (double)w.z < lowest ? (double)w.z : lowest;
		TEST_ASSERT_TRUE_MESSAGE(lobe_uniform_hemisphere_pdf(w) > 0.0f, "a sample has no density");
	}
	/* 1 - u.y for the largest u.y. */
	measured("uniform hemisphere: 2^-24 - lowest z", U - lowest, 0.0);
}

static void test_density_outside(void)
{
	const lobe_vec3 below = {0.6f, 0.0f, -0.8f}, level = {1.0f, 0.0f, 0.0f}, nan = {NAN, NAN, NAN};
	TEST_ASSERT_TRUE(lobe_cosine_hemisphere_pdf(below) == 0.0f);
	TEST_ASSERT_TRUE(lobe_cosine_hemisphere_pdf(level) == 0.0f);
	TEST_ASSERT_TRUE(lobe_cosine_hemisphere_pdf(nan) == 0.0f);
	TEST_ASSERT_TRUE(lobe_uniform_hemisphere_pdf(below) == 0.0f);
	TEST_ASSERT_TRUE(lobe_uniform_hemisphere_pdf(nan) == 0.0f);
}

/* --- densities ---------------------------------------------------------------------------------------------------- */

#define SAMPLES  1000000u
#define Z_BINS   24
#define PHI_BINS 32

/* The cells, and one more for what the density has outside of all of them: no sample is there. */
#define CELLS (Z_BINS * PHI_BINS)
#define BINS  (CELLS + 1)

static double p_value(double *probability, const uint32_t *count)
{
	probability[CELLS] = 1.0;
	for (int i = 0; i < CELLS; i++)
		probability[CELLS] -= probability[i];
	return chi_square_of(probability, count, BINS).p;
}

typedef double (*density)(const warp *m, lobe_vec3 w);

static double density_of_header(const warp *m, lobe_vec3 w) { return (double)m->pdf(w, m->height); }

/* Off by up to 5 % over the range of z, with the same integral for the cosine (whose mean z is 2/3) and for caps (whose
 * mean is the middle). */
static double density_planted(const warp *m, lobe_vec3 w)
{
	const double mean = m->pdf == pdf_cosine ? 2.0 / 3.0 : 0.5 * (1.0 + m->top);
	return density_of_header(m, w) * (1.0 + 0.1 * ((double)w.z - mean) / (1.0 - m->top));
}

/* Integral of f over a range of z and phi. */
static double integrate(density f, const warp *m, double z0, double z1, double phi0, double phi1, size_t n)
{
	gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(n);
	double sum = 0.0;
	for (size_t i = 0; i < n; i++) {
		double z, z_weight;
		gsl_integration_glfixed_point(z0, z1, i, &z, &z_weight, rule);
		const double s = sqrt((1.0 - z) * (1.0 + z));
		for (size_t j = 0; j < n; j++) {
			double phi, phi_weight;
			gsl_integration_glfixed_point(phi0, phi1, j, &phi, &phi_weight, rule);
			const lobe_vec3 w = {(float)(s * cos(phi)), (float)(s * sin(phi)), (float)z};
			sum += z_weight * phi_weight * f(m, w);
		}
	}
	gsl_integration_glfixed_table_free(rule);
	return sum;
}

static double warp_p_value(const warp *m, density f, uint32_t stream)
{
	static uint32_t count[BINS];
	static double probability[BINS];
	const double range = 1.0 - m->top;
	for (int i = 0; i < CELLS; i++) {
		const double z = m->top + range * (i / PHI_BINS) / Z_BINS, phi = TWO_PI * (i % PHI_BINS) / PHI_BINS;
		count[i] = 0;
		probability[i] = integrate(f, m, z, z + range / Z_BINS, phi, phi + TWO_PI / PHI_BINS, 4);
	}
	for (uint64_t i = 0; i < SAMPLES; i++) {
		float u[3];
		test_u3(stream, i, u);
		const lobe_vec3 w = m->map(lobe_vec2_make(u[0], u[1]), m->height);
		double turns = atan2((double)w.y, (double)w.x) / TWO_PI;
		turns -= floor(turns);
		int z = (int)(((double)w.z - m->top) / range * Z_BINS), phi = (int)(turns * PHI_BINS);
		/* Rounding may put z on the edge or an ulp beyond it. */
		z = z < 0 ? 0 : z >= Z_BINS ? Z_BINS - 1 : z;
		phi = phi >= PHI_BINS ? PHI_BINS - 1 : phi;
		count[z * PHI_BINS + phi]++;
	}
	return p_value(probability, count);
}

static void test_chi_square(void)
{
	/* Sidak: all tests together reject a right density in 1 of 100 sets of random numbers (ours are fixed). */
	const double level = 1.0 - pow(0.99, 1.0 / (double)WARPS);
	for (size_t k = 0; k < WARPS; k++) {
		const double p = warp_p_value(&warps[k], density_of_header, 2 + (uint32_t)k);
		const double planted = warp_p_value(&warps[k], density_planted, 2 + (uint32_t)k);
		printf("  %-40s p = %8.3g   with a density 5 %% off: p = %8.3g   level %.3g\n", warps[k].name, p,
		       planted, level);
		if (p <= level)
			measured(warps[k].name, -p, -level);
		if (planted > level)
			measured("the planted density was not caught", planted, level);
	}
}

/* Points of the disk in rings of equal width and sectors, against pdf times area. Planted: a radius of u in place of
 * its square root would be caught at once, so the wrong density is one that is only 5 % off at the rim. */
static void test_disk_chi_square(void)
{
	static uint32_t count[BINS];
	static double probability[BINS], planted[BINS];
	for (int i = 0; i < CELLS; i++) {
		const double r0 = (double)(i / PHI_BINS) / Z_BINS, r1 = r0 + 1.0 / Z_BINS;
		const double area = PI * (r1 * r1 - r0 * r0) / PHI_BINS;
		count[i] = 0;
		probability[i] = (double)lobe_concentric_disk_pdf() * area;
		planted[i] = probability[i] * (1.0 + 0.1 * (0.5 * (r0 * r0 + r1 * r1) - 0.5));
	}
	for (uint64_t i = 0; i < SAMPLES; i++) {
		float u[3];
		test_u3(9, i, u);
		const lobe_vec2 d = lobe_concentric_disk(lobe_vec2_make(u[0], u[1]));
		double turns = atan2((double)d.y, (double)d.x) / TWO_PI;
		turns -= floor(turns);
		int r = (int)(radius(d) * Z_BINS), phi = (int)(turns * PHI_BINS);
		r = r >= Z_BINS ? Z_BINS - 1 : r;
		phi = phi >= PHI_BINS ? PHI_BINS - 1 : phi;
		count[r * PHI_BINS + phi]++;
	}
	const double p = p_value(probability, count);
	const double wrong = p_value(planted, count);
	printf("  %-40s p = %8.3g   with a density 5 %% off: p = %8.3g   level %.3g\n", "disk", p, wrong, 0.01);
	TEST_ASSERT_TRUE_MESSAGE(p > 0.01, "disk: the density disagrees with the samples");
	TEST_ASSERT_TRUE_MESSAGE(wrong < 0.01, "disk: the planted density was not caught");
}

static void test_densities_integrate_to_one(void)
{
	/* The densities are polynomials in z, so 16 Gauss points integrate exactly what float arithmetic gives: a
	 * rounded constant (1/pi: 0.4 U, 2 pi, height and the quotient: 3 U) and rounded products (1 U, and 1 U from
	 * z). */
	for (size_t k = 0; k < WARPS; k++) {
		const warp *m = &warps[k];
		double total = integrate(density_of_header, m, m->top, 1.0, 0.0, TWO_PI, 16);
		/* Below the horizon the density of a hemisphere is 0. */
		if (m->pdf != pdf_cap)
			total += integrate(density_of_header, m, -1.0, -0x1p-20, 0.0, TWO_PI, 16);
		char what[80];
		snprintf(what, sizeof what, "%s: |integral of pdf - 1|", m->name);
		measured(what, fabs(total - 1.0), 4.0 * U);
	}
	measured("disk: |integral of pdf - 1|", fabs((double)lobe_concentric_disk_pdf() * PI - 1.0), U);
	for (size_t k = 0; k < HEIGHTS; k++) {
		const double area = TWO_PI * (double)heights[k];
		measured("cap: |pdf times area - 1|", fabs((double)lobe_spherical_cap_pdf(heights[k]) * area - 1.0),
			 3.0 * U);
	}
}

/* --- inverses ----------------------------------------------------------------------------------------------------- */

static int in_square(lobe_vec2 u) { return u.x >= 0.0f && u.x < 1.0f && u.y >= 0.0f && u.y < 1.0f; }

/* Distance on a circle of length 1: the two ends of [0,1) are neighbours where u goes round. */
static double around(float a, float b)
{
	const double d = fabs((double)a - (double)b);
	return d < 0.5 ? d : 1.0 - d;
}

/* Forward, the angle is off by the rounding of `turns` (U/8, and U/8 more for 1/4 - eighth) and by U from sine and
 * cosine together: 1 U + pi/2 U = 2.6 U in angle, 4/pi of that in the square's [-1,1], half in u: 1.7 U. The radius is
 * off by 2.5 U, half of it in u. Back, len is off by 1.5 U, atan and quotient by 3 U, the products and constant by 3 U,
 * so u by (7.5 U)/2. u itself is rounded by U/2, and the cell's middle is taken off for half of an ulp: 8 U in all. */
static const double disk_inverse_bound = 8.0 * U;

static void test_disk_inverse_of_map(void)
{
	double worst = 0.0, worst_cosine = 0.0;
	for (uint64_t i = 0; i < CASES; i++) {
		const lobe_vec2 u = point(i);
		const lobe_vec2 v = lobe_concentric_disk_inverse(lobe_concentric_disk(u));
		const lobe_vec2 w = lobe_cosine_hemisphere_inverse(lobe_cosine_hemisphere(u));
		worst = larger(worst, larger(fabs((double)(v.x - u.x)), fabs((double)(v.y - u.y))));
		worst_cosine = larger(worst_cosine, larger(fabs((double)(w.x - u.x)), fabs((double)(w.y - u.y))));
	}
	measured("disk: |inverse(map(u)) - u|", worst, disk_inverse_bound);
	measured("cosine hemisphere: |inverse(map(u)) - u|", worst_cosine, disk_inverse_bound);
	const lobe_vec2 middle = lobe_concentric_disk_inverse(lobe_vec2_make(0.0f, 0.0f));
	measured("disk: |inverse(centre) - 1/2|", larger(fabs((double)middle.x - 0.5), fabs((double)middle.y - 0.5)),
		 U);
}

static void test_disk_map_of_inverse(void)
{
	double worst = 0.0, worst_cosine = 0.0;
	for (uint64_t i = 0; i < CASES; i++) {
		const double r =
			i % 8 ? sqrt((double)test_uniform(20, i)) : pow(10.0, -8.0 * (double)test_uniform(20, i));
		const double phi = TWO_PI * (double)test_uniform(21, i);
		const lobe_vec2 d = lobe_vec2_make((float)(r * cos(phi)), (float)(r * sin(phi)));
		const lobe_vec2 e = lobe_concentric_disk(lobe_concentric_disk_inverse(d));
		worst = larger(worst, larger(fabs((double)(e.x - d.x)), fabs((double)(e.y - d.y))));
		const lobe_vec3 w = {d.x, d.y, (float)sqrt(larger((1.0 - r) * (1.0 + r), 0.0))};
		const lobe_vec3 x = lobe_cosine_hemisphere(lobe_cosine_hemisphere_inverse(w));
		worst_cosine = larger(worst_cosine, larger(fabs((double)(x.x - w.x)), fabs((double)(x.y - w.y))));
		/* z = sqrt(1 - r^2) moves by r/z for each step of r. */
		const double z = larger((double)w.z, 3e-4);
		worst_cosine = larger(worst_cosine, fabs((double)(x.z - w.z)) * z);
	}
	/* The square is twice as wide as u, and its sides are at most pi/2 times as long on the disk. */
	measured("disk: |map(inverse(d)) - d|", worst, PI * disk_inverse_bound);
	measured("cosine hemisphere: |map(inverse(w)) - w| (dz times z)", worst_cosine, PI * disk_inverse_bound);
}

static void test_cap_inverse_of_map(void)
{
	double worst_round = 0.0, worst = 0.0, worst_relative = 0.0;
	for (size_t k = 0; k < HEIGHTS; k++) {
		for (uint64_t i = 0; i < CASES / HEIGHTS; i++) {
			const lobe_vec2 u = point(i);
			const lobe_vec2 v = lobe_spherical_cap_inverse(lobe_spherical_cap(u, heights[k]), heights[k]);
			const double error = fabs((double)v.y - (double)u.y);
			worst = larger(worst, error);
			/* Near the pole the error is relative, down to where squares underflow. */
			if (u.y > 0x1p-60f)
				worst_relative = larger(worst_relative, error / (double)u.y);
			/* At the poles themselves there is no way round. */
			if (u.y > 0x1p-60f)
				worst_round = larger(worst_round, around(v.x, u.x));
		}
	}
	/* x^2 + y^2 is h(2 - h), whose root is off by 1.5 U, times sine and cosine with 2 U and a rounding: 2 * 4.5 U,
	 * 2 U to form it, 2 U to divide, 1 U in u.y*height and 1 U in the last quotient: 15 U. Below the equator 1 - z
	 * is off by less than that. */
	measured("cap: |inverse(map(u)) - u| / u in u.y", worst_relative, 15.0 * U);
	measured("cap: |inverse(map(u)) - u| in u.y", worst, 15.0 * U);
	/* Sine, cosine, x and y move the angle by up to 3 U of a radian; atan2 is off by 2 ulp <= 4 U relative, its
	 * quotient and constant by 1.5 U, all of at most half a turn; adding 1 rounds by U/2: 0.5 + 2.75 + 0.5. */
	measured("cap: |inverse(map(u)) - u| in u.x", worst_round, 3.8 * U);
}

static void test_cap_map_of_inverse(void)
{
	double worst = 0.0, worst_z = 0.0;
	for (uint64_t i = 0; i < CASES; i++) {
		float d[3];
		test_direction(22, i, d);
		/* Every eighth near a pole. */
		if (i % 8 == 0) {
			const double s = pow(10.0, -9.0 * (double)test_uniform(23, i));
			const double len = sqrt((double)d[0] * (double)d[0] + (double)d[1] * (double)d[1]);
			d[0] = (float)((double)d[0] * s / len);
			d[1] = (float)((double)d[1] * s / len);
			d[2] = (float)copysign(sqrt((1.0 - s) * (1.0 + s)), (double)d[2]);
		}
		const lobe_vec3 w = {d[0], d[1], d[2]};
		const lobe_vec3 x = lobe_spherical_cap(lobe_spherical_cap_inverse(w, 2.0f), 2.0f);
		const double s = sqrt((double)w.x * (double)w.x + (double)w.y * (double)w.y);
		const double error = larger(fabs((double)(x.x - w.x)), fabs((double)(x.y - w.y)));
		/* Towards the lower pole x and y come from 1 - z, which knows less and less of them: s = sqrt(h(2 -
		 * h)). */
		worst = larger(worst, w.z > 0.0f ? error : error * s);
		worst_z = larger(worst_z, fabs((double)(x.z - w.z)));
	}
	/* h is off by 7 U relative above the equator, z by at most that; x and y by half of it and by 2 pi times
	 * the 3.8 U of u.x. Below it h is off by 2 U absolute: U/s in x and y. */
	measured("sphere: |map(inverse(w)) - w| in x, y (times s below)", worst, (3.5 + TWO_PI * 3.8 + 4.5) * U);
	measured("sphere: |map(inverse(w)) - w| in z", worst_z, 9.0 * U);
}

/* What an inverse returns can be used as u again: it lies in [0,1). */
static void test_inverse_in_square(void)
{
	uint32_t disk = 0, cosine = 0, cap = 0;
	for (uint64_t i = 0; i < CASES; i++) {
		const lobe_vec2 u = point(i);
		disk += !in_square(lobe_concentric_disk_inverse(lobe_concentric_disk(u)));
		cosine += !in_square(lobe_cosine_hemisphere_inverse(lobe_cosine_hemisphere(u)));
		const float height = heights[i % HEIGHTS];
		cap += !in_square(lobe_spherical_cap_inverse(lobe_spherical_cap(u, height), height));
	}
	measured("disk: inverses outside of [0,1)^2", disk, 0.0);
	measured("cosine hemisphere: inverses outside of [0,1)^2", cosine, 0.0);
	measured("cap: inverses outside of [0,1)^2", cap, 0.0);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_disk_domain);
	RUN_TEST(test_cosine_domain);
	RUN_TEST(test_cap_domain);
	RUN_TEST(test_cap_far_end);
	RUN_TEST(test_uniform_hemisphere_domain);
	RUN_TEST(test_density_outside);
	RUN_TEST(test_chi_square);
	RUN_TEST(test_disk_chi_square);
	RUN_TEST(test_densities_integrate_to_one);
	RUN_TEST(test_disk_inverse_of_map);
	RUN_TEST(test_disk_map_of_inverse);
	RUN_TEST(test_cap_inverse_of_map);
	RUN_TEST(test_cap_map_of_inverse);
	RUN_TEST(test_inverse_in_square);
	return UNITY_END();
}
