/* test_lobes.c - what every lobe promises about single samples and pairs of directions. */
#include "cases.h"
#include "directions.h"
#include "support.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>

void setUp(void) {}
void tearDown(void) {}

#define ULP 0x1p-23

static void test_every_lobe_has_cases(void)
{
#define LOBE_X(NAME, name, value)                                                                                      \
	{                                                                                                              \
		unsigned n = 0;                                                                                        \
		for (size_t i = 0; i < case_count(); i++)                                                              \
			n += case_at(i)->kind == LOBE_KIND_##NAME && case_at(i)->bsdf.kind == LOBE_KIND_##NAME;        \
		printf("  %-16s %u cases\n", #name, n);                                                                \
		TEST_ASSERT_GREATER_THAN_MESSAGE(2, n, "cases of " #name);                                             \
	}
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	TEST_ASSERT_NULL(case_at(case_count()));
}

static double component(lobe_rgb c, int k) { return (double)(k == 0 ? c.r : k == 1 ? c.g : c.b); }

static int all_zero(lobe_sample s)
{
	return s.pdf == 0.0f && s.wi.x == 0.0f && s.wi.y == 0.0f && s.wi.z == 0.0f && s.weight.r == 0.0f &&
	       s.weight.g == 0.0f && s.weight.b == 0.0f;
}

/* Counts of one sweep, so that a sweep over millions prints what it found before it fails. */
typedef struct {
	unsigned long samples, rejected, deltas, pdf_differs, not_zero, bad_event, wrong_side, not_unit, too_bright;
	double worst_length;
	const char *worst_length_case;
} tally;

/* The bits say what happened: one of reflect and transmit, one of delta, diffuse and glossy, and the side of wi agrees.
 */
static int event_is_sound(lobe_uint e)
{
	const lobe_uint way = e & (LOBE_EVENT_REFLECT | LOBE_EVENT_TRANSMIT);
	const lobe_uint shape = e & (LOBE_EVENT_DELTA | LOBE_EVENT_DIFFUSE | LOBE_EVENT_GLOSSY);
	return (way == LOBE_EVENT_REFLECT || way == LOBE_EVENT_TRANSMIT) &&
	       (shape == LOBE_EVENT_DELTA || shape == LOBE_EVENT_DIFFUSE || shape == LOBE_EVENT_GLOSSY) &&
	       (e & ~(way | shape)) == 0u;
}

static void check_sample(const test_case *c, lobe_vec3 wo, lobe_vec3 u, tally *t)
{
	const lobe_sample s = lobe_bsdf_sample(c->bsdf, wo, u);
	t->samples++;
	if (s.event == 0u) {
		t->rejected++;
		t->not_zero += !all_zero(s);
		return;
	}
	const lobe_real pdf = lobe_bsdf_pdf(c->bsdf, wo, s.wi);
	const lobe_rgb f = lobe_bsdf_eval(c->bsdf, wo, s.wi);
	const lobe_bsdf_value both = lobe_bsdf_eval_pdf(c->bsdf, wo, s.wi);
	t->pdf_differs += memcmp(&both.f, &f, sizeof f) != 0 || test_float_bits(both.pdf) != test_float_bits(pdf);
	if (s.event & LOBE_EVENT_DELTA) {
		t->deltas++;
		t->pdf_differs +=
			pdf != 0.0f || f.r != 0.0f || f.g != 0.0f || f.b != 0.0f || !(s.pdf > 0.0f && s.pdf <= 1.0f);
	} else {
		t->pdf_differs += test_float_bits(pdf) != test_float_bits(s.pdf) || !(s.pdf > 0.0f);
	}
	t->bad_event += !event_is_sound(s.event);
	t->wrong_side += (s.wi.z * wo.z > 0.0f) != ((s.event & LOBE_EVENT_REFLECT) != 0u) && s.wi.z * wo.z != 0.0f;
	const double x = (double)s.wi.x, y = (double)s.wi.y, z = (double)s.wi.z;
	const double length = fabs(sqrt(x * x + y * y + z * z) - 1.0);
	if (length > t->worst_length) {
		t->worst_length = length;
		t->worst_length_case = c->name;
	}
	t->not_unit += length > 8.0 * ULP;
	/* Visible-normal and cosine sampling: no sample gains energy, but for radiance that is squeezed into a smaller
	 * cone. */
	double bound = 1.0 + 8.0 * ULP;
	if ((s.event & LOBE_EVENT_TRANSMIT) && case_carries_radiance(c))
		bound *= pow(wo.z > 0.0f ? 1.0 / c->eta : c->eta, 2.0);
	const int coloured = (c->flags & CASE_COLOURED) != 0u;
	const double mean = (component(s.weight, 0) + component(s.weight, 1) + component(s.weight, 2)) / 3.0;
	if (c->flags & CASE_HEAVY)
		bound = (double)LOBE_REAL_MAX;
	for (int k = 0; k < 3; k++)
		t->too_bright +=
			!(component(s.weight, k) >= 0.0 && component(s.weight, k) <= bound * (coloured ? 3.0 : 1.0));
	t->too_bright += coloured && !(mean <= bound);
}

static void print_tally(const char *what, const tally *t)
{
	printf("  %-34s %9lu samples, %8lu rejected, %7lu delta; pdf differs %lu, rest of no sample %lu, bits %lu, "
	       "side %lu, "
	       "too bright %lu\n",
	       what, t->samples, t->rejected, t->deltas, t->pdf_differs, t->not_zero, t->bad_event, t->wrong_side,
	       t->too_bright);
	printf("  %-34s | |wi| - 1 | <= %.1e (%s), above 8 ulp in %lu\n", "", t->worst_length,
	       t->worst_length_case ? t->worst_length_case : "-", t->not_unit);
}

static tally sweep;

static void sweep_all(void)
{
	const uint32_t n = test_long() ? 50000u : 4000u;
	uint32_t stream = 5000u;
	for (size_t i = 0; i < case_count(); i++) {
		const test_case *c = case_at(i);
		for (size_t k = 0; k < case_wo_count(c); k++, stream++)
			for (uint32_t j = 0; j < n; j++) {
				float u[3];
				test_u3(stream, j, u);
				check_sample(c, case_wo(k), vec3(u), &sweep);
			}
	}
	print_tally("all cases, cos 1 to 1e-6", &sweep);
}

static void test_sample_pdf_is_pdf_bit_for_bit(void)
{
	TEST_ASSERT_GREATER_THAN(2000000, sweep.samples);
	TEST_ASSERT_GREATER_THAN(10000, sweep.deltas);
	TEST_ASSERT_EQUAL_UINT(0, sweep.pdf_differs);
}

static void test_no_sample_is_all_zero(void)
{
	TEST_ASSERT_GREATER_THAN(10000, sweep.rejected);
	TEST_ASSERT_EQUAL_UINT(0, sweep.not_zero);
}

static void test_event_bits_tell_what_happened(void)
{
	TEST_ASSERT_EQUAL_UINT(0, sweep.bad_event);
	TEST_ASSERT_EQUAL_UINT(0, sweep.wrong_side);
}

static void test_no_sample_gains_energy(void) { TEST_ASSERT_EQUAL_UINT(0, sweep.too_bright); }

static void test_sampled_directions_are_unit(void) { TEST_ASSERT_EQUAL_UINT(0, sweep.not_unit); }

/* Where another renderer's sample and pdf disagree: peer figures are Mitsuba 3.9, 1M samples each. */
static void test_pdf_agrees_where_peers_disagree(void)
{
	static const struct {
		const char *name;
		double alpha, eta, cos_o, peer;
	} peers[] = {
		{"conductor .0001, cos .001", 1e-4, 0.0, 1e-3, 91.0},
		{"conductor .001, cos .001", 1e-3, 0.0, 1e-3, 17.0},
		{"dielectric .001 1.0001, cos .7", 1e-3, 1.0001, 0.7, 94.0},
		{"dielectric .1 1.0001, cos .7", 0.1, 1.0001, 0.7, 0.4},
	};
	for (size_t i = 0; i < sizeof peers / sizeof *peers; i++) {
		const lobe_real a = (lobe_real)peers[i].alpha;
		const double s = sqrt((1.0 - peers[i].cos_o) * (1.0 + peers[i].cos_o));
		const lobe_vec3 wo = lobe_vec3_make((float)(0.8 * s), (float)(0.6 * s), (float)peers[i].cos_o);
		test_case c = {peers[i].name, 0, {0}, {0}, 0, peers[i].alpha, peers[i].alpha, peers[i].eta, 0, TEXTBOOK_GGX};
		c.bsdf =
			peers[i].eta > 0.0
				? lobe_bsdf_from_ggx_dielectric(lobe_ggx_dielectric_make(a, a, (lobe_real)peers[i].eta))
				: lobe_bsdf_from_ggx_conductor(lobe_ggx_conductor_make(
					  a, a, lobe_metal_eta(LOBE_METAL_GOLD), lobe_metal_k(LOBE_METAL_GOLD)));
		tally t = {0};
		for (uint32_t j = 0; j < 1000000u; j++) {
			float u[3];
			test_u3(100u + (uint32_t)i, j, u);
			check_sample(&c, wo, vec3(u), &t);
		}
		print_tally(peers[i].name, &t);
		printf("  %-34s sample().pdf differs from pdf() in %.4f %%; peer %.1f %%\n", "",
		       100.0 * (double)t.pdf_differs / (double)t.samples, peers[i].peer);
		TEST_ASSERT_EQUAL_UINT(0, t.pdf_differs);
	}
}

/* weight is a short closed form, eval and pdf share D and the facet: only masking and a dozen roundings separate them,
 * whatever the roughness. 16 ulp are asserted wherever eval and pdf are normal floats. */
static void test_weight_is_eval_over_pdf(void)
{
	double worst[3] = {0}, worst_at[3] = {0};
	const char *where[3] = {"-", "-", "-"};
	unsigned long n = 0, bad = 0;
	uint32_t stream = 9000u;
	for (size_t i = 0; i < case_count(); i++) {
		const test_case *c = case_at(i);
		const int group = c->kind == LOBE_KIND_LAMBERT ? 0 : c->flags & CASE_TRANSMITS ? 2 : 1;
		for (size_t k = 0; k < case_wo_count(c); k++, stream++)
			for (uint32_t j = 0; j < 1000u; j++) {
				float u[3];
				test_u3(stream, j, u);
				const lobe_vec3 wo = case_wo(k);
				const lobe_sample s = lobe_bsdf_sample(c->bsdf, wo, vec3(u));
				if (s.event == 0u || (s.event & LOBE_EVENT_DELTA))
					continue;
				const lobe_rgb f = lobe_bsdf_eval(c->bsdf, wo, s.wi);
				for (int m = 0; m < 3; m++) {
					const double w = component(s.weight, m), e = component(f, m);
					const double ratio = e / (double)s.pdf;
					if (w == 0.0 && e == 0.0)
						continue;
					if (fmin(fmin(w, e), (double)s.pdf) < 0x1p-120)
						continue;
					const double ulps = fabs(w - ratio) / (ULP * ratio);
					n++;
					bad += ulps > 16.0;
					if (ulps > worst[group]) {
						worst[group] = ulps;
						where[group] = c->name;
						worst_at[group] = (double)wo.z;
					}
				}
			}
	}
	printf("  %lu weights against eval/pdf:", n);
	for (int g = 0; g < 3; g++)
		printf(" %s at most %.2f ulp (%s, cos %.0e)%s",
		       g == 0   ? "diffuse"
		       : g == 1 ? "reflecting"
				: "transmitting",
		       worst[g], where[g], worst_at[g], g < 2 ? ";" : "\n");
	TEST_ASSERT_GREATER_THAN(1000000, n);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

/* Index of refraction on w's side. */
static double index_at(const test_case *c, lobe_vec3 w)
{
	return (c->flags & CASE_TRANSMITS) && w.z < 0.0f ? c->eta : 1.0;
}

/* How much a relative rounding of 1/eta counts in a refraction: H = o + e i is the small difference of two unit vectors
 * where eta is near 1, and D falls within alpha |H|. */
static double index_condition(const test_case *c, lobe_vec3 wo, lobe_vec3 wi)
{
	if (!(c->flags & CASE_TRANSMITS) || wo.z * wi.z > 0.0f)
		return 0.0;
	const double e = wo.z > 0.0f ? c->eta : 1.0 / c->eta;
	const double x = (double)wo.x + e * (double)wi.x, y = (double)wo.y + e * (double)wi.y,
		     z = (double)wo.z + e * (double)wi.z;
	const double ax2 = c->alpha_x * c->alpha_x, ay2 = c->alpha_y * c->alpha_y;
	const double slope = sqrt(x * x / (ax2 * ax2) + y * y / (ay2 * ay2) + z * z);
	const double q = x * x / ax2 + y * y / ay2 + z * z, h = sqrt(x * x + y * y + z * z);
	const double oh = fabs((double)wo.x * x + (double)wo.y * y + (double)wo.z * z);
	const double ih = fabs((double)wi.x * x + (double)wi.y * y + (double)wi.z * z);
	/* D's exponent 4 on H, both cosines, total reflection near, and Fresnel's e^2 - 1. */
	const double g2 = oh * oh / (h * h) + (e - 1.0) * (e + 1.0);
	const double tir = g2 > 0.0 ? (1.0 + e * e) / g2 : 1e9;
	return (4.0 * slope / q + 1.0 / oh + 1.0 / ih) * fmax(1.0, e) + tir + e / fabs(e - 1.0);
}

/* What both sides see of a cavity's side is G1(o) + G1(i) - 1, a difference where little is left. */
static double cavity_condition(const test_case *c, lobe_vec3 wo, lobe_vec3 wi)
{
	if (c->kind != LOBE_KIND_MICROFACET_DIELECTRIC || wo.z * wi.z > 0.0f ||
	    c->bsdf.as.microfacet_dielectric.surface.masking != LOBE_MASKING_VCAVITY)
		return 0.0;
	const double e = wo.z > 0.0f ? c->eta : 1.0 / c->eta;
	const double x = (double)wo.x + e * (double)wi.x, y = (double)wo.y + e * (double)wi.y,
		     z = (double)wo.z + e * (double)wi.z;
	const double oh = (double)wo.x * x + (double)wo.y * y + (double)wo.z * z;
	const double ih = (double)wi.x * x + (double)wi.y * y + (double)wi.z * z;
	const double g_o = fmin(1.0, fabs(2.0 * z * (double)wo.z / oh)), g_i = fmin(1.0, fabs(2.0 * z * (double)wi.z / ih));
	return (g_o + g_i) * (1.0 + e / fabs(z) + 1.0 / fabs(oh) + e / fabs(ih)) / fabs(g_o + g_i - 1.0);
}

/* f(wo,wi) n_i^2 = f(wi,wo) n_o^2 for radiance, and the importance of one way is the radiance of the other. */
static void test_reciprocity(void)
{
	double worst[2] = {0}, worst_ratio = 0.0;
	unsigned long n[2] = {0}, bad = 0;
	for (size_t i = 0; i < case_count(); i++) {
		const test_case *c = case_at(i);
		if (!(c->flags & CASE_RECIPROCAL))
			continue;
		const uint32_t count = 20000u;
		for (uint32_t j = 0; j < count; j++) {
			float a[3], u[3];
			test_direction(20000u + (uint32_t)i, j, a);
			if (!(c->flags & CASE_TWO_SIDED))
				a[2] = fabsf(a[2]);
			const lobe_vec3 wo = vec3(a);
			/* Half of the partners are samples, so that narrow lobes are met too. */
			test_u3(30000u + (uint32_t)i, j, u);
			lobe_vec3 wi = lobe_bsdf_sample(c->bsdf, wo, vec3(u)).wi;
			if (j & 1u) {
				test_direction(40000u + (uint32_t)i, j, a);
				wi = vec3(a);
			}
			const int across = wo.z * wi.z < 0.0f;
			const int radiance = case_carries_radiance(c);
			const lobe_rgb f = lobe_bsdf_eval(c->bsdf, wo, wi);
			lobe_rgb back = lobe_bsdf_eval(c->bsdf, wi, wo);
			double no = index_at(c, wo), ni = index_at(c, wi);
			if (c->flags & CASE_TRANSMITS) {
				/* Every other pair tests the two transports against each other. */
				if (!radiance || (j & 2u)) {
					back = lobe_bsdf_eval(case_with_other_transport(c), wi, wo);
					no = ni = 1.0;
				}
			} else {
				no = ni = 1.0;
			}
			const double l = component(f, 1) / fabs((double)wi.z) * ni * ni;
			const double r = component(back, 1) / fabs((double)wo.z) * no * no;
			const double big = fmax(l, r);
			if (!(big > 1e-25) || big > 1e30)
				continue;
			/* 32 roundings, each of half an ulp. */
			const double film = across ? case_film_condition(c) : 1.0;
			const double condition = film * (1.0 + index_condition(c, wo, wi) + index_condition(c, wi, wo) +
							cavity_condition(c, wo, wi));
			const double off = fabs(l - r) / big;
			const double ratio = off / (0.5 * ULP * condition);
			if (condition > 1e5)
				continue;
			n[across]++;
			if (condition < 100.0)
				worst[across] = fmax(worst[across], off);
			worst_ratio = fmax(worst_ratio, ratio);
			if (ratio > 32.0 && bad++ < 5)
				printf("  %s: wo (%.9g %.9g %.9g) wi (%.9g %.9g %.9g) %.9g back %.9g condition %.3g\n",
				       c->name, (double)wo.x, (double)wo.y, (double)wo.z, (double)wi.x, (double)wi.y,
				       (double)wi.z, l, r, condition);
		}
	}
	printf("  reflection  %7lu pairs: relative difference <= %.2e\n", n[0], worst[0]);
	printf("  refraction  %7lu pairs: relative difference <= %.2e where well conditioned, at most %.1f half ulp "
	       "times the "
	       "condition anywhere\n",
	       n[1], worst[1], worst_ratio);
	TEST_ASSERT_GREATER_THAN(100000, n[0]);
	TEST_ASSERT_GREATER_THAN(50000, n[1]);
	TEST_ASSERT_EQUAL_UINT(0, bad);
}

int main(void)
{
	UNITY_BEGIN();
	RUN_TEST(test_every_lobe_has_cases);
	sweep_all();
	RUN_TEST(test_sample_pdf_is_pdf_bit_for_bit);
	RUN_TEST(test_no_sample_is_all_zero);
	RUN_TEST(test_event_bits_tell_what_happened);
	RUN_TEST(test_no_sample_gains_energy);
	RUN_TEST(test_sampled_directions_are_unit);
	RUN_TEST(test_pdf_agrees_where_peers_disagree);
	RUN_TEST(test_weight_is_eval_over_pdf);
	RUN_TEST(test_reciprocity);
	return UNITY_END() != 0;
}
