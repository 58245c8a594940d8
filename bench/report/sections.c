/* sections.c - the report's sections, in the order of the page. */
#include "report.h"

extern const report_section report_approximations;

const report_section *const report_sections[] = {&report_approximations, NULL};
