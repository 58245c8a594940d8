/* sections.c - the report's sections, in the order of the page. */
#include "report.h"

extern const report_section strategies_section, report_approximations, stability_section, furnaces_section;

const report_section *const report_sections[] = {&strategies_section, &report_approximations, &stability_section,
						 &furnaces_section, NULL};
