/* test_linear.c - microfacet/linear.h: maps, their constructors and compositions. (What surfaces are under them:
 * test_smith_leadr.c.) */
#include "lobe/microfacet/smith.h"

#include "leadr_surfaces.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>

#define U 0x1p-24

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

/* --- constructors ------------------------------------------------------------------------------------------------- */

static int same(lobe_vec3 a, lobe_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static void test_stretch_has_the_same_bits(void)
{
	const float widths[] = {1e-5f, 1e-4f, 3e-3f, 0.1f, 0.7f, 1.0f};
	for (size_t i = 0; i < 6; i++)
		for (size_t j = 0; j < 6; j++) {
			const lobe_linear m = lobe_linear_stretch(widths[i], widths[j]);
			const lobe_stretch s = lobe_stretch_make(widths[i], widths[j]);
			TEST_ASSERT_TRUE(m.norm == s.norm);
			for (uint64_t k = 0; k < 2000; k++) {
				float w[3];
				test_direction(1, k, w);
				const lobe_vec3 v = lobe_vec3_make(w[0], w[1], w[2]);
				TEST_ASSERT_TRUE(same(lobe_linear_direction(m, v), lobe_stretch_direction(s, v)));
				TEST_ASSERT_TRUE(same(lobe_linear_facet(m, v), lobe_stretch_facet(s, v)));
				TEST_ASSERT_TRUE(same(lobe_linear_normal(m, v), lobe_stretch_normal(s, v)));
			}
		}
	TEST_ASSERT_TRUE(lobe_linear_stretch(3.0f, 1.0f).xx == 3.0f);
	TEST_ASSERT_TRUE(isnan(lobe_linear_stretch(NAN, 1.0f).norm));
}

/* A A^T of a map, divided by 2: the covariance of a Beckmann surface. And A A^-1. */
typedef struct {
	double xx, yy, xy;
} covariance;

static covariance covariance_of(lobe_linear m)
{
	const double xx = (double)m.xx, xy = (double)m.xy, yx = (double)m.yx, yy = (double)m.yy;
	const covariance c = {0.5 * (xx * xx + xy * xy), 0.5 * (yx * yx + yy * yy), 0.5 * (xx * yx + xy * yy)};
	return c;
}

/* How far A A^-1 is from the identity, and norm from 1/(pi |det A|), where the rounding of the entries of A itself may
 * make U times the condition of it. */
static double inverse_error(lobe_linear m)
{
	const double xx = (double)m.xx, xy = (double)m.xy, yx = (double)m.yx, yy = (double)m.yy;
	const double ixx = (double)m.ixx, ixy = (double)m.ixy, iyx = (double)m.iyx, iyy = (double)m.iyy;
	const double det = xx * yy - xy * yx, norm2 = xx * xx + xy * xy + yx * yx + yy * yy;
	double worst = fabs((double)m.norm * PI * fabs(det) - 1.0);
	worst = worse(worst, fabs(ixx * xx + ixy * yx - 1.0));
	worst = worse(worst, fabs(iyx * xy + iyy * yy - 1.0));
	/* The other two have different units when the axes are not turned: relative to what cancels. */
	worst = worse(worst, fabs(ixx * xy + ixy * yy) / (fabs(ixx * xy) + 1e-300) * (xy != 0.0));
	worst = worse(worst, fabs(iyx * xx + iyy * yx) / (fabs(iyx * xx) + 1e-300) * (yx != 0.0));
	return worst / fmax(norm2 / fabs(det), 1.0);
}

static const double alphas[] = {1e-4, 1e-3, 0.05, 0.4, 1.0, 10.0};

static void test_constructors(void)
{
	double worst = 0.0, inverse = 0.0, rotated = 0.0, moments = 0.0, printed = 0.0;
	for (size_t i = 0; i < 6; i++)
		for (size_t j = 0; j < 6; j++) {
			const float ax = (float)alphas[i], ay = (float)alphas[j];
			for (size_t k = 0; k < 8; k++) {
				const float rho = (float)rhos[k];
				const double xx = 0.5 * (double)ax * (double)ax, yy = 0.5 * (double)ay * (double)ay;
				const double xy = 0.5 * (double)rho * (double)ax * (double)ay;
				const lobe_linear m = lobe_linear_correlated(ax, ay, rho);
				const covariance c = covariance_of(m);
				worst = worse(worst, fabs(c.xx / xx - 1.0));
				worst = worse(worst, fabs(c.yy / yy - 1.0));
				worst = worse(worst, fabs(c.xy - xy) / sqrt(xx * yy));
				inverse = worse(inverse, inverse_error(m));
				/* Through moments that are floats; widths below the least are another matter. */
				const float fx = (float)xx, fy = (float)yy, fxy = (float)xy;
				const lobe_linear n = lobe_linear_from_moments(0.0f, 0.0f, fx, fy, fxy);
				const double det = (double)fx * (double)fy - (double)fxy * (double)fxy;
				const double large = 0.5 * ((double)fx + (double)fy) +
						     hypot(0.5 * ((double)fx - (double)fy), (double)fxy);
				if (det / large > 0.51e-8) {
					const covariance d = covariance_of(n);
					/* det A = 2 sqrt(det Cov), which no cancellation may touch. */
					const double norm = 1.0 / (TWO_PI * sqrt(det));
					moments = worse(moments, fabs((double)n.norm / norm - 1.0));
					moments = worse(moments, fabs(d.xx - (double)fx) / large);
					moments = worse(moments, fabs(d.yy - (double)fy) / large);
					moments = worse(moments, fabs(d.xy - (double)fxy) / large);
					inverse = worse(inverse, inverse_error(n));
					const float cancels = fx * fy - fxy * fxy;
					printed = larger(printed, fabs((double)cancels / det - 1.0));
				}
			}
			const double angle = 0.37 + (double)i;
			const double c = cos(angle), s = sin(angle), a2 = (double)ax * (double)ax,
				     b2 = (double)ay * (double)ay;
			const lobe_linear m = lobe_linear_rotated(ax, ay, (float)angle);
			const covariance r = covariance_of(m);
			rotated = worse(rotated, fabs(r.xx - 0.5 * (c * c * a2 + s * s * b2)) / (a2 + b2));
			rotated = worse(rotated, fabs(r.yy - 0.5 * (s * s * a2 + c * c * b2)) / (a2 + b2));
			rotated = worse(rotated, fabs(r.xy - 0.5 * c * s * (a2 - b2)) / (a2 + b2));
			inverse = worse(inverse, inverse_error(m));
		}
	measured("correlated: A A^T/2 against the covariance, in U", worst / U, 6.0);
	measured("rotated: the same, in U of the larger axis", rotated / U, 12.0);
	measured("from_moments: A A^T/2 and norm, in U", moments / U, 12.0);
	measured("A A^-1 and norm pi det, in U condition(A)", inverse / U, 6.0);
	printf("  %-60s %11.4g\n", "var_x var_y - cov^2 in float: relative error", printed);
	TEST_ASSERT_TRUE(printed > 1e3 * U);
	/* What cannot be: a covariance too large, no variance, numbers that are none, rho beyond 1. */
	const lobe_linear bad = lobe_linear_from_moments(0.0f, 0.0f, 0.5f, 0.5f, 0.51f);
	measured("|cov| too large: narrow axis", fabs(1.0 / (PI * (double)bad.norm * 1e-4 * sqrt(2.02)) - 1.0),
		 4.0 * U);
	TEST_ASSERT_TRUE(isnan(lobe_linear_from_moments(0.0f, 0.0f, NAN, 1.0f, 0.0f).norm));
	TEST_ASSERT_TRUE(isnan(lobe_linear_from_moments(0.0f, 0.0f, 1.0f, 1.0f, NAN).norm));
	TEST_ASSERT_TRUE(lobe_linear_correlated(0.5f, 0.5f, 1.0f).yx == lobe_linear_correlated(0.5f, 0.5f, 0.9999f).yx);
	TEST_ASSERT_TRUE(isnan(lobe_linear_correlated(0.5f, 0.5f, NAN).norm));
	TEST_ASSERT_FALSE(lobe_linear_make(1.0f, 2.0f, 2.0f, 4.0f, 0.0f, 0.0f).norm <= LOBE_REAL_MAX);
}

/* Two maps one after the other do what their composition does, and matrices of points multiply. */
static void test_composition(void)
{
	double worst = 0.0, points = 0.0, formula = 0.0;
	for (uint64_t i = 0; i < 2000; i++) {
		float p[16];
		for (uint64_t k = 0; k < 16; k++)
			p[k] = 2.0f * test_uniform(2, 16 * i + k) - 1.0f;
		p[3] += p[3] < 0.0f ? -1.0f : 1.0f; /* not singular */
		p[0] += p[3] < 0.0f ? -1.5f : 1.5f;
		const lobe_linear inner = lobe_linear_make(p[0], 0.5f * p[1], 0.5f * p[2], p[3], p[4], p[5]);
		const lobe_linear outer =
			lobe_linear_from_points(2.0f + p[6], p[7], p[8], 2.0f + p[9], p[10], p[11], 1.5f + p[12]);
		const lobe_linear both = lobe_linear_compose(outer, inner);
		float w[3];
		test_direction(3, i, w);
		const lobe_vec3 v = lobe_vec3_make(w[0], w[1], w[2]);
		const lobe_vec3 a[3] = {lobe_linear_direction(both, v), lobe_linear_normal(both, v),
					lobe_linear_facet(both, v)};
		const lobe_vec3 b[3] = {lobe_linear_direction(inner, lobe_linear_direction(outer, v)),
					lobe_linear_normal(outer, lobe_linear_normal(inner, v)),
					lobe_linear_facet(inner, lobe_linear_facet(outer, v))};
		for (int k = 0; k < 3; k++) {
			const lobe_vec3 d = lobe_vec3_fma(LOBE_R(-1.0), a[k], b[k]);
			worst = worse(worst, sqrt((double)lobe_dot(d, d) / (double)lobe_dot(a[k], a[k])));
		}
		worst = worse(worst, fabs((double)both.norm / ((double)inner.norm * (double)outer.norm * PI) - 1.0));

		/* Atanasov et al. 2022: h' = M^T h, w' = M^-1 w up to length, D_M = |det M| D(h')/|M^T h|^4. */
		const double M[3][3] = {{2.0 + (double)p[6], (double)p[7], 0.0},
					{(double)p[8], 2.0 + (double)p[9], 0.0},
					{(double)p[10], (double)p[11], 1.5 + (double)p[12]}};
		double h[3], back[3];
		const lobe_vec3 d = lobe_linear_direction(outer, v);
		const double dv[3] = {(double)d.x, (double)d.y, (double)d.z};
		for (int k = 0; k < 3; k++) {
			h[k] = back[k] = 0.0;
			for (int l = 0; l < 3; l++) {
				h[k] += M[l][k] * (double)w[l];
				back[k] += M[k][l] * dv[l];
			}
		}
		/* M d = w times a number, here zz. */
		for (int k = 0; k < 3; k++)
			points = worse(points, fabs(back[k] / M[2][2] - (double)w[k]));
		const double det = (M[0][0] * M[1][1] - M[0][1] * M[1][0]) * M[2][2];
		const leadr one = {LEADR_GGX, 1.0, 1.0, 0.0, 0.0, 0.0};
		const lobe_smith s = lobe_smith_make(lobe_distribution_make(LOBE_NDF_GGX), outer);
		/* leadr_d is of degree -4: the length of h falls out. */
		if (w[2] > 0.0f)
			formula = worse(
				formula,
				fabs((double)lobe_smith_d(s, v) / (fabs(det) * M[2][2] * leadr_d(&one, h)) - 1.0));
	}
	measured("composition against one after the other", worst, 100.0 * U);
	measured("w' = M^-1 w", points, 30.0 * U);
	measured("D_M = |det M| zz D(M^T h)/|M^T h|^4: relative", formula, 60.0 * U);
	/* Skewing the points: a shear of the plane, as Atanasov et al. write GGX. */
	const lobe_linear skew = lobe_linear_from_points(1.0f, 0.0f, 0.0f, 2.0f, 0.25f, -1.0f, 1.0f);
	TEST_ASSERT_TRUE(skew.xx == 1.0f && skew.yy == 0.5f && skew.mean_x == 0.25f && skew.mean_y == -0.5f);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_stretch_has_the_same_bits);
	RUN_TEST(test_constructors);
	RUN_TEST(test_composition);
	return UNITY_END() != 0;
}
