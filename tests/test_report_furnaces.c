/* test_report_furnaces.c - the report's furnaces: every lobe is there, energies and their errors against closed forms
 * and a table made apart from this library, and light that is made - one percent of it, or for want of masking - is
 * found. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "energy_table.h"
#include "csv.h"
#include "furnaces.h"
#include "measured.h"
#include "unity.h"

void setUp(void) { measured_reset(); }
void tearDown(void) { TEST_ASSERT_TRUE_MESSAGE(!measured_outside()[0], measured_outside()); }

static const furnaces_surface *named(const char *name)
{
	for (size_t i = 0; i < furnaces_surface_count; i++)
		if (strcmp(furnaces_surfaces[i].name, name) == 0)
			return &furnaces_surfaces[i];
	TEST_FAIL_MESSAGE(name);
	return NULL;
}

/* Adding a lobe to lobes.def asks for its furnace. */
static void test_every_lobe_has_a_furnace(void)
{
	static const char *const lobes[] = {
#define LOBE_X(NAME, name, kind) #name,
#include "lobe/lobes/lobes.def"
#undef LOBE_X
	};
	for (size_t l = 0; l < sizeof lobes / sizeof *lobes; l++) {
		size_t found = 0;
		for (size_t i = 0; i < furnaces_surface_count; i++)
			found += strcmp(furnaces_surfaces[i].lobe, lobes[l]) == 0;
		TEST_ASSERT_TRUE_MESSAGE(found > 0, lobes[l]);
	}
}

static double mean(const furnaces_energy *e) { return (e->rgb[0] + e->rgb[1] + e->rgb[2]) / 3.0; }

/* --- energies ----------------------------------------------------------------------------------------------------- */

/* GGX of width 1 and F = 1: 1 - mu log((1 + mu)/mu), separable 2 (1 - log 2)/(1 + mu). */
static void test_energies_are_exact_at_alpha_1(void)
{
	static const double mus[] = {0.95, 0.7, 0.3, 0.05};
	double off[2] = {0.0, 0.0}, over = 0.0;
	for (size_t i = 0; i < sizeof mus / sizeof *mus; i++) {
		const double mu = (double)(float)mus[i];
		const double exact[2] = {1.0 - mu * log((1.0 + mu) / mu), 2.0 * (1.0 - log(2.0)) / (1.0 + mu)};
		static const char *const names[2] = {"Smith height-correlated", "Smith separable"};
		for (int k = 0; k < 2; k++) {
			const furnaces_energy e = furnaces_energy_at(named(names[k]), 1.0, mus[i], FURNACES_FINE);
			off[k] = larger(off[k], fabs(mean(&e) - exact[k]));
			over = larger(over, fabs(mean(&e) - exact[k]) - e.error);
		}
	}
	measured("GGX alpha 1 height-correlated: energy off", off[0], 1e-6);
	measured("GGX alpha 1 separable: energy off", off[1], 1e-6);
	measured("beyond the error that it states", over, 1e-6);
}

/* energy_table.h */
static void test_energies_match_the_reference_table(void)
{
	double off = 0.0;
	for (int a = 0; a < ENERGY_ALPHAS; a++)
		for (int i = 0; i < ENERGY_MUS; i++) {
			const furnaces_energy e = furnaces_energy_at(named("ggx_conductor"), energy_alphas[a],
								     energy_mus[i], FURNACES_FINE);
			off = larger(off, fabs(mean(&e) - energy_table[a][i]));
		}
	measured("E(mu, alpha), 30 entries of four digits: off", off, 6e-5);
}

/* On a few cells of every surface, what the rough integral states against a finer one. */
static void test_stated_errors_hold(void)
{
	double worst = 0.0;
	const char *which = "-";
	for (size_t s = 0; s < furnaces_surface_count; s++)
		for (size_t i = 0; i < 8; i++) {
			const double value = furnaces_value(&furnaces_surfaces[s], 3 * i % 8, 8),
				     mu = 0.03 + 0.12 * (double)i;
			const furnaces_energy rough =
				furnaces_energy_at(&furnaces_surfaces[s], value, mu, FURNACES_ROUGH);
			const furnaces_energy fine =
				furnaces_energy_at(&furnaces_surfaces[s], value, mu, FURNACES_FINEST);
			const double over = fabs(mean(&rough) - mean(&fine)) - rough.error - FURNACES_ROUNDING;
			if (over > worst) {
				worst = over;
				which = furnaces_surfaces[s].name;
			}
		}
	printf("  worst: %s\n", which);
	measured("rough energies off by more than they state", worst, 1e-12);
}

/* --- planted errors ----------------------------------------------------------------------------------------------- */

static lobe_rgb brighter(lobe_bsdf b, lobe_vec3 wo, lobe_vec3 wi)
{
	return lobe_rgb_scale(lobe_bsdf_eval(b, wo, wi), 1.01f);
}

