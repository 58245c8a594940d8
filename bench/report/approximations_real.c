/* approximations_real.c - errors of elementary functions in ulp: the library's, libm's in single
 * precision, OpenCL's. */
#include "real_reference.h"

#include "approximations.h"
#include "csv.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double reference_pow(double x, double y) { return pow(x, y); }
static double reference_atan2(double y, double x) { return atan2(y, x); }

/* domain: what arguments are drawn from, uniformly; or, from < 0 in log: positive floats of all exponents between. */
static const struct {
	const char *name;
	double from, to;
	int by_exponent;
	double from_y, to_y;
	double (*of_one)(double);
	double (*of_two)(double, double);
	const char *domain;
} functions[] = {
	{"sin_2pi", 0.0, 1.0, 0, 0, 0, reference_sin_2pi, NULL, "[0; 1) turns"},
	{"cos_2pi", 0.0, 1.0, 0, 0, 0, reference_cos_2pi, NULL, "[0; 1) turns"},
	{"sin", -100.0, 100.0, 0, 0, 0, reference_sin, NULL, "[-100; 100]"},
	{"exp", -80.0, 80.0, 0, 0, 0, reference_exp, NULL, "[-80; 80]"},
	{"log", 1e-30, 1e30, 1, 0, 0, reference_log, NULL, "1e-30 to 1e30"},
	{"pow", 1e-3, 1e3, 1, -8.0, 8.0, NULL, reference_pow, "1e-3 to 1e3; -8 to 8"},
	{"erf", -4.0, 4.0, 0, 0, 0, reference_erf, NULL, "[-4; 4]"},
	{"erfinv", -1.0, 1.0, 0, 0, 0, reference_erfinv, NULL, "(-1; 1)"},
	{"acos", -1.0, 1.0, 0, 0, 0, reference_acos, NULL, "[-1; 1]"},
	{"atan2", -1.0, 1.0, 0, -1.0, 1.0, NULL, reference_atan2, "[-1; 1]^2"},
};
enum { FUNCTIONS = sizeof functions / sizeof *functions, CHUNK = 4096 };

static void arguments(size_t f, uint64_t first, float *x, float *y)
{
	for (uint64_t i = 0; i < CHUNK; i++) {
		const double u = ((double)test_bits(71, first + i) + 0.5) * 0x1p-32;
		const double v = ((double)test_bits(72, first + i) + 0.5) * 0x1p-32;
		x[i] = (float)(functions[f].by_exponent
				       ? functions[f].from * pow(functions[f].to / functions[f].from, u)
				       : functions[f].from + (functions[f].to - functions[f].from) * u);
		y[i] = (float)(functions[f].from_y + (functions[f].to_y - functions[f].from_y) * v);
		if (strcmp(functions[f].name, "erfinv") == 0 && fabsf(x[i]) == 1.0f)
			x[i] = 0.0f;
	}
}

static int is_of(const char *name, size_t f)
{
	const size_t length = strlen(functions[f].name);
	return strncmp(name, functions[f].name, length) == 0 && name[length] == '/';
}

/* got of the arguments from number first on, added. */
static void add(approximations_error *e, size_t f, const float *x, const float *y, const float *got)
{
	for (size_t i = 0; i < CHUNK; i++) {
		const double exact = functions[f].of_one ? functions[f].of_one((double)x[i])
							 : functions[f].of_two((double)x[i], (double)y[i]);
		if (functions[f].of_one)
			approximations_error_add(e, ulp_error_double(got[i], exact), 0.0, "%.9g", (double)x[i]);
		else
			approximations_error_add(e, ulp_error_double(got[i], exact), 0.0, "%.9g; %.9g", (double)x[i],
						 (double)y[i]);
		if (i % 128 == 0)
			e->reference =
				fmax(e->reference, approximations_doubt_real(functions[f].name, exact, x[i], y[i]));
	}
}

static void row(report_rows *rows, const char *name, size_t f, approximations_error *e)
{
	char quantity[64];
	snprintf(quantity, sizeof quantity, "ulp; %s", functions[f].domain);
	approximations_error_row(rows, "real", name, functions[f].name, quantity, e);
}

static size_t units(void) { return FUNCTIONS + 1; }

/* The last unit is OpenCL's, one device for all. Half the arguments: its built-in functions are not ours to search. */
static int on_opencl(uint64_t chunks, report_rows *rows)
{
	approximations_device *device = approximations_device_open();
	const size_t n = (size_t)chunks * CHUNK;
	static const approximations_set p;
	int failed = 0;
	if (!device)
		return 0;
	float *x = report_alloc(NULL, 3 * n * sizeof *x), *y = x + n, *got = y + n;
	for (size_t f = 0; f < FUNCTIONS && !failed; f++) {
		for (uint64_t c = 0; c < chunks; c++)
			arguments(f, c * CHUNK, x + c * CHUNK, y + c * CHUNK);
		for (size_t b = 0; b < approximations_builtin_count() && !failed; b++) {
			const approximations_builtin *builtin = &approximations_builtins[b];
			const float *const in[APPROXIMATIONS_IN] = {x, y, x, x, x};
			float *out[APPROXIMATIONS_OUT] = {got, NULL, NULL};
			approximations_error e = {0};
			if (!is_of(builtin->name, f))
				continue;
			failed = approximations_device_run(device, builtin->id, &p, n, in, out, 1, NULL);
			for (uint64_t c = 0; c < chunks && !failed; c++)
				add(&e, f, x + c * CHUNK, y + c * CHUNK, got + c * CHUNK);
			if (!failed)
				row(rows, builtin->name, f, &e);
		}
	}
	free(x);
	approximations_device_close(device);
	return failed;
}

static int run(int quick, size_t unit, report_rows *rows)
{
	const uint64_t chunks = quick ? 64u : 4096u;
	static const approximations_set p;
	float x[CHUNK], y[CHUNK], got[CHUNK];
	if (unit == FUNCTIONS)
		return on_opencl(chunks / 2, rows);
	for (size_t w = 0; w < approximations_way_count(); w++) {
		const approximations_way *way = &approximations_ways[w];
		const float *const in[APPROXIMATIONS_IN] = {x, y, x, x, x};
		float *const out[APPROXIMATIONS_OUT] = {got, got, got};
		approximations_error e = {0};
		if (way->group != GROUP_REAL || !is_of(way->name, unit))
			continue;
		for (uint64_t c = 0; c < chunks; c++) {
			arguments(unit, c * CHUNK, x, y);
			way->vector(&p, CHUNK, in, out);
			add(&e, unit, x, y, got);
		}
		row(rows, way->name, unit, &e);
	}
	return 0;
}

const approximations_part approximations_real = {units, run};
