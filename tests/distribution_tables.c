#include "distribution_tables.h"

#include "lobe/lobe.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { TABLES_MAX = 32 };

static struct {
	uint32_t ndf;
	double exponent, width;
	float words[LOBE_PROFILE_WORDS];
	distribution_table made;
} tables[TABLES_MAX];
static int count;

static double falls(void *context, double tan_theta)
{
	(void)context;
	return exp(-3.0 * tan_theta);
}

distribution_table distribution_table_of(uint32_t ndf, double exponent, double width)
{
	const float x = (float)exponent, a = (float)width;
	lobe_distribution d = lobe_distribution_make(ndf);
	lobe_status status = LOBE_OK;
	int i = 0;
	while (i < count && (tables[i].ndf != ndf || tables[i].exponent != exponent || tables[i].width != width))
		i++;
	if (i < count)
		return tables[i].made;
	if (i == TABLES_MAX)
		exit(2);
	float *const words = tables[i].words;
	if (ndf == LOBE_NDF_PHONG)
		status = lobe_distribution_phong(&d, words, LOBE_PROFILE_WORDS, x);
	else if (ndf == LOBE_NDF_GTR)
		status = lobe_distribution_gtr(&d, words, LOBE_PROFILE_WORDS, x, a);
	else if (ndf == LOBE_NDF_STUDENT_T)
		status = lobe_distribution_student_t(&d, words, LOBE_PROFILE_WORDS, x);
	else if (ndf == LOBE_NDF_TABULATED)
		status = lobe_distribution_tabulated(&d, words, LOBE_PROFILE_WORDS, falls, NULL);
	if (status != LOBE_OK) {
		printf("%s\n", lobe_error_message());
		exit(2);
	}
	tables[i].ndf = ndf;
	tables[i].exponent = exponent;
	tables[i].width = width;
	tables[i].made.norm = (double)d.norm;
	tables[i].made.table = lobe_table_address(d.table);
	count++;
	return tables[i].made;
}
