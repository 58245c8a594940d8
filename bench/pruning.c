/* pruning.c - sizes by the tools of the machine, and throughputs of fewer outputs from the measured results. */
#define _POSIX_C_SOURCE 200809L
#include "pruning.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "machine.h"
#include "race.h"

/* --- rows --------------------------------------------------------------------------------------------------------- */

/* value: in unit, less than 0 when it could not be had. baseline: what it is compared with, or 0. */
static void put(FILE *csv, const char *what, const char *subject, double value, double baseline, const char *unit)
{
	if (value < 0.0) {
		printf("%-52s %-18s %12s\n", what, subject, "skipped");
		return;
	}
	printf("%-52s %-18s %12.*f %-10s", what, subject, strcmp(unit, "bytes") == 0 ? 0 : 1, value, unit);
	if (baseline > 0.0)
		printf(" %7.2f x", value / baseline);
	printf("\n");
	fprintf(csv, "%s,%s,%.10g,%s,", what, subject, value, unit);
	if (baseline > 0.0)
		fprintf(csv, "%.4f", value / baseline);
	fprintf(csv, "\n");
}

/* --- the library -------------------------------------------------------------------------------------------------- */

/* The text (code and constants) that size(1) gives, summed over the lines whose last field contains name. */
static double text_size(const char *folder, const char *file, const char *name)
{
	char command[2048], line[256];
	snprintf(command, sizeof command,
		 "size '%s/%s' 2>/dev/null | awk -v name='%s' 'NR > 1 && index($0, name) { s += $1; n++ } "
		 "END { if (n) print s; else exit 1 }'",
		 folder, file, name);
	return bench_command(command, line, sizeof line) ? strtod(line, NULL) : -1.0;
}

static void put_library(FILE *csv, const char *folder)
{
	char name[128];
	const double all = text_size(folder, "liblobe.a", "");
	put(csv, "text of liblobe.so", "all lobes", text_size(folder, "liblobe.so", ""), 0.0, "bytes");
	put(csv, "text of liblobe.a", "all lobes", all, 0.0, "bytes");
	for (int lobe = 0; lobe < BENCH_LOBES; lobe++) {
		snprintf(name, sizeof name, "_%s.o", bench_lobe_name(lobe));
		put(csv, "of it the loops of one lobe (every instruction set)", bench_lobe_name(lobe),
		    text_size(folder, "liblobe.a", name), all, "bytes");
	}
	put(csv, "of it the OpenCL source as text", "all lobes", text_size(folder, "liblobe.a", "opencl_source.o"), all,
	    "bytes");
	/* make bench builds these; the ratio is to the library with both. */
	put(csv, "text of liblobe.so without OpenCL, LOBE_OPENCL=0", "all lobes",
	    text_size(folder, "no_opencl/liblobe.so", ""), text_size(folder, "liblobe.so", ""), "bytes");
	put(csv, "text of liblobe.so without native, LOBE_NATIVE=0", "all lobes",
	    text_size(folder, "no_native/liblobe.so", ""), text_size(folder, "liblobe.so", ""), "bytes");
}

/* --- programs of a user ------------------------------------------------------------------------------------------- */

/* A program that uses all verbs of one type; its inputs are volatile, so that the compiler cannot know results. */
static const char user_program[] = "#include \"lobe/%s\"\n"
				   "static volatile %s given;\n"
				   "static volatile lobe_real in[6], out[4];\n"
				   "int main(void)\n"
				   "{\n"
				   "	const %s p = given;\n"
				   "	const lobe_vec3 a = lobe_vec3_make(in[0], in[1], in[2]);\n"
				   "	const lobe_vec3 b = lobe_vec3_make(in[3], in[4], in[5]);\n"
				   "	const lobe_sample s = %s_sample(p, a, b);\n"
				   "	out[0] = %s_eval(p, a, b).g;\n"
				   "	out[1] = %s_pdf(p, a, b);\n"
				   "	out[2] = s.wi.x + s.weight.g;\n"
				   "	return (int)s.event;\n"
				   "}\n";

static const char batch_program[] = "#include \"lobe/lobe.h\"\n"
				    "int main(void)\n"
				    "{\n"
				    "	lobe_device *device;\n"
				    "	return (int)lobe_device_open(&device, \"native\");\n"
				    "}\n";

