/* test_warp_density.c - densities of core/warp.h: samples follow them, by chi-square, and they integrate to 1. */
#include "chi_square.h"
#include "measured.h"
#include "support.h"
#include "unity.h"
#include "warp_points.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* A map of the square to directions, for tests that treat all alike. The disk is the point below the direction. */
typedef struct {
	const char *name;
	lobe_vec3 (*map)(lobe_vec2 u, float height);
	float (*pdf)(lobe_vec3 w, float height);
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

static float pdf_cap(lobe_vec3 w, float height)
{
	(void)w;
	return lobe_spherical_cap_pdf(height);
}

static const warp warps[] = {
	{"cosine hemisphere", map_cosine, pdf_cosine, 1.0f, 0.0},
	{"uniform hemisphere", map_uniform, pdf_uniform, 1.0f, 0.0},
	{"cap of height 0.3", lobe_spherical_cap, pdf_cap, 0.3f, 1.0 - (double)0.3f},
	{"cap of height 1.7", lobe_spherical_cap, pdf_cap, 1.7f, 1.0 - (double)1.7f},
	{"sphere", lobe_spherical_cap, pdf_cap, 2.0f, -1.0},
};
#define WARPS (sizeof warps / sizeof warps[0])

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
		const double area = TWO_PI * (double)cap_heights[k];
		measured("cap: |pdf times area - 1|", fabs((double)lobe_spherical_cap_pdf(cap_heights[k]) * area - 1.0),
			 3.0 * U);
	}
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_chi_square);
	RUN_TEST(test_disk_chi_square);
	RUN_TEST(test_densities_integrate_to_one);
	return UNITY_END();
}