/* f without its masking of light: G1 of the view alone. */
static lobe_rgb unshadowed(lobe_bsdf b, lobe_vec3 wo, lobe_vec3 wi)
{
	const lobe_stretch s = b.as.ggx_conductor.stretch;
	const lobe_vec3 i = lobe_stretch_direction(s, wi);
	const lobe_real g1 = wi.z / (wi.z + lobe_ggx_hidden(i));
	return lobe_rgb_scale(lobe_bsdf_eval(b, wo, wi), wi.z > 0.0f ? 1.0f / g1 : 0.0f);
}

/* The rows that the section would have of that surface, judged as it judges them. */
static int found(const furnaces_surface *s, size_t *row, double *energy)
{
	report_rows rows = {NULL, 0, 0};
	for (size_t i = 0; i < 11; i++)
		furnaces_white_rows(s, i, 1, &rows);
	const report_table *t = report_table_make("planted", furnaces_white.columns, rows.text);
	const int gains = furnaces_gains(t, NULL, row);
	*energy = furnaces_mean(t, *row);
	report_rows_free(&rows);
	return gains;
}

static void test_light_that_is_made_is_found(void)
{
	furnaces_surface s = *named("ggx_conductor");
	size_t row;
	double energy;
	TEST_ASSERT_FALSE(found(&s, &row, &energy));
	printf("  ggx_conductor: at most %.6f\n", energy);
	s.eval = brighter;
	TEST_ASSERT_TRUE(found(&s, &row, &energy));
	printf("  1 %% brighter: %.6f\n", energy);
	TEST_ASSERT_DOUBLE_WITHIN(2e-4, 1.01, energy);
	s.eval = unshadowed;
	TEST_ASSERT_TRUE(found(&s, &row, &energy));
	printf("  shadowing left out: %.6f\n", energy);
	s = *named("beckmann_dielectric 1.5");
	TEST_ASSERT_FALSE(found(&s, &row, &energy));
	s.eval = brighter;
	TEST_ASSERT_TRUE(found(&s, &row, &energy));
	/* Comparison surfaces are not held to it, but judged under their name. */
	s = *named("no masking");
	TEST_ASSERT_FALSE(found(&s, &row, &energy));
	s.no_surface = 0;
	TEST_ASSERT_TRUE(found(&s, &row, &energy));
}

/* --- weak furnaces ------------------------------------------------------------------------------------------------ */

static void test_weak_furnaces(void)
{
	static const unsigned maskings[] = {
		LOBE_MASKING_NONE,        LOBE_MASKING_IMPLICIT,           LOBE_MASKING_SCHLICK_SMITH,
		LOBE_MASKING_SCHLICK_GGX, LOBE_MASKING_SCHLICK_GGX_LIGHTS, LOBE_MASKING_DISNEY};
	static const double mus[] = {1.0, 0.5, 0.1, 0.02};
	double held = 0.0, known = 0.0, planted = HUGE_VAL;
	for (unsigned shape = 0; shape < FURNACES_SHAPES; shape++)
		for (size_t i = 0; i < 4; i++)
			for (unsigned k = 0; k < 2; k++) {
				const furnaces_energy e = furnaces_weak_at(
					shape, k ? LOBE_MASKING_VCAVITY : LOBE_MASKING_SMITH, 0.35, mus[i], 0.0);
				held = larger(held, fabs(e.rgb[0] - 1.0));
			}
	for (size_t m = 0; m < sizeof maskings / sizeof *maskings; m++)
		for (size_t i = 0; i < 4; i++) {
			const double exact = furnaces_weak_known(maskings[m], 0.5, mus[i]);
			const furnaces_energy e = furnaces_weak_at(0, maskings[m], 0.5, mus[i], 0.0);
			known = larger(known, fabs(e.rgb[0] / exact - 1.0));
		}
	/* Masking of a surface that is 1 % wider. */
	for (unsigned shape = 0; shape < FURNACES_SHAPES; shape++) {
		const furnaces_energy e = furnaces_weak_at(shape, LOBE_MASKING_SMITH, 0.35, 0.1, 0.01);
		planted = fmin(planted, fabs(e.rgb[0] - 1.0));
	}
	measured("|weak furnace - 1|, Smith and V-cavities", held, 2e-6);
	measured("weak furnaces against closed forms, relative", known, 2e-6);
	printf("  Lambda of a surface 1 %% wider: off by %.1e or more\n", planted);
	TEST_ASSERT_TRUE(planted > 100.0 * held);
}

int main(void)
{
	UNITY_BEGIN();
	furnaces_prepare();
	RUN_TEST(test_every_lobe_has_a_furnace);
	RUN_TEST(test_energies_are_exact_at_alpha_1);
	RUN_TEST(test_energies_match_the_reference_table);
	RUN_TEST(test_stated_errors_hold);
	RUN_TEST(test_light_that_is_made_is_found);
	RUN_TEST(test_weak_furnaces);
	return UNITY_END();
}
