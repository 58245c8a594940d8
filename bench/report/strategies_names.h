/* strategies_names.h - what the sampling strategies of microfacet/strategy.h are called in tables, in their order. */
#ifndef LOBE_REPORT_STRATEGIES_NAMES_H
#define LOBE_REPORT_STRATEGIES_NAMES_H

#define STRATEGIES_NAMES                                                                                               \
	"visible normals", "uniform", "cosine", "plain NDF", "slopes 2014", "ellipsoid 2018", "cap 2023",            \
		"bounded cap", "V-cavity", "hemisphere"

#endif
