/* roofline.c - operations by objdump, rates by the clock. */
#define _POSIX_C_SOURCE 200809L
#include "roofline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "machine.h"
#include "peak.h"
#include "race.h"

/* --- operations --------------------------------------------------------------------------------------------------- */

/* Vector instructions for each element: those of the loop that does whole vectors, over the elements of a turn. */
typedef struct {
	double arithmetic, fused, divisions, roots; /* sums, products, extrema; fused ones among them */
	double other;                               /* comparisons, selections, integers, conversions */
} operations;

/* The loop of a function is what a jump backwards spans; of those the one with most instructions on the widest
 * registers. How many elements it does in a turn: what it stores outside the stack, by the outputs. */
static const char script[] =
	"objdump -d --no-show-raw-insn '%s' 2>/dev/null | awk -v name='%s' -v reg='%%%s' -v lanes=%d -v outputs=%d '"
	"/^[0-9a-f]+ <.*>:$/ { inside = index($2, \"<\" name) == 1; next } "
	"inside && NF > 1 { at = $1; sub(\":\", \"\", at); n++; address[n] = at; what[n] = $2; line[n] = $0; place[at] "
	"= n; "
	"if ($2 ~ /^j/ && ($3 in place)) { from[++loops] = place[$3]; to[loops] = n } } "
	"END { for (l = 1; l <= loops; l++) { wide = 0; for (i = from[l]; i <= to[l]; i++) wide += index(line[i], reg) "
	"> 0; "
	"if (wide > most) { most = wide; best = l } } "
	"if (!best) exit 1; "
	"for (i = from[best]; i <= to[best]; i++) { if (!index(line[i], reg)) continue; w = what[i]; "
	"if (w ~ /^v?mov/) { if (line[i] ~ reg \"[0-9]+(,|$)\" && line[i] ~ /,[-x0-9a-f]*\\([^)]*\\)/ && "
	"line[i] !~ /\\(%%rsp|-0x[0-9a-f]+\\(%%rbp/) stores++ } "
	"else if (w ~ /^v?div[ps]s/) d++; else if (w ~ /^v?sqrt[ps]s/) r++; else if (w ~ /^vf(n?)m(add|sub)/) { f++; "
	"a++ } "
	"else if (w ~ /^v?(add|sub|mul|max|min)ps/) a++; else o++ } "
	"turn = stores ? stores / outputs * lanes : lanes; "
	"printf \"%%g %%g %%g %%g %%g\\n\", a / turn, f / turn, d / turn, r / turn, o / turn }'";

/* 0: not to be had here. */
static int count_operations(const char *objects, const char *isa, int lanes, int lobe, int verb, operations *o)
{
	static const char *const rows[BENCH_VERBS] = {"eval_f", "eval_pdf", "eval_f_pdf", "sample", "sample_wi"};
	static const int outputs[BENCH_VERBS] = {3, 1, 4, 8, 4};
	char object[2048], function[64], command[4096], line[256];
	snprintf(object, sizeof object, "%s/rows_%s_%s.o", objects, isa, bench_lobe_name(lobe));
	snprintf(function, sizeof function, "%s_one_loop", rows[verb]);
	snprintf(command, sizeof command, script, object, function, lanes == 16 ? "zmm" : (lanes == 8 ? "ymm" : "xmm"),
		 lanes, outputs[verb]);
	return bench_command(command, line, sizeof line) &&
	       sscanf(line, "%lf %lf %lf %lf %lf", &o->arithmetic, &o->fused, &o->divisions, &o->roots, &o->other) == 5;
}

/* --- rates -------------------------------------------------------------------------------------------------------- */

typedef struct {
	bench_copy *copy;
	size_t bytes;
} copying;

static int run_copy(const void *context)
{
	const copying *c = context;
	bench_copy_run(c->copy, c->bytes, 1);
	return 1;
}

enum { IN_CACHE = 2048 };

typedef struct {
	const char *isa;
	bench_peak peak;
	lobe_device *device;
	bench_copy *copy;
	bench_arrays arrays;
	const char *objects;
	size_t n, runs;
} work;

