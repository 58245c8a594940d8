/* test_report.c - the report's frame: what is kept of a study, what runs again, and that threads change nothing. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "csv.h"
#include "support.h"
#include "unity.h"
#include "units.h"

static char folder[] = "/tmp/lobe_report_XXXXXX";

void setUp(void) {}
void tearDown(void) {}

/* --- a study of seven units, or of three ---------------------------------------------------------------------------- */

static int runs, fail_at = -1;

static size_t toy_units(int quick) { return quick ? 3 : 7; }

static int toy_run(int quick, size_t unit, report_rows *rows)
{
	(void)quick;
	__atomic_add_fetch(&runs, 1, __ATOMIC_RELAXED);
	if ((int)unit == fail_at)
		return -1;
	/* Uneven work, so that threads end in another order than they start. */
	volatile double sum = 0.0;
	for (size_t i = 0; i < (7 - unit) * 20000; i++)
		sum += (double)test_uniform((uint32_t)unit, i);
	for (size_t i = 0; i <= unit; i++)
		report_row(rows, "%zu,%zu,%.9g", unit, i, sum);
	return 0;
}

static const report_study toy = {.name = "toy_study", .columns = "unit,row,sum", .units = toy_units, .run = toy_run};
static const report_section section = {.name = "toy", .title = "Toy", .question = "Which toy?", .studies = {&toy}};

static const report_table *run(int quick, size_t threads)
{
	runs = 0;
	return report_study_run(&section, &toy, quick, threads);
}

static char *file_text(const char *path)
{
	report_rows rows = {NULL, 0, 0};
	TEST_ASSERT_TRUE_MESSAGE(report_rows_read(&rows, path), path);
	return rows.text;
}

static void write_text(const char *path, const char *text)
{
	FILE *f = fopen(path, "w");
	TEST_ASSERT_NOT_NULL(f);
	fputs(text, f);
	fclose(f);
}

static void forget(void) { TEST_ASSERT_EQUAL_INT(0, system("rm -rf out")); }

/* --- tests ---------------------------------------------------------------------------------------------------------- */

static void test_the_rows_are_the_same_on_any_number_of_threads(void)
{
	run(0, 1);
	char *one = file_text("out/report/toy_study.csv");
	forget();
	run(0, 3);
	char *three = file_text("out/report/toy_study.csv");
	TEST_ASSERT_EQUAL_STRING(one, three);
	TEST_ASSERT_EQUAL_INT(0, strncmp(one, "unit,row,sum\n0,0,", 17));
	free(one);
	free(three);
}

static void test_a_table_is_read_by_row_and_column(void)
{
	const report_table *t = run(0, 2);
	TEST_ASSERT_EQUAL_INT(1 + 2 + 3 + 4 + 5 + 6 + 7, (int)report_table_rows(t));
	TEST_ASSERT_EQUAL_STRING("6", report_cell(t, 27, "unit"));
	TEST_ASSERT_EQUAL_DOUBLE(6.0, report_number(t, 27, "row"));
}

/* Of those that are not timed, in the quick form; a row of other columns ends the program. */
static void test_rows_have_the_columns_of_their_study(void)
{
	for (const report_section *const *s = report_sections; *s; s++)
		for (const report_study *const *study = (*s)->studies; *study; study++) {
			report_rows rows = {NULL, 0, 0};
			if ((*study)->timed || (*study)->units(1) == 0)
				continue;
			printf("  %s\n", (*study)->name);
			TEST_ASSERT_EQUAL_INT(0, (*study)->run(1, 0, &rows));
			report_table_make((*study)->name, (*study)->columns, rows.text);
			free(rows.text);
		}
}

static void test_only_what_is_missing_runs(void)
{
	forget();
	run(0, 2);
	TEST_ASSERT_EQUAL_INT(7, runs);
	run(0, 2);
	TEST_ASSERT_EQUAL_INT(0, runs);
	TEST_ASSERT_EQUAL_INT(0, system("rm out/report/data/toy_study/*_4.csv"));
	run(0, 2);
	TEST_ASSERT_EQUAL_INT(1, runs);
}

static void test_quick_and_full_are_kept_apart(void)
{
	forget();
	run(1, 2);
	TEST_ASSERT_EQUAL_INT(3, runs);
	run(0, 2);
	TEST_ASSERT_EQUAL_INT(7, runs);
	run(1, 2);
	TEST_ASSERT_EQUAL_INT(0, runs);
}

static void test_a_change_of_the_source_of_the_section_runs_it_again(void)
{
	run(0, 2);
	write_text("bench/report/toy_more.c", "changed\n");
	run(0, 2);
	TEST_ASSERT_EQUAL_INT(7, runs);
	TEST_ASSERT_EQUAL_INT(0, remove("bench/report/toy_more.c"));
	run(0, 2);
	TEST_ASSERT_EQUAL_INT(0, runs);
}

/* What an interrupt leaves: the units before it, and perhaps a part of one under another name. */
static void test_a_failed_unit_ends_the_program_and_keeps_the_others(void)
{
	int status = 0;
	forget();
	fflush(NULL);
	const pid_t child = fork();
	if (child == 0) {
		fail_at = 5;
		run(0, 1);
		_exit(0);
	}
	TEST_ASSERT_EQUAL_INT(child, waitpid(child, &status, 0));
	TEST_ASSERT_TRUE(WIFEXITED(status));
	TEST_ASSERT_EQUAL_INT(1, WEXITSTATUS(status));
	TEST_ASSERT_EQUAL_INT(0, system("cp out/report/data/toy_study/*_0.csv out/report/data/toy_study/x_5.csv.part"));
	run(0, 2);
	TEST_ASSERT_EQUAL_INT(2, runs);
}

int main(void)
{
	if (!mkdtemp(folder) || chdir(folder) != 0 || mkdir("bench", 0777) != 0 || mkdir("bench/report", 0777) != 0)
		return 1;
	UNITY_BEGIN();
	write_text("bench/report/toy.c", "first\n");
	RUN_TEST(test_the_rows_are_the_same_on_any_number_of_threads);
	RUN_TEST(test_a_table_is_read_by_row_and_column);
	RUN_TEST(test_rows_have_the_columns_of_their_study);
	RUN_TEST(test_only_what_is_missing_runs);
	RUN_TEST(test_quick_and_full_are_kept_apart);
	RUN_TEST(test_a_change_of_the_source_of_the_section_runs_it_again);
	RUN_TEST(test_a_failed_unit_ends_the_program_and_keeps_the_others);
	const int failed = UNITY_END();
	char command[64];
	snprintf(command, sizeof command, "rm -rf %s", folder);
	if (chdir("/") != 0 || system(command) != 0)
		return 1;
	return failed;
}
