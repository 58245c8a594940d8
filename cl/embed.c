/* embed.c - turns headers into C strings, at build time.
 *
 *	embed FILE FUNCTION [FILE FUNCTION ...] > out.c
 *
 * writes for each pair `const char *FUNCTION(void)`, which returns FILE with every #include "..." replaced by the text
 * it names (looked for beside the including file). #include <...> stays: here they stand in branches that only a C
 * compiler takes. Comments and blank lines are left out.
 *
 * A file with an include guard is pasted once, others (lists like lobes.def) each time. "Once" has a catch: text pasted
 * inside #if LOBE_HAS_A is not there when LOBE_HAS_A is 0. So an earlier paste counts only if every #if branch around
 * it is also around the place at hand; otherwise the file is pasted again, and its guard sorts it out. */
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
	MAX_DEPTH = 64, /* of #include and of #if */
	MAX_PATH = 1024,
	SWALLOWED = '\1' /* stands for a newline inside a comment, so that messages have the right line numbers */
};

typedef struct {
	char *data; /* a NUL follows it */
	size_t length, capacity;
} text;

/* The #if branches around a place. Each branch has its own number; 0 is an include guard, which hides nothing. */
typedef struct {
	unsigned branch[MAX_DEPTH];
	int depth;
} place;

/* A guarded file that has been pasted. */
typedef struct paste {
	struct paste *next;
	place where;
	char path[MAX_PATH];
} paste;

static paste *pastes;
static place here;
static unsigned branch_count;
static const char *including[MAX_DEPTH];
static int including_depth;

static void die(const char *file, size_t line, const char *format, ...)
{
	va_list args;
	fprintf(stderr, line ? "%s:%lu: " : "%s: ", file, (unsigned long)line);
	va_start(args, format);
	vfprintf(stderr, format, args);
	va_end(args);
	fputc('\n', stderr);
	exit(1);
}

static void append(text *t, const char *s, size_t n)
{
	if (t->length + n + 1 > t->capacity) {
		t->capacity = 2 * (t->length + n + 1);
		t->data = realloc(t->data, t->capacity);
		if (!t->data)
			die("embed", 0, "out of memory");
	}
	memcpy(t->data + t->length, s, n);
	t->length += n;
	t->data[t->length] = '\0';
}

static text read_file(const char *path, const char *from, size_t line)
{
	text t = {0};
	char buffer[4096];
	size_t n;
	FILE *f = fopen(path, "rb");
	if (!f)
		die(from, line, "cannot open %s: %s", path, strerror(errno));
	append(&t, "", 0);
	while ((n = fread(buffer, 1, sizeof buffer, f)) > 0)
		append(&t, buffer, n);
	if (ferror(f))
		die(path, 0, "cannot read: %s", strerror(errno));
	fclose(f);
	return t;
}

/* Each comment becomes a space, as in the C preprocessor; carriage returns go. */
static text without_comments(const char *path, const text *in)
{
	static const char swallowed = SWALLOWED;
	text out = {0};
	size_t line = 1;
	const char *s = in->data;
	append(&out, "", 0);
	while (*s) {
		if (s[0] == '/' && s[1] == '*') {
			const size_t first = line;
			for (s += 2; *s && !(s[0] == '*' && s[1] == '/'); s++) {
				if (*s == '\n') {
					line++;
					append(&out, &swallowed, 1);
				}
			}
			if (!*s)
				die(path, first, "comment without an end");
			append(&out, " ", 1);
			s += 2;
		} else if (s[0] == '/' && s[1] == '/') {
			for (; *s && *s != '\n'; s++) {
				if (s[0] == '\\' && s[1] == '\n')
					die(path, line, "a // comment that goes on in the next line");
			}
		} else if (*s == '"' || *s == '\'') {
			const char *const begin = s++;
			while (*s && *s != *begin && *s != '\n')
				s += s[0] == '\\' && s[1] ? 2 : 1;
			if (*s != *begin)
				die(path, line, "quote without an end");
			append(&out, begin, (size_t)(++s - begin));
		} else {
			line += *s == '\n';
			if (*s & 0x80)
				die(path, line, "a character outside ASCII, outside a comment");
			if (*s != '\r')
				append(&out, s, 1);
			s++;
		}
	}
	if (s != in->data + in->length)
		die(path, line, "a NUL character");
	return out;
}

/* If the line is the directive `#name`, what follows the name; else NULL. */
static const char *directive(const char *line, const char *name)
{
	const size_t n = strlen(name);
	line += strspn(line, " \t");
	if (*line++ != '#')
		return NULL;
	line += strspn(line, " \t");
	if (strncmp(line, name, n) != 0 || (line[n] && !strchr(" \t\"<(", line[n])))
		return NULL;
	return line + n + strspn(line + n, " \t");
}

/* Cuts the next line out of *s, without the newlines that comments swallowed and without blanks at its end. */
static char *next_line(char **s, size_t *line_number)
{
	char *const line = *s;
	char *from = line, *to = line;
	for (; *from && *from != '\n'; from++) {
		if (*from == SWALLOWED)
			++*line_number;
		else
			*to++ = *from;
	}
	*s = *from ? from + 1 : from;
	while (to > line && (to[-1] == ' ' || to[-1] == '\t'))
		to--;
	*to = '\0';
	++*line_number;
	return line;
}