static int write_source(const char *folder, const char *name, const char *source)
{
	char path[2048];
	snprintf(path, sizeof path, "%s/%s", folder, name);
	FILE *out = fopen(path, "w");
	if (!out)
		return 0;
	fputs(source, out);
	return fclose(out) == 0;
}

/* Compiles source, and more in a file of its own, to folder/a.out, static and stripped, with the library when it is
 * given. Bytes of the file, and of the text of its object alone. */
static int compile(const char *folder, const char *source, const char *more, const char *library, double *file,
		   double *text)
{
	char command[4096], path[2048], line[256];
	const char *const cc = getenv("CC");
	struct stat s;
	if (!write_source(folder, "a.c", source) || !write_source(folder, "b.c", more))
		return 0;
	snprintf(command, sizeof command,
		 "cd '%s' && { %s -std=c99 -O2 -ffp-contract=off -I\"$OLDPWD/include\" -c a.c b.c && "
		 "%s -static -s a.o b.o %s%s%s -lm -ldl -lpthread -o a.out; } 2>/dev/null && echo built",
		 folder, cc && *cc ? cc : "cc", cc && *cc ? cc : "cc", library ? "'" : "", library ? library : "",
		 library ? "/liblobe.a'" : "");
	if (!bench_command(command, line, sizeof line))
		return 0;
	snprintf(path, sizeof path, "%s/a.out", folder);
	if (stat(path, &s) != 0)
		return 0;
	*file = (double)s.st_size;
	*text = text_size(folder, "a.o", "");
	return 1;
}

/* Both sizes of a program that includes that one header; the file's against that of an empty program. */
static void put_user(FILE *csv, const char *folder, const char *header, const char *type, const char *subject,
		     double empty)
{
	char source[2048];
	double file = -1.0, text = -1.0;
	snprintf(source, sizeof source, user_program, header, type, type, type, type, type);
	compile(folder, source, "typedef int nothing;\n", NULL, &file, &text);
	put(csv, "text of a C user's object, its three verbs", subject, text, 0.0, "bytes");
	put(csv, "  its executable, static and stripped", subject, file, empty, "bytes");
}

static void put_programs(FILE *csv, const char *library)
{
	char folder[] = "/tmp/lobe-bench-XXXXXX", absolute[2048], command[2048];
	double file = -1.0, text;
	if (access("include/lobe/lobe.h", R_OK) != 0 || !mkdtemp(folder)) {
		puts("programs of a user: skipped (no ./include here)");
		return;
	}
	compile(folder, "int main(void)\n{\n\treturn 0;\n}\n", "typedef int nothing;\n", NULL, &file, &text);
	if (file < 0.0)
		puts("programs of a user: skipped (no compiler here, or it does not link static programs)");
	else
		put(csv, "an empty program, static and stripped", "", file, 0.0, "bytes");
	for (int lobe = 0; file >= 0.0 && lobe < BENCH_LOBES; lobe++) {
		char header[128], type[128];
		snprintf(header, sizeof header, "lobes/%s.h", bench_lobe_name(lobe));
		snprintf(type, sizeof type, "lobe_%s", bench_lobe_name(lobe));
		put_user(csv, folder, header, type, bench_lobe_name(lobe), file);
	}
	if (file >= 0.0)
		put_user(csv, folder, "shading.h", "lobe_bsdf", "lobe_bsdf (all)", file);
	snprintf(command, sizeof command, "cd '%s' && pwd", library);
	if (file >= 0.0 && bench_command(command, absolute, sizeof absolute)) {
		double whole = -1.0;
		compile(folder, batch_program, "typedef int nothing;\n", absolute, &whole, &text);
		put(csv, "executable with the batch library, static and stripped", "all lobes", whole, file, "bytes");
		for (int lobe = 0; lobe < BENCH_LOBES; lobe++) {
			static const char list[] = "#define LOBE_HAS_DEFAULT 0\n#define LOBE_HAS_%s 1\n"
						   "#include \"lobe/link.h\"\n";
			char source[256], upper[64];
			double one = -1.0;
			size_t i = 0;
			for (const char *c = bench_lobe_name(lobe); *c && i < sizeof upper - 1; c++)
				upper[i++] = (char)toupper((unsigned char)*c);
			upper[i] = '\0';
			snprintf(source, sizeof source, list, upper);
			compile(folder, batch_program, source, absolute, &one, &text);
			put(csv, "  the same with a list of one lobe, lobe/link.h", bench_lobe_name(lobe), one, file,
			    "bytes");
		}
	}
	snprintf(command, sizeof command, "rm -r '%s' && echo removed", folder);
	bench_command(command, absolute, sizeof absolute);
}