static int row(FILE *csv, const work *w, int lobe, int verb)
{
	const size_t bytes = bench_bytes(w->device, lobe, verb);
	const copying c = {w->copy, w->n * bytes};
	bench_shading large = {NULL, verb, bench_batch(&w->arrays, verb, w->n)}, small;
	operations o = {0};
	if (bytes == 0 || bench_scene_create(&large.scene, w->device, lobe) != LOBE_OK)
		return 0;
	small = large;
	small.batch.count = IN_CACHE;
	bench_racer racer[3] = {bench_shading_racer(&large, 1),
				{.run = run_copy, .context = &c, .elements = (double)w->n, .base = 1},
				bench_shading_racer(&small, 1)};
	const int ok = bench_race(racer, 3, w->runs);
	lobe_scene_destroy(large.scene);
	if (!ok)
		return 0;
	const int known =
		w->peak.arithmetic > 0.0 && count_operations(w->objects, w->isa, w->peak.lanes, lobe, verb, &o);
	/* Sums and products, and the rest, have pipes of their own; divisions and roots share one. */
	const double arithmetic = o.arithmetic * w->peak.arithmetic * 1e6,
		     divider = (o.divisions * w->peak.division + o.roots * w->peak.root) * 1e6;
	const double flops = (o.arithmetic + o.fused + o.divisions + o.roots) * w->peak.lanes;
	const double slower = arithmetic > divider ? arithmetic : divider;
	printf("%-18s %-9s %5zu", bench_lobe_name(lobe), bench_verb_name(verb), bytes);
	if (known)
		printf(" %6.1f %5.1f %5.1f %6.1f", flops, o.divisions * w->peak.lanes, o.roots * w->peak.lanes,
		       o.other * w->peak.lanes);
	else
		printf(" %6s %5s %5s %6s", "-", "-", "-", "-");
	printf(" %8.1f %6.1f - %-6.1f %6.1f", racer[0].rate.median, racer[0].rate.low, racer[0].rate.high,
	       100.0 * racer[0].ratio.median);
	if (known && slower > 0.0)
		printf(" %8.1f %6.1f %6.1f", racer[2].rate.median, 100.0 * racer[2].rate.median * divider,
		       100.0 * racer[2].rate.median * arithmetic);
	printf("\n");
	fprintf(csv, "%s,%s,%zu,%.3f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f\n", bench_lobe_name(lobe),
		bench_verb_name(verb), bytes, flops, o.divisions, o.roots, o.other, racer[0].rate.median,
		racer[0].rate.low, racer[0].rate.high, racer[0].ratio.median, racer[2].rate.median,
		1e-3 * racer[1].rate.median * (double)bytes, divider > 0.0 ? 1.0 / divider : 0.0,
		w->peak.arithmetic > 0.0 ? 2e-9 / w->peak.arithmetic * w->peak.lanes : 0.0);
	return 1;
}

static void find_peak(work *w)
{
	const char *const name = lobe_device_name(w->device);
#ifdef LOBE_X86
	if (strstr(name, "avx512")) {
		w->isa = "avx512";
		bench_peak_avx512(&w->peak);
		return;
	}
	if (strstr(name, "avx2")) {
		w->isa = "avx2";
		bench_peak_avx2(&w->peak);
		return;
	}
#endif
	(void)name;
	w->isa = "baseline";
	bench_peak_baseline(&w->peak);
}

int bench_roofline(int lobe, size_t n, size_t runs, const char *objects, const char *path)
{
	work w = {0};
	FILE *csv = bench_create_file(path);
	w.n = n;
	w.runs = runs;
	w.objects = objects;
	w.copy = bench_copy_create(1, n * 4 * (6 + 8));
	int ok = csv && w.copy && bench_arrays_create(&w.arrays, n) &&
		 lobe_device_open(&w.device, "native:1") == LOBE_OK;
	if (csv && !ok)
		fprintf(stderr, "throughput: out of memory, or no native device\n");
	if (ok) {
		find_peak(&w);
		printf("\nCeilings, one thread (%s). An element's bytes, its operations (a fused one counts as two), "
		       "and, by vector of\n"
		       "%d, divisions, square roots and other instructions (comparisons, selections, integers); "
		       "measured rate\n"
		       "from memory with its 95 %% interval, in percent of a copy; in the cache (%d elements) and "
		       "there in percent\n"
		       "of what the divider and what sums and products alone would allow: %.2f ns for a vector of "
		       "quotients, %.2f\n"
		       "of roots, %.2f of products.\n\n",
		       lobe_device_name(w.device), w.peak.lanes, IN_CACHE, w.peak.division * 1e9, w.peak.root * 1e9,
		       w.peak.arithmetic * 1e9);
		printf("%-18s %-9s %5s %6s %5s %5s %6s %8s %15s %6s %8s %6s %6s\n", "lobe", "verb", "bytes", "flop",
		       "div", "root", "other", "M/s", "", "copy %", "in cache", "div %", "sum %");
		fputs("lobe,verb,bytes,flops,divisions,roots,other,melements_per_s,low,high,copy_share,"
		      "in_cache_melements_per_s,copy_gbytes_per_s,divider_melements_per_s,peak_gflops\n",
		      csv);
	}
	for (int l = 0; ok && l < BENCH_LOBES; l++)
		for (int verb = 0; ok && verb < BENCH_VERBS; verb++)
			if (lobe < 0 || lobe == l)
				ok = row(csv, &w, l, verb);
	lobe_device_close(w.device);
	bench_arrays_destroy(&w.arrays);
	bench_copy_destroy(w.copy);
	return csv && fclose(csv) == 0 && ok;
}
