# lobe - GNU make. "make" needs a C99 compiler and make, nothing else; "make help" lists the rest.

CC ?= cc
AR ?= ar
PREFIX ?= /usr/local
DESTDIR ?=
CFLAGS ?= -O2 -g

VERSION := 0.1.0
# make V=1 shows the commands.
Q := $(if $(V),,@)
B := build
WARN := -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion
# The same bits everywhere: no fusing of a*b+c behind the source's back. The other two let loops vectorise.
EXACT := -ffp-contract=off -fno-math-errno -fno-trapping-math
LIB_CFLAGS := -std=c99 -pedantic $(WARN) $(CFLAGS) $(EXACT) -fPIC -fvisibility=hidden -Iinclude -Isrc
LIBS := -lm -ldl -lpthread

# --- library ----------------------------------------------------------------------------------------------------------

LOBES := $(shell sed -n 's/^LOBE_X[A-Z_]*.[A-Z0-9_]*, \([a-z0-9_]*\),.*/\1/p' include/lobe/lobes/lobes.def)

ISAS := baseline
ifneq (,$(findstring x86_64,$(shell $(CC) -dumpmachine 2>/dev/null)))
ISAS += avx2 avx512
LIB_CFLAGS += -DLOBE_X86
endif
ISA_baseline :=
ISA_avx2 := -mavx2 -mfma
ISA_avx512 := -mavx2 -mfma -mavx512f -mavx512vl -mavx512dq -mavx512bw -mprefer-vector-width=512

# For gcc: jump threading would copy divisions into both arms of a select, and the loops are long chains that gain from
# scheduling before registers are given out.
ROW_OPT ?= -O3
ROW_CFLAGS := $(LIB_CFLAGS) $(ROW_OPT) $(foreach f,-fno-thread-jumps -fschedule-insns -fsched-pressure,\
	$(shell $(CC) -Werror $(f) -E -x c /dev/null >/dev/null 2>&1 && echo $(f)))

