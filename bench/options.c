/* options.c - the command line of build/bench/throughput. */
#include "options.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"

static const char help[] =
	"usage: throughput [options]\n"
	"Measures shading throughput, its ceilings and scaling, the build time of OpenCL programs and what leaving "
	"things\n"
	"out saves.\n"
	"  --lobe NAME     this lobe only\n"
	"  --verb NAME     this verb only: eval, pdf, eval+pdf, sample, sample_wi (without weight and pdf)\n"
	"  --device NAME   this device only, e.g. native:1, native, opencl:0\n"
	"  --threads N     the native device with so many threads only\n"
	"  --n N           elements of a batch (default %d and, in the column \"in cache\", %d)\n"
	"  --runs N        timed runs of each (default 11), 1 to 1000\n"
	"  --only TABLE    this table only: throughput, roofline, hand, layout, scaling, build or pruning\n"
	"  --csv FILE      instead of out/bench/throughput.csv; those of the other tables lie beside it\n"
	"  --json FILE     the table of throughput as JSON as well; -: on the standard output, and the rest on the other\n"
	"  --quick         a look that is no measurement: %d elements, 3 runs\n"
	"  --help          this\n";

static int bad(const char *option, const char *value, const char *what)
{
	fprintf(stderr, "throughput: %s%s%s: %s (--help lists the options)\n", option, value ? " " : "",
		value ? value : "", what);
	return 2;
}

/* The place of name in a list of count names, or -1. */
static int find(const char *name, int count, const char *(*name_of)(int))
{
	for (int i = 0; i < count; i++)
		if (strcmp(name, name_of(i)) == 0)
			return i;
	return -1;
}

/* A whole number in [1, most], or 0. */
static size_t number(const char *text, size_t most)
{
	char *end;
	if (*text < '0' || *text > '9')
		return 0;
	errno = 0;
	const unsigned long long value = strtoull(text, &end, 10);
	return errno == 0 && *end == '\0' && value <= most ? (size_t)value : 0;
}

static int only(bench_options *o, const char *table)
{
	const struct {
		const char *name;
		int *wanted;
	} tables[] = {{"throughput", &o->throughput}, {"build", &o->build},   {"pruning", &o->pruning},
		      {"scaling", &o->scaling},       {"layout", &o->layout}, {"hand", &o->hand},
		      {"roofline", &o->roofline}};
	int found = 0;
	for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
		found |= *tables[i].wanted = strcmp(table, tables[i].name) == 0;
	return found;
}

/* An option that takes a value. */
static int set(bench_options *o, const char *option, const char *value)
{
	const char *wrong = NULL;
	if (strcmp(option, "--lobe") == 0) {
		o->lobe = find(value, BENCH_LOBES, bench_lobe_name);
		wrong = o->lobe < 0 ? "no such lobe" : NULL;
	} else if (strcmp(option, "--verb") == 0) {
		o->verb = find(value, BENCH_VERBS, bench_verb_name);
		wrong = o->verb < 0 ? "no such verb" : NULL;
	} else if (strcmp(option, "--n") == 0) {
		o->n = number(value, (size_t)1 << 28);
		wrong = o->n == 0 ? "not a number from 1 to 2^28" : NULL;
	} else if (strcmp(option, "--runs") == 0) {
		o->runs = number(value, 1000);
		wrong = o->runs == 0 ? "not a number from 1 to 1000" : NULL;
	} else if (strcmp(option, "--only") == 0) {
		wrong = only(o, value) ? NULL : "no such table";
	} else if (strcmp(option, "--threads") == 0) {
		const size_t threads = number(value, 1024);
		wrong = threads == 0 ? "not a number from 1 to 1024" : NULL;
		snprintf(o->native, sizeof o->native, "native:%zu", threads);
		o->device = o->native;
	} else if (strcmp(option, "--json") == 0) {
		o->json = value;
	} else if (strcmp(option, "--device") == 0) {
		o->device = value;
	} else {
		o->csv = value;
	}
	return wrong ? bad(option, value, wrong) : 0;
}

static int takes_value(const char *option)
{
	static const char *const options[] = {"--lobe", "--verb", "--device", "--threads", "--n",
					      "--runs", "--only", "--csv",    "--json"};
	for (size_t i = 0; i < sizeof options / sizeof *options; i++)
		if (strcmp(option, options[i]) == 0)
			return 1;
	return 0;
}

int bench_options_parse(bench_options *o, int argc, char **argv)
{
	memset(o, 0, sizeof *o);
	o->lobe = o->verb = -1;
	o->csv = "out/bench/throughput.csv";
	o->throughput = o->build = o->pruning = o->scaling = o->layout = o->hand = o->roofline = 1;
	for (int i = 1; i < argc; i++) {
		if (strcmp(argv[i], "--help") == 0) {
			printf(help, BENCH_ELEMENTS, BENCH_IN_CACHE, BENCH_QUICK);
			return 1;
		}
		if (strcmp(argv[i], "--quick") == 0) {
			o->quick = 1;
			continue;
		}
		if (!takes_value(argv[i]))
			return bad(argv[i], NULL, "no such option");
		if (i + 1 == argc)
			return bad(argv[i], NULL, "needs a value");
		const int status = set(o, argv[i], argv[i + 1]);
		if (status != 0)
			return status;
		i++;
	}
	if (o->quick && !o->n)
		o->n = BENCH_QUICK;
	if (!o->runs)
		o->runs = o->quick ? 3 : 11;
	return 0;
}
