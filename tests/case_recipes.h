/* case_recipes.h - the numbers of cases.h: for every lobe, arguments of its make function. */
#ifndef LOBE_TESTS_CASE_RECIPES_H
#define LOBE_TESTS_CASE_RECIPES_H

#include "cases.h"

/* parameter: as in test_case, but that an index n + ik may stand for that of a metal; recipe_parameters writes it
 * out. */
typedef struct {
	const char *name;
	double parameter[CASE_PARAMETERS];
} recipe;

/* The recipes of the lobe of this kind, n of them. */
const recipe *recipes_of(lobe_uint kind, size_t *n);
void recipe_parameters(const recipe *r, double parameter[CASE_PARAMETERS]);

#endif