/* Whether the first two directives are #ifndef NAME and #define NAME. */
static int has_guard(const text *t)
{
	text copy = {0};
	char *s;
	char name[MAX_PATH] = "";
	int guard = 0;
	size_t number = 0;
	append(&copy, t->data, t->length);
	for (s = copy.data; *s;) {
		const char *const line = next_line(&s, &number);
		if (!*line)
			continue;
		if (!*name && directive(line, "ifndef")) {
			snprintf(name, sizeof name, "%s", directive(line, "ifndef"));
		} else {
			guard = *name && directive(line, "define") && strcmp(directive(line, "define"), name) == 0;
			break;
		}
	}
	free(copy.data);
	return guard;
}

static int is_around_here(const place *p)
{
	int i, k = 0;
	for (i = 0; i < p->depth; i++) {
		if (p->branch[i] == 0)
			continue;
		while (k < here.depth && here.branch[k] != p->branch[i])
			k++;
		if (k == here.depth)
			return 0;
	}
	return 1;
}

static void track_branches(const char *path, size_t line_number, const char *line, int floor, int *guard_to_come)
{
	if (directive(line, "if") || directive(line, "ifdef") || directive(line, "ifndef")) {
		if (here.depth == MAX_DEPTH)
			die(path, line_number, "#if is nested too deep");
		here.branch[here.depth++] = *guard_to_come ? 0 : ++branch_count;
		*guard_to_come = 0;
	} else if (directive(line, "elif") || directive(line, "else")) {
		if (here.depth == floor)
			die(path, line_number, "#else without #if");
		here.branch[here.depth - 1] = ++branch_count;
	} else if (directive(line, "endif")) {
		if (here.depth == floor)
			die(path, line_number, "#endif without #if");
		here.depth--;
	}
}

static void paste_file(text *out, const char *path, const char *from, size_t from_line);

static void include(text *out, const char *path, size_t line_number, const char *name)
{
	char target[MAX_PATH];
	const char *const slash = strrchr(path, '/');
	const int folder = slash ? (int)(slash - path + 1) : 0;
	const char *const end = strchr(name + 1, '"');
	const int length = end ? (int)(end - name - 1) : 0;
	char *up;
	if (length <= 0 || end[1])
		die(path, line_number, "an #include that embed cannot read");
	if (folder + length >= MAX_PATH)
		die(path, line_number, "the path is too long");
	snprintf(target, sizeof target, "%.*s%.*s", folder, path, length, name + 1);
	/* a/b/../c is a/c: one name for each file */
	while ((up = strstr(target, "/../")) != NULL) {
		char *begin = up;
		while (begin > target && begin[-1] != '/')
			begin--;
		if (strncmp(begin, "..", 2) == 0)
			break;
		memmove(begin, up + 4, strlen(up + 4) + 1);
	}
	paste_file(out, target, path, line_number);
}

static void paste_file(text *out, const char *path, const char *from, size_t from_line)
{
	text raw, stripped;
	char *s;
	size_t line_number = 0;
	int i, guard, continued = 0;
	const int floor = here.depth;
	const paste *p;

	for (p = pastes; p; p = p->next) {
		if (strcmp(p->path, path) == 0 && is_around_here(&p->where))
			return;
	}
	for (i = 0; i < including_depth; i++) {
		if (strcmp(including[i], path) == 0)
			die(from, from_line, "%s includes itself", path);
	}
	if (including_depth == MAX_DEPTH)
		die(from, from_line, "#include is nested too deep");
	raw = read_file(path, from, from_line);
	stripped = without_comments(path, &raw);
	guard = has_guard(&stripped);
	if (guard) {
		paste *const mine = calloc(1, sizeof *mine);
		if (!mine || strlen(path) >= sizeof mine->path)
			die(path, 0, mine ? "the path is too long" : "out of memory");
		strcpy(mine->path, path);
		mine->where = here;
		mine->next = pastes;
		pastes = mine;
	}
	including[including_depth++] = path;
	for (s = stripped.data; *s;) {
		const size_t this_line = line_number + 1;
		const char *const line = next_line(&s, &line_number);
		const size_t length = strlen(line);
		const char *const name = continued ? NULL : directive(line, "include");
		if (name && *name == '"') {
			include(out, path, this_line, name);
			continue;
		}
		if (!continued)
			track_branches(path, this_line, line, floor, &guard);
		if (length || continued) {
			append(out, line, length);
			append(out, "\n", 1);
		}
		continued = length && line[length - 1] == '\\';
	}
	if (here.depth != floor)
		die(path, line_number, "#if without #endif");
	including_depth--;
	free(stripped.data);
	free(raw.data);
}

static void forget_pastes(void)
{
	while (pastes) {
		paste *const next = pastes->next;
		free(pastes);
		pastes = next;
	}
}

/* An array and not a string: C99 promises no string literal longer than 4095 characters. */
static void print_function(const char *name, const text *t)
{
	size_t i;
	printf("\nconst char *%s(void);\n\nconst char *%s(void)\n{\n\tstatic const char text[] = {", name, name);
	for (i = 0; i <= t->length; i++)
		printf(i % 32 ? "%d," : "\n\t\t%d,", t->data[i]);
	printf("\n\t};\n\treturn text;\n}\n");
}

int main(int argc, char **argv)
{
	int i;
	if (argc < 3 || argc % 2 == 0) {
		fprintf(stderr, "usage: embed FILE FUNCTION [FILE FUNCTION ...] > out.c\n");
		return 2;
	}
	printf("/* Generated by cl/embed.c. */\n");
	for (i = 1; i < argc; i += 2) {
		text out = {0};
		append(&out, "", 0);
		paste_file(&out, argv[i], "embed", 0);
		print_function(argv[i + 1], &out);
		free(out.data);
		forget_pastes();
	}
	if (fflush(stdout) != 0 || ferror(stdout)) {
		fprintf(stderr, "embed: cannot write: %s\n", strerror(errno));
		return 1;
	}
	return 0;
}