SOURCES := $(wildcard src/*.c)
HEADERS := Makefile $(wildcard include/lobe/*.h include/lobe/*/*.h include/lobe/*/*.def src/*.h)
ROW_OBJECTS := $(foreach i,$(ISAS),$(foreach l,$(LOBES),$(B)/obj/rows_$(i)_$(l).o))
OBJECTS := $(patsubst src/%.c,$(B)/obj/%.o,$(filter-out src/rows.c,$(SOURCES))) $(ROW_OBJECTS) $(B)/obj/opencl_source.o

all: $(B)/liblobe.a $(B)/liblobe.so $(B)/minimal $(B)/batch

$(B)/obj $(B)/gen $(B)/tests $(B)/bench:
	@mkdir -p $@

$(B)/obj/%.o: src/%.c $(HEADERS) | $(B)/obj
	@echo "  cc    $@"
	$(Q)$(CC) $(LIB_CFLAGS) -c $< -o $@

define ROW_RULE
$(B)/obj/rows_$(1)_$(2).o: src/rows.c $(HEADERS) | $(B)/obj
	@echo "  cc    $$@"
	$(Q)$(CC) $(ROW_CFLAGS) $(ISA_$(1)) -DLOBE_ROW=$(2) -DLOBE_ROW_ISA=$(1) -c src/rows.c -o $$@
endef
$(foreach i,$(ISAS),$(foreach l,$(LOBES),$(eval $(call ROW_RULE,$(i),$(l)))))

# The OpenCL source is the headers themselves, put into the library as text.
$(B)/embed: cl/embed.c
	@mkdir -p $(B)
	@echo "  link  $@"
	$(Q)$(CC) -std=c99 -pedantic $(WARN) $(CFLAGS) $< -o $@

$(B)/gen/opencl_source.c: $(B)/embed cl/kernels.cl $(HEADERS) | $(B)/gen
	@echo "  embed $@"
	$(Q)echo '#include "lobe/batch.h"' > $@.tmp
	$(Q)$(B)/embed include/lobe/shading.h lobe_opencl_source cl/kernels.cl lobe_opencl_kernels >> $@.tmp
	@mv $@.tmp $@

$(B)/obj/opencl_source.o: $(B)/gen/opencl_source.c | $(B)/obj
	@echo "  cc    $@"
	$(Q)$(CC) $(LIB_CFLAGS) -c $< -o $@

$(B)/liblobe.a: $(OBJECTS)
	@rm -f $@
	@echo "  ar    $@"
	$(Q)$(AR) rcs $@ $^

$(B)/liblobe.so: $(OBJECTS)
	@echo "  link  $@"
	$(Q)$(CC) $(CFLAGS) -shared -Wl,-soname,liblobe.so.0 $^ $(LIBS) -o $@

# --- examples ---------------------------------------------------------------------------------------------------------

EXAMPLE_CFLAGS := -std=c99 -pedantic $(WARN) $(CFLAGS) $(EXACT) -Iinclude

# Needs no library: the headers are all.
$(B)/minimal: examples/minimal.c $(HEADERS) | $(B)/obj
	@echo "  link  $@"
	$(Q)$(CC) $(EXAMPLE_CFLAGS) $< -o $@ -lm

$(B)/batch: examples/batch.c $(B)/liblobe.a
	@echo "  link  $@"
	$(Q)$(CC) $(EXAMPLE_CFLAGS) $< $(B)/liblobe.a -o $@ $(LIBS)

$(B)/own_kernel: examples/own_kernel.c $(B)/liblobe.a
	@echo "  link  $@"
	$(Q)$(CC) $(EXAMPLE_CFLAGS) $< $(B)/liblobe.a -o $@ -lOpenCL $(LIBS)

# The gallery traces rays on the host and runs where it is built: there lobe_fma can be one instruction. Same bits.
NATIVE := $(shell $(CC) -march=native -E -x c /dev/null >/dev/null 2>&1 && echo -march=native)
GALLERY := $(wildcard examples/gallery/*.c)
$(B)/gallery: $(GALLERY) $(wildcard examples/gallery/*.h) $(B)/liblobe.a
	@echo "  link  $@"
	$(Q)$(CC) $(EXAMPLE_CFLAGS) $(NATIVE) -Iexamples/gallery $(GALLERY) $(B)/liblobe.a -o $@ \
		$$(pkg-config --cflags OpenEXR libpng) -lOpenEXRCore -lOpenEXR $$(pkg-config --libs libpng) $(LIBS)

# --- demo, tests, benchmarks: each installs what it lacks, then builds on all processors --------------------------------

# -j of the caller's, or one job for each processor.
JOBS = $(if $(findstring -j,$(MAKEFLAGS)),,-j$(shell nproc 2>/dev/null || echo 2))

run:
	@./deps.sh run
	+@$(MAKE) --no-print-directory $(JOBS) all $(B)/own_kernel $(B)/gallery
	@echo; echo "== one lobe, header only (build/minimal) =="
	@$(B)/minimal
	@echo; echo "== a batch on each device (build/batch) =="
	@$(B)/batch
	@echo; echo "== a user's own OpenCL kernel (build/own_kernel) =="
	@$(B)/own_kernel
	@echo; echo "== material gallery on each device (build/gallery) =="
	@$(B)/gallery

TEST_CFLAGS := -std=c99 -pedantic $(WARN) $(CFLAGS) $(EXACT) -Iinclude -Isrc -Itests -isystem tests/vendor/unity
TEST_LIBS := -lgsl -lgslcblas -lmpfr -lgmp $(LIBS)
TEST_HEADERS := $(wildcard tests/*.h)
TEST_MAINS := $(wildcard tests/test_*.c tests/long_*.c tests/tool_*.c)
TEST_SHARED := $(filter-out $(TEST_MAINS),$(wildcard tests/*.c))
TEST_PROGRAMS := $(patsubst tests/%.c,$(B)/tests/%,$(TEST_MAINS))

$(B)/tests/unity.o: tests/vendor/unity/unity.c | $(B)/tests
	@echo "  cc    $@"
	$(Q)$(CC) -std=c99 $(CFLAGS) -c $< -o $@

# The reference build of the lobes in double precision.
$(B)/tests/double.o: private TEST_CFLAGS += -DLOBE_DOUBLE=1
$(B)/tests/double_distributions.o: private TEST_CFLAGS += -DLOBE_DOUBLE=1
# Millions of samples: with lobe_fma as one instruction where the processor has it. Same bits.
$(B)/tests/test_distributions_visible.o: private TEST_CFLAGS += $(NATIVE)
$(B)/tests/%.o: tests/%.c $(HEADERS) $(TEST_HEADERS) | $(B)/tests
	@echo "  cc    $@"
	$(Q)$(CC) $(TEST_CFLAGS) -c $< -o $@

$(B)/tests/libtest.a: $(patsubst tests/%.c,$(B)/tests/%.o,$(TEST_SHARED)) $(B)/tests/unity.o
	@rm -f $@
	@echo "  ar    $@"
	$(Q)$(AR) rcs $@ $^

$(B)/tests/%: $(B)/tests/%.o $(B)/tests/libtest.a $(B)/liblobe.a
	@echo "  link  $@"
	$(Q)$(CC) $(CFLAGS) $< $(B)/tests/libtest.a $(B)/liblobe.a -o $@ $(TEST_LIBS)

.SECONDARY:

test:
	@./deps.sh test
	+@$(MAKE) --no-print-directory $(JOBS) all $(B)/own_kernel $(B)/gallery $(TEST_PROGRAMS)
	@CC="$(CC)" tests/run.sh $(patsubst tests/%.c,$(B)/tests/%,$(wildcard tests/test_*.c)) $(wildcard tests/test_*.sh)

# The slow sweeps: every float through every elementary function, and the tests' larger settings.
test-long:
	@./deps.sh test
	+@$(MAKE) --no-print-directory $(JOBS) all $(B)/own_kernel $(B)/gallery $(TEST_PROGRAMS)
	@CC="$(CC)" LOBE_TEST_LONG=1 tests/run.sh $(patsubst tests/%.c,$(B)/tests/%,$(wildcard tests/test_*.c tests/long_*.c)) \
		$(wildcard tests/test_*.sh)

# Writes the known-answer vectors anew; git diff shows what changed.
vectors: $(B)/tests/tool_vectors
	$(B)/tests/tool_vectors tests/vectors

THROUGHPUT := $(patsubst %,bench/%.c,throughput timing scenes inputs measure machine options build_time pruning targets)
$(B)/bench/throughput: $(THROUGHPUT) $(wildcard bench/*.h) $(B)/liblobe.a $(B)/liblobe.so | $(B)/bench
	@echo "  link  $@"
	$(Q)$(CC) -std=c99 -pedantic $(WARN) $(CFLAGS) $(EXACT) -Iinclude -Isrc $(THROUGHPUT) $(B)/liblobe.a -o $@ $(LIBS)

bench:
	@./deps.sh all
	+@$(MAKE) --no-print-directory $(JOBS) all $(B)/bench/throughput
	@$(B)/bench/throughput
	@! command -v gnuplot >/dev/null || gnuplot bench/plots.gp

check:
	@./deps.sh all
	@tests/check.sh

deps:
	@./deps.sh all

# --- installation -----------------------------------------------------------------------------------------------------

install: $(B)/liblobe.a $(B)/liblobe.so
	install -d $(DESTDIR)$(PREFIX)/lib/pkgconfig
	for dir in lobe lobe/backend lobe/core lobe/microfacet lobe/lobes; do \
		install -d $(DESTDIR)$(PREFIX)/include/$$dir; \
		install -m 644 include/$$dir/*.* $(DESTDIR)$(PREFIX)/include/$$dir; \
	done
	install -m 644 $(B)/liblobe.a $(DESTDIR)$(PREFIX)/lib
	install -m 755 $(B)/liblobe.so $(DESTDIR)$(PREFIX)/lib/liblobe.so.$(VERSION)
	ln -sf liblobe.so.$(VERSION) $(DESTDIR)$(PREFIX)/lib/liblobe.so.0
	ln -sf liblobe.so.0 $(DESTDIR)$(PREFIX)/lib/liblobe.so
	printf '%s\n' 'prefix=$(PREFIX)' 'includedir=$${prefix}/include' 'libdir=$${prefix}/lib' '' 'Name: lobe' \
		'Description: BSDF lobes in C99 and OpenCL, with the same bits' 'Version: $(VERSION)' \
		'Cflags: -I$${includedir} -ffp-contract=off' 'Libs: -L$${libdir} -llobe' 'Libs.private: $(LIBS)' \
		> $(DESTDIR)$(PREFIX)/lib/pkgconfig/lobe.pc

clean:
	rm -rf $(B) out

# What tests ask: make print-ROW_CFLAGS
print-%:
	@echo '$($*)'

help:
	@printf '%s\n' \
		'make            the library and the examples that need nothing else' \
		'make run        the demo on the native backend and on every OpenCL device' \
		'make test       every test; the last line counts them' \
		'make test-long  the slow sweeps too (an hour)' \
		'make bench      throughput, build times, what pruning saves; out/bench/*.csv' \
		'make check      static analysis and sanitizers' \
		'make vectors    writes tests/vectors/ anew' \
		'make deps       installs all that the targets above need' \
		'make install    PREFIX=/usr/local DESTDIR=' \
		'make clean      removes build/ and out/'

.PHONY: all run test test-long vectors bench check deps install clean help

# Several goals at once (make clean all) in their order.
ifeq ($(MAKELEVEL),0)
ifneq (,$(word 2,$(MAKECMDGOALS)))
.NOTPARALLEL:
endif
endif