/* --- outputs ------------------------------------------------------------------------------------------------------ */

static void put_outputs(FILE *csv, const bench_plan *plan, const bench_results *results)
{
	static const struct {
		int verb, all;
		const char *what;
	} rows[] = {{BENCH_EVAL_PDF, BENCH_EVAL_PDF, "eval: f and pdf"},
		    {BENCH_EVAL, BENCH_EVAL_PDF, "  f alone"},
		    {BENCH_PDF, BENCH_EVAL_PDF, "  pdf alone"},
		    {BENCH_SAMPLE, BENCH_SAMPLE, "sample: everything"},
		    {BENCH_SAMPLE_WI, BENCH_SAMPLE, "  without weight and pdf"}};
	for (int d = 0; d < plan->device_count; d++)
		for (int lobe = 0; lobe < BENCH_LOBES; lobe++)
			for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
				char what[96];
				const bench_result *r = bench_find(results, lobe, rows[i].verb, d, 0);
				const bench_result *all = bench_find(results, lobe, rows[i].all, d, 0);
				snprintf(what, sizeof what, "%s; %s", rows[i].what, plan->devices[d].label);
				if (r)
					put(csv, what, bench_lobe_name(lobe), r->rate.median,
					    all ? all->rate.median : 0.0, "M/s");
			}
}

/* --- choices ------------------------------------------------------------------------------------------------------ */

/* A lobe that chooses at run time, in a program compiled for its choices and in one of a scene, open, that makes them
 * all. What building them costs: bench/build_time.c. */
static int put_choices(FILE *csv, const bench_plan *plan, const bench_device *d, int lobe, int open)
{
	static const int verbs[] = {BENCH_EVAL_PDF, BENCH_SAMPLE};
	const size_t n = 1u << 16;
	bench_arrays a;
	int ok = bench_arrays_create(&a, n);
	for (size_t v = 0; ok && v < sizeof verbs / sizeof *verbs; v++) {
		bench_shading shading[2];
		bench_racer racer[2];
		int scenes = 0;
		for (int i = 0; ok && i < 2; i++, scenes += ok) {
			shading[i].verb = verbs[v];
			shading[i].batch = bench_batch(&a, verbs[v], n);
			ok = bench_scene_create(&shading[i].scene, d->device, i ? open : lobe) == LOBE_OK;
			racer[i] = bench_shading_racer(&shading[i], 1);
		}
		if (ok && bench_race(racer, 2, plan->runs)) {
			char what[96];
			snprintf(what, sizeof what, "%s, every choice open; %s", bench_verb_name(verbs[v]), d->label);
			put(csv, what, bench_lobe_name(lobe), racer[1].rate.median, 0.0, "M/s");
			put(csv, "  compiled for the one that is made", bench_lobe_name(lobe), racer[0].rate.median,
			    racer[1].rate.median, "M/s");
		}
		for (int i = 0; i < scenes; i++)
			lobe_scene_destroy(shading[i].scene);
	}
	if (!ok)
		fprintf(stderr, "throughput: %s\n", lobe_error_message());
	bench_arrays_destroy(&a);
	return ok;
}

int bench_pruning(const bench_plan *plan, const bench_results *results, const char *library, const char *path)
{
	FILE *csv = bench_create_file(path);
	if (!csv)
		return 0;
	printf("\nWhat is left out: sizes, and throughput by the outputs that a batch asks for. x: times the whole\n"
	       "library, times the empty program, times the throughput with every output.\n\n");
	fputs("what,subject,value,unit,ratio\n", csv);
	put_library(csv, library);
	put_programs(csv, library);
	put_outputs(csv, plan, results);
	int ok = 1;
	for (int d = 0; ok && d < plan->device_count; d++)
		if (bench_is_opencl(&plan->devices[d]))
			ok = put_choices(csv, plan, &plan->devices[d], BENCH_LOBE_MICROFACET_CONDUCTOR, BENCH_OPEN) &&
			     put_choices(csv, plan, &plan->devices[d], BENCH_LOBE_GGX_DIELECTRIC, BENCH_OPEN_GLASS);
	return fclose(csv) == 0 && ok;
}
