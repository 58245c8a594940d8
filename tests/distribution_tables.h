/* distribution_tables.h - distributions chosen at run time for the test cases, single and double precision alike. */
#ifndef LOBE_TESTS_DISTRIBUTION_TABLES_H
#define LOBE_TESTS_DISTRIBUTION_TABLES_H

#include <stdint.h>

/* What lobe_distribution_phong, _gtr and _student_t make: norm, and the address of a table that stays. ndf: LOBE_NDF_*.
 * Of LOBE_NDF_TABULATED the density is exp(-3 tan theta). */
typedef struct {
	double norm;
	uint64_t table;
} distribution_table;

distribution_table distribution_table_of(uint32_t ndf, double exponent, double width);

#endif
