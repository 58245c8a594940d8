/* energy_table.h - the energy that a white GGX mirror keeps, E(mu, alpha), height-correlated, by quadrature made apart
 * from this library, to four digits. */
#ifndef LOBE_TESTS_ENERGY_TABLE_H
#define LOBE_TESTS_ENERGY_TABLE_H

enum { ENERGY_ALPHAS = 5, ENERGY_MUS = 6 };

static const double energy_alphas[ENERGY_ALPHAS] = {0.1, 0.25, 0.5, 0.75, 1.0};
static const double energy_mus[ENERGY_MUS] = {0.05, 0.1, 0.25, 0.5, 0.75, 1.0};
static const double energy_table[ENERGY_ALPHAS][ENERGY_MUS] = {
	{0.9118, 0.8835, 0.9216, 0.9692, 0.9831, 0.9883}, {0.9331, 0.8916, 0.8401, 0.8573, 0.8915, 0.9158},
	{0.9125, 0.8601, 0.7652, 0.6983, 0.6821, 0.6879}, {0.8806, 0.8107, 0.6802, 0.5646, 0.5014, 0.4639},
	{0.8478, 0.7602, 0.5976, 0.4507, 0.3645, 0.3069},
};

#endif
