/* sections.c - the report's sections, in the order of the page. */
#include "report.h"

const report_section *const report_sections[] = {NULL};
