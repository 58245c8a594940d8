/* test_refract.c - refraction and reflection of core/fresnel.h: unit, in the plane of incidence, by Snell's law, and
 * back. */
#include "lobe/core/fresnel.h"

#include "directions.h"
#include "fresnel_exact.h"
#include "measured.h"
#include "support.h"
#include "unity.h"

#include <math.h>

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

typedef struct {
	double x, y, z;
} vec;

static vec to_double(lobe_vec3 v)
{
	const vec d = {(double)v.x, (double)v.y, (double)v.z};
	return d;
}

static double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static vec cross(vec a, vec b)
{
	const vec c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
	return c;
}

static vec combine(double s, vec a, double t, vec b)
{
	const vec c = {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
	return c;
}

static double length(vec a) { return sqrt(dot(a, a)); }

#define RAYS 400000

/* Number i of many w and m with w.m > 0, and an index; some nearly parallel, some grazing. */
typedef struct {
	lobe_vec3 w, m;
	float c, eta;
} ray;

static int make_ray(uint64_t i, ray *r)
{
	const double bend = pow(10.0, -4.0 * (double)test_uniform(12, i));
	r->m = random_direction(10, i);
	lobe_vec3 w = random_direction(11, i);
	if (i % 3 == 1) /* close to m */
		w = lobe_normalize(lobe_vec3_fma((float)bend, w, r->m));
	if (i % 3 == 2) /* close to the surface */
		w = lobe_normalize(lobe_vec3_fma(lobe_dot(w, r->m) * ((float)bend - 1.0f), r->m, w));
	if (lobe_dot(w, r->m) < 0.0f)
		w = lobe_vec3_scale(w, -1.0f);
	r->w = w;
	r->c = lobe_dot(w, r->m);
	r->eta = i % 5 == 0 ? index_of((int)(i / 5 % INDICES))
			    : (float)pow(4.0, 2.0 * (double)test_uniform(13, i) - 1.0);
	return r->c > 0.0f;
}

/* w and m are unit to rounding: |w|^2 and |m|^2 are off by 2 U or so (up to 9 U from lobe_normalize), c by 3 U. Divided
 *by eta, whatever that leaves in w + (g - c) m grows by 1/eta, its square by 1/eta^2, into a thinner medium; into a
 *denser one g - c is up to eta and carries the errors of m. So all errors here are in units of U max(1, 1/eta)^2: unit
 *length: (9 + 2*3 + 9 + 2*7)/2 of those and the last two roundings, 3: 22 in-plane, Snell: t is a combination of w and
 *m up to its own rounding, 3 U in each component of length up to 1, and of 1/eta: 3 + 2 */
static void test_refract(void)
{
	worst unit = {0}, plane = {0}, snell = {0}, side = {0}, cosine_error = {0};
	for (uint64_t i = 0; i < RAYS; i++) {
		ray r;
		if (!make_ray(i, &r))
			continue;
		const lobe_fresnel f = lobe_fresnel_dielectric(r.c, r.eta);
		if (!(f.transmittance > 0.0f))
			continue;
		const vec w = to_double(r.w), m = to_double(r.m);
		const vec t = to_double(lobe_refract(r.w, r.m, 1.0f / r.eta, f));
		const double eta = (double)r.eta, scale = larger(1.0, 1.0 / eta), square = scale * scale;
		keep_worst(&unit, fabs(length(t) - 1.0) / square, r.c, r.eta);
		/* The part of t out of the plane of w and m, where there is a plane. */
		const vec normal = cross(w, m);
		if (length(normal) > 1e-3)
			keep_worst(&plane, fabs(dot(t, normal)) / length(normal) / scale, r.c, r.eta);
		/* w x m = eta (m x t): sines on one side eta times those on the other, and of opposite direction. */
		const vec difference = combine(1.0, normal, -eta, cross(m, t));
		keep_worst(&snell, length(difference) / eta / scale, r.c, r.eta);
		keep_worst(&side, dot(t, m), r.c, r.eta);
		keep_worst(&cosine_error, fabs(-dot(t, m) - (double)f.cos_t) / square, r.c, r.eta);
	}
	measured_at("refract: | |t| - 1 | / max(1, 1/eta)^2", unit, 22.0 * U);
	measured_at("refract: out of the plane / max(1, 1/eta)", plane, 5.0 * U);
	measured_at("refract: Snell / max(1, 1/eta)", snell, 6.0 * U);
	measured_at("refract: |t.m + cos_t| / max(1, 1/eta)^2", cosine_error, 22.0 * U);
	/* Beyond the surface, up to the rounding of a grazing direction. */
	measured_at("refract: t.m", side, 0.0);
}

static void test_refract_straight(void)
{
	double worst_near = 0.0;
	for (uint64_t i = 0; i < 100000; i++) {
		ray r;
		if (!make_ray(i, &r))
			continue;
		lobe_vec3 t = lobe_refract(r.w, r.m, 1.0f, lobe_fresnel_dielectric(r.c, 1.0f));
		TEST_ASSERT_TRUE(t.x == -r.w.x && t.y == -r.w.y && t.z == -r.w.z);
		/* Near eta = 1 t turns from -w by (eta - 1) tan theta: no jump, and no loss of the small angle. */
		if (r.c > 0.1f) {
			const float eta = 1.0f + 0x1p-20f;
			t = lobe_refract(r.w, r.m, 1.0f / eta, lobe_fresnel_dielectric(r.c, eta));
			const double sine = length(cross(to_double(r.w), to_double(r.m)));
			const double turned = length(cross(to_double(t), to_double(r.w)));
			worst_near = larger(worst_near, fabs(turned - 0x1p-20 * sine / (double)r.c));
		}
	}
	/* Three components with 3 roundings of numbers up to 1. */
	measured("refract: turning by (eta-1) tan theta at 1 + 2^-20", worst_near, 3.0 * U);
}

/* Back from the other side, with 1/eta, the ray comes out where it came from. */
static void test_refract_round_trip(void)
{
	worst back = {0}, fresnel = {0};
	for (uint64_t i = 0; i < RAYS; i++) {
		ray r;
		if (!make_ray(i, &r))
			continue;
		const lobe_fresnel f = lobe_fresnel_dielectric(r.c, r.eta);
		if (f.cos_t < 0.01f || r.c < 0.01f)
			continue;
		const lobe_vec3 t = lobe_refract(r.w, r.m, 1.0f / r.eta, f);
		const lobe_vec3 m = lobe_vec3_scale(r.m, -1.0f);
		const float c = lobe_dot(t, m), eta = 1.0f / r.eta;
		const lobe_fresnel g = lobe_fresnel_dielectric(c, eta);
		const lobe_vec3 w = lobe_refract(t, m, 1.0f / eta, g);
		const double scale = larger((double)r.eta, 1.0 / (double)r.eta);
		/* An error e of c or eta moves the cosine on the other side by e over that cosine. */
		const double sharp = fmin((double)r.c, (double)f.cos_t);
		keep_worst(&back, length(combine(1.0, to_double(w), -1.0, to_double(r.w))) * sharp / (scale * scale),
			   r.c, r.eta);
		/* R is the same from both sides. */
		keep_worst(&fresnel,
			   fabs((double)g.reflectance - (double)f.reflectance) * sharp * sharp / (scale * scale), r.c,
			   r.eta);
	}
	/* Twice the errors of one refraction in length and cosine (22 each), and 1/eta rounded. */
	measured_at("refract back: |w' - w| cos / max(eta, 1/eta)^2", back, 89.0 * U);
	measured_at("refract back: |R' - R| cos^2 / max(eta, 1/eta)^2", fresnel, 89.0 * U);
}

static void test_reflect(void)
{
	double angle = 0.0, unit = 0.0;
	for (uint64_t i = 0; i < 200000; i++) {
		ray r;
		if (!make_ray(i, &r))
			continue;
		const vec w = to_double(r.w), m = to_double(r.m), t = to_double(lobe_reflect(r.w, r.m, r.c));
		/* w + t is along m. */
		angle = larger(angle, length(cross(combine(1.0, w, 1.0, t), m)));
		unit = larger(unit, fabs(length(t) - 1.0));
	}
	/* |t|^2 = |w|^2 + 4 c (c |m|^2 - w.m): 9 + 4(9 + 3) at worst, half of it, and a rounding. */
	measured("reflect: (w + t) x m", angle, 2.0 * U);
	measured("reflect: | |t| - 1 |", unit, 29.5 * U);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_refract);
	RUN_TEST(test_refract_straight);
	RUN_TEST(test_refract_round_trip);
	RUN_TEST(test_reflect);
	return UNITY_END();
}
