/* strategies.c - the report's section on sampling strategies. */
#include "strategies.h"

static void write(report_page *page, const report_table *const *tables, int quick)
{
	(void)page;
	(void)tables;
	(void)quick;
}

const report_section strategies_section = {
	"strategies",
	"Sampling strategies: error against time",
	{&strategies_map_study, &strategies_time_study, &strategies_batch_study, &strategies_curves_study,
	 &strategies_reference_study, &strategies_pictures_study},
	write,
};
