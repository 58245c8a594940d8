# lobe - GNU make. "make" needs a C99 compiler and make, nothing else; "make help" lists the rest.

CC ?= cc
AR ?= ar
PREFIX ?= /usr/local
LIBDIR ?= $(PREFIX)/lib
DESTDIR ?=
STRIP ?= strip
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
endif
LIB_CFLAGS += $(if $(filter avx2,$(ISAS)),-DLOBE_X86)
ISA_baseline :=
ISA_avx2 := -mavx2 -mfma
ISA_avx512 := -mavx2 -mfma -mavx512f -mavx512vl -mavx512dq -mavx512bw -mprefer-vector-width=512

# Sorting alone has one more: bytes are permuted like words.
SPLIT_ISAS := $(ISAS)
ISA_vbmi2 := $(ISA_avx512) -mpopcnt -mavx512vbmi2
ifneq (,$(and $(filter avx512,$(ISAS)),$(shell $(CC) $(ISA_vbmi2) -E -x c /dev/null >/dev/null 2>&1 && echo y)))
SPLIT_ISAS += vbmi2
LIB_CFLAGS += -DLOBE_VBMI2
endif

# For gcc: jump threading would copy divisions into both arms of a select, and the loops are long chains that gain from
# scheduling before registers are given out. The sample loops are unrolled twice (rows.c): -fweb tells the two apart.
ROW_OPT ?= -O3
# -g1: names and lines alone. Where each variable of a vectorised loop went is half the time of compiling it.
ROW_CFLAGS := $(LIB_CFLAGS) $(if $(filter -g%,$(CFLAGS)),-g1) $(ROW_OPT) $(foreach f,-fno-thread-jumps -fschedule-insns -fsched-pressure \
	-fweb --param=sched-pressure-algorithm=2,\
	$(shell $(CC) -Werror $(f) -E -x c /dev/null >/dev/null 2>&1 && echo $(f)))

# The order of instructions that suits processors with AVX-512, where it was seen to help (build/bench/throughput).
TUNE_avx512_ggx_conductor := -mtune=icelake-server
TUNE_avx512_beckmann_conductor := -mtune=icelake-server
TUNE_avx512_ggx_dielectric := -mtune=icelake-server
TUNE_avx512_beckmann_dielectric := -mtune=icelake-server

# Lobes that have a plain form (rows.c).
PLAIN_ggx_dielectric := -DLOBE_ROW_PLAIN=lobe_rough_dielectric

# The compiler's own account of what it vectorised goes to rows_*.vec, beside the object: tests/test_vectorised.sh reads it.
ROW_REPORT := $(firstword $(foreach f,-fopt-info-vec-optimized= -foptimization-record-file=,\
	$(shell $(CC) -Werror $(f)/dev/null -E -x c /dev/null >/dev/null 2>&1 && echo $(f))))

HEADERS := Makefile $(wildcard include/lobe/*.h include/lobe/*/*.h include/lobe/*/*.def src/*.h)

# Backends in the library: make LOBE_OPENCL=0 or LOBE_NATIVE=0 leaves one out, and a few lines that say so take its place.
LOBE_OPENCL ?= 1
LOBE_NATIVE ?= 1
# Whose objects depend on nothing that such builds differ in, so that they can share them.
ROW_DIR ?= $(B)/obj
ROW_FLAGS := $(if $(filter $(B)/obj,$(ROW_DIR)),$(B)/obj/flags)

NATIVE_SOURCES := $(filter-out src/native_split.c,$(wildcard src/native*.c))
OPENCL_SOURCES := $(wildcard src/opencl*.c)
NONE_SOURCES := src/native_none.c src/opencl_none.c
LOOP_SOURCES := src/rows.c src/native_split.c src/linked.c
SOURCES := $(filter-out $(NATIVE_SOURCES) $(OPENCL_SOURCES) $(LOOP_SOURCES) $(NONE_SOURCES),$(wildcard src/*.c))
ROW_OBJECTS := $(foreach i,$(SPLIT_ISAS),$(ROW_DIR)/native_split_$(i).o) \
	$(foreach i,$(ISAS),$(foreach l,$(LOBES),$(ROW_DIR)/rows_$(i)_$(l).o)) $(foreach l,$(LOBES),$(ROW_DIR)/linked_$(l).o)
ifeq ($(LOBE_NATIVE),0)
SOURCES += src/native_none.c
else
SOURCES += $(filter-out $(NONE_SOURCES),$(NATIVE_SOURCES))
LOOPS := $(ROW_OBJECTS)
endif
ifeq ($(LOBE_OPENCL),0)
SOURCES += src/opencl_none.c
else
SOURCES += $(filter-out $(NONE_SOURCES),$(OPENCL_SOURCES))
OPENCL_TEXT := $(B)/obj/opencl_source.o
endif
ifeq ($(LOBE_NATIVE)$(LOBE_OPENCL),00)
$(error LOBE_NATIVE=0 LOBE_OPENCL=0 leaves no backend)
endif
OBJECTS := $(patsubst src/%.c,$(B)/obj/%.o,$(SOURCES)) $(LOOPS) $(OPENCL_TEXT)

all: $(B)/liblobe.a $(B)/liblobe.so $(B)/minimal $(if $(filter-out 0,$(LOBE_NATIVE)),$(B)/batch)

$(sort $(B)/obj $(ROW_DIR)) $(B)/gen $(B)/tests $(B)/bench:
	@mkdir -p $@

# Changes when the compiler or its options do, so that what they gave before is compiled anew.
FLAGS_OF_ALL := $(CC) $(LIB_CFLAGS) $(ROW_CFLAGS)
$(B)/obj/flags: $(shell echo '$(FLAGS_OF_ALL)' | cmp -s - $(B)/obj/flags 2>/dev/null || echo FORCE) | $(B)/obj
	@echo '$(FLAGS_OF_ALL)' > $@

$(B)/obj/%.o: src/%.c $(HEADERS) $(B)/obj/flags | $(B)/obj
	@echo "  cc    $@"
	$(Q)$(CC) $(LIB_CFLAGS) -c $< -o $@

define ROW_RULE
$(ROW_DIR)/rows_$(1)_$(2).o: src/rows.c $(HEADERS) $(ROW_FLAGS) | $(ROW_DIR)
	@echo "  cc    $$@"
	@rm -f $$(@:.o=.vec)
	$(Q)$(CC) $(ROW_CFLAGS) $(ISA_$(1)) $(TUNE_$(1)_$(2)) $(PLAIN_$(2)) $$(if $(ROW_REPORT),$(ROW_REPORT)$$(@:.o=.vec)) -DLOBE_ROW=$(2) -DLOBE_ROW_ISA=$(1) \
		-c src/rows.c -o $$@
endef
$(foreach i,$(ISAS),$(foreach l,$(LOBES),$(eval $(call ROW_RULE,$(i),$(l)))))

define SPLIT_RULE
$(ROW_DIR)/native_split_$(1).o: src/native_split.c $(HEADERS) $(ROW_FLAGS) | $(ROW_DIR)
	@echo "  cc    $$@"
	$(Q)$(CC) $(LIB_CFLAGS) -O3 $(ISA_$(1)) -DLOBE_ROW_ISA=$(1) -c src/native_split.c -o $$@
endef
$(foreach i,$(SPLIT_ISAS),$(eval $(call SPLIT_RULE,$(i))))

define LINKED_RULE
$(ROW_DIR)/linked_$(1).o: src/linked.c $(HEADERS) $(ROW_FLAGS) | $(ROW_DIR)
	@echo "  cc    $$@"
	$(Q)$(CC) $(LIB_CFLAGS) -DLOBE_ROW=$(1) -c src/linked.c -o $$@
endef
$(foreach l,$(LOBES),$(eval $(call LINKED_RULE,$(l))))

# The OpenCL source is the headers themselves, put into the library as text.
$(B)/embed: cl/embed.c
	@mkdir -p $(B)
	@echo "  link  $@"
	$(Q)$(CC) -std=c99 -pedantic $(WARN) $(CFLAGS) $< -o $@

$(B)/gen/opencl_source.c: $(B)/embed $(wildcard cl/*.cl) $(HEADERS) | $(B)/gen
	@echo "  embed $@"
	$(Q)echo '#include "lobe/batch.h"' > $@.tmp
	$(Q)$(B)/embed include/lobe/shading.h lobe_opencl_source cl/kernels.cl lobe_opencl_kernels >> $@.tmp
	@mv $@.tmp $@

$(B)/obj/opencl_source.o: $(B)/gen/opencl_source.c | $(B)/obj
	@echo "  cc    $@"
	$(Q)$(CC) $(LIB_CFLAGS) -c $< -o $@

# Changes when the list of objects does, so that a library of other backends is linked anew.
$(B)/obj/list: FORCE | $(B)/obj
	@echo '$(OBJECTS)' | cmp -s - $@ || echo '$(OBJECTS)' > $@
FORCE:

$(B)/liblobe.a: $(OBJECTS) $(B)/obj/list
	@rm -f $@
	@echo "  ar    $@"
	$(Q)$(AR) rcs $@ $(OBJECTS)

$(B)/liblobe.so: $(OBJECTS) $(B)/obj/list
	@echo "  link  $@"
	$(Q)$(CC) $(CFLAGS) -shared -Wl,-soname,liblobe.so.0 $(OBJECTS) $(LIBS) -o $@

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

# These trace rays on the host and run where they are built: there lobe_fma can be one instruction. Same bits.
NATIVE := $(shell $(CC) -march=native -E -x c /dev/null >/dev/null 2>&1 && echo -march=native)
define PICTURES
$(B)/$(1): $(wildcard examples/$(1)/*.[ch] examples/common/*.[ch]) $(B)/liblobe.a
	@echo "  link  $$@"
	$(Q)$(CC) $(EXAMPLE_CFLAGS) $(NATIVE) -Iexamples/common $(wildcard examples/$(1)/*.c examples/common/*.c) $(B)/liblobe.a \
		-o $$@ $$$$(pkg-config --cflags OpenEXR libpng) -lOpenEXRCore -lOpenEXR $$$$(pkg-config --libs libpng) $(LIBS)
endef
$(eval $(call PICTURES,gallery))
$(eval $(call PICTURES,heightfield))

# --- demo, tests, benchmarks: each installs what it lacks, then builds on all processors --------------------------------

# -j of the caller's, or one job for each processor.
JOBS = $(if $(findstring -j,$(MAKEFLAGS)),,-j$(shell nproc 2>/dev/null || echo 2))

# PoCL's threads stay on a processor each: where they wander, a batch may take twice as long.
run bench report: export POCL_AFFINITY ?= 1

run:
	@./deps.sh run
	+@$(MAKE) --no-print-directory $(JOBS) all $(B)/own_kernel $(B)/gallery $(B)/heightfield
	@echo; echo "== one lobe, header only (build/minimal) =="
	@$(B)/minimal
	@echo; echo "== a batch on each device (build/batch) =="
	@$(B)/batch
	@echo; echo "== a user's own OpenCL kernel (build/own_kernel) =="
	@$(B)/own_kernel
	@echo; echo "== material gallery on each device (build/gallery) =="
	@$(B)/gallery
	@echo; echo "== from a height field to a lobe (build/heightfield) =="
	@$(B)/heightfield

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
# Millions of evaluations: with lobe_fma as one instruction where the processor has it, which gives the same bits in a third
# of the time. As a user's program is by default, with lobe_fma in double: the tests of it and of known answers,
# the scalar functions of test_equivalence, and the materials of all.
TEST_PLAIN := test_real test_core test_fma test_vectors scalar cases
TEST_NATIVE := $(NATIVE)
$(patsubst %,$(B)/tests/%.o,$(TEST_PLAIN)): private TEST_NATIVE :=
$(B)/tests/%.o: tests/%.c $(HEADERS) $(TEST_HEADERS) | $(B)/tests
	@echo "  cc    $@"
	$(Q)$(CC) $(TEST_CFLAGS) $(TEST_NATIVE) -c $< -o $@

$(B)/tests/libtest.a: $(patsubst tests/%.c,$(B)/tests/%.o,$(TEST_SHARED)) $(B)/tests/unity.o
	@rm -f $@
	@echo "  ar    $@"
	$(Q)$(AR) rcs $@ $^

$(B)/tests/%: $(B)/tests/%.o $(B)/tests/libtest.a $(B)/liblobe.a
	@echo "  link  $@"
	$(Q)$(CC) $(CFLAGS) $< $(B)/tests/libtest.a $(B)/liblobe.a -o $@ $(TEST_LIBS)

.SECONDARY:

# The longest first, lest one of them runs alone at the end.
LONGEST := test_same_bits.sh test_equivalence test_sanitize.sh test_lobes_chi2 test_sources.sh test_distributions_visible \
	test_vectorised.sh test_fallback test_strategies test_opencl_faults test_real test_opencl_cache
longest_first = $(foreach t,$(LONGEST),$(filter %/$(t),$(1))) $(filter-out $(addprefix %/,$(LONGEST)),$(1))
SHORT_TESTS := $(patsubst tests/%.c,$(B)/tests/%,$(wildcard tests/test_*.c)) $(wildcard tests/test_*.sh)
LONG_TESTS := $(patsubst tests/%.c,$(B)/tests/%,$(wildcard tests/long_*.c)) $(wildcard tests/long_*.sh)

test:
	@./deps.sh test
	+@$(MAKE) --no-print-directory $(JOBS) all $(B)/own_kernel $(B)/gallery $(B)/heightfield $(TEST_PROGRAMS)
	@CC="$(CC)" tests/run.sh $(call longest_first,$(SHORT_TESTS))

# The slow sweeps: every float through every elementary function, and the tests' larger settings.
test-long:
	@./deps.sh test
	+@$(MAKE) --no-print-directory $(JOBS) all $(B)/own_kernel $(B)/gallery $(B)/heightfield $(TEST_PROGRAMS)
	@CC="$(CC)" LOBE_TEST_LONG=1 tests/run.sh $(LONG_TESTS) $(call longest_first,$(SHORT_TESTS))

# Writes the known-answer vectors anew; git diff shows what changed.
vectors:
	@./deps.sh test
	+@$(MAKE) --no-print-directory $(JOBS) $(B)/tests/tool_vectors
	@$(B)/tests/tool_vectors tests/vectors

BENCH_COMMON := examples/common/folders.c examples/common/processors.c
THROUGHPUT := $(filter-out bench/strategies.c bench/hand_rows.c bench/peak.c,$(wildcard bench/*.c)) $(BENCH_COMMON)
BENCH_LOOPS := $(foreach i,$(ISAS),$(B)/bench/hand_rows_$(i).o $(B)/bench/peak_$(i).o)
define BENCH_RULE
$(B)/bench/%_$(1).o: bench/%.c $(HEADERS) $(wildcard bench/*.h) | $(B)/bench
	@echo "  cc    $$@"
	$(Q)$(CC) $(ROW_CFLAGS) $(ISA_$(1)) -DLOBE_ROW_ISA=$(1) -c $$< -o $$@
endef
$(foreach i,$(ISAS),$(eval $(call BENCH_RULE,$(i))))

$(B)/bench/throughput: $(THROUGHPUT) $(BENCH_LOOPS) $(wildcard bench/*.h examples/common/*.h) $(B)/liblobe.a $(B)/liblobe.so | $(B)/bench
	@echo "  link  $@"
	$(Q)$(CC) -std=c99 -pedantic $(WARN) $(CFLAGS) $(EXACT) $(filter -DLOBE_X86,$(LIB_CFLAGS)) -Iinclude -Isrc $(THROUGHPUT) \
		$(BENCH_LOOPS) $(B)/liblobe.a -o $@ $(LIBS)

STRATEGIES := bench/strategies.c bench/machine.c bench/timing.c $(BENCH_COMMON)
$(B)/bench/strategies: $(STRATEGIES) $(wildcard bench/*.h bench/report/strategies_names.h examples/common/*.h) $(B)/liblobe.a \
		| $(B)/bench
	@echo "  link  $@"
	$(Q)$(CC) -std=c99 -pedantic $(WARN) $(CFLAGS) $(EXACT) $(NATIVE) -Iinclude -Isrc $(STRATEGIES) $(B)/liblobe.a -o $@ $(LIBS)

bench:
	@./deps.sh all
	+@$(MAKE) --no-print-directory $(JOBS) all $(B)/bench/throughput $(B)/bench/strategies
	+@$(MAKE) --no-print-directory $(JOBS) B=$(B)/no_opencl ROW_DIR=$(B)/obj LOBE_OPENCL=0 $(B)/no_opencl/liblobe.so
	+@$(MAKE) --no-print-directory $(JOBS) B=$(B)/no_native LOBE_NATIVE=0 $(B)/no_native/liblobe.so
	@$(B)/bench/throughput
	@$(B)/bench/strategies
	@! command -v gnuplot >/dev/null || gnuplot bench/plots.gp

FIGURES := $(wildcard bench/figures/*.c) bench/machine.c $(BENCH_COMMON)
$(B)/bench/figures: $(FIGURES) $(wildcard bench/*.h bench/figures/*.h examples/common/*.h) $(B)/liblobe.a | $(B)/bench
	@echo "  link  $@"
	$(Q)$(CC) -std=c99 -pedantic $(WARN) $(CFLAGS) $(EXACT) -Iinclude -Isrc $(FIGURES) $(B)/liblobe.a -o $@ $(LIBS)

# The figures of the microfacet papers, from the library's own functions.
figures:
	@./deps.sh all
	+@$(MAKE) --no-print-directory $(JOBS) $(B)/bench/figures
	@$(B)/bench/figures
	@gnuplot bench/figures/figures.gp
	@echo "out/figures: $$(ls out/figures/*.png | wc -l) figures"

# Error against run time, and stability at the extremes. QUICK=1: in minutes. Everything but the main program is a library,
# for tests of the studies. LOBE_REPORT_PROBES names light probes; empty, there are none, and none are fetched.
REPORT_SOURCES := $(filter-out bench/report/main.c,$(wildcard bench/report/*.c))
REPORT_COMMON := $(filter-out examples/common/progress.c,$(wildcard examples/common/*.c)) examples/gallery/light.c \
	bench/machine.c bench/timing.c
REPORT_OBJECTS := $(patsubst %.c,$(B)/report/%.o,$(REPORT_SOURCES) $(REPORT_COMMON))
REPORT_LIBS := $(B)/bench/libreport.a $(B)/tests/libtest.a $(B)/liblobe.a -lOpenEXRCore -lOpenEXR -lpng -lquadmath $(TEST_LIBS)
REPORT_CFLAGS := $(TEST_CFLAGS) $(NATIVE) -Iexamples/common -Iexamples/gallery -Ibench/report $(shell pkg-config --cflags OpenEXR libpng 2>/dev/null)
# Timed loops are compiled as the library's own are.
$(B)/report/bench/report/approximations_loops.o $(B)/report/bench/report/approximations_single.o \
	$(B)/report/bench/report/approximations_double.o $(B)/report/bench/report/approximations_field.o: \
	private REPORT_CFLAGS += $(ROW_CFLAGS)
$(B)/report/bench/report/approximations_double.o: private REPORT_CFLAGS += -DLOBE_DOUBLE=1
REPORT_HEADERS := $(wildcard bench/*.h bench/report/*.h examples/*/*.h tests/*.h)
$(B)/report/%.o: %.c $(HEADERS) $(REPORT_HEADERS)
	@mkdir -p $(@D)
	@echo "  cc    $@"
	$(Q)$(CC) $(REPORT_CFLAGS) -c $< -o $@

$(B)/bench/libreport.a: $(REPORT_OBJECTS) | $(B)/bench
	@rm -f $@
	@echo "  ar    $@"
	$(Q)$(AR) rcs $@ $^

$(B)/bench/report: $(B)/report/bench/report/main.o $(B)/bench/libreport.a $(B)/tests/libtest.a $(B)/liblobe.a
	@echo "  link  $@"
	$(Q)$(CC) $(CFLAGS) $< $(REPORT_LIBS) -o $@

REPORT_TESTS := $(patsubst tests/%.c,$(B)/tests/%,$(wildcard tests/test_report*.c tests/test_stability*.c))
$(REPORT_TESTS:=.o): private TEST_CFLAGS += -Ibench/report -Iexamples/common -Iexamples/gallery
$(REPORT_TESTS:=.o): $(REPORT_HEADERS)
$(REPORT_TESTS): $(B)/tests/%: $(B)/tests/%.o $(B)/bench/libreport.a $(B)/tests/libtest.a $(B)/liblobe.a
	@echo "  link  $@"
	$(Q)$(CC) $(CFLAGS) $< $(REPORT_LIBS) -o $@

report:
	@./deps.sh all
	@[ -n "$${LOBE_REPORT_PROBES+set}" ] || ./deps.sh probes
	+@$(MAKE) --no-print-directory $(JOBS) $(B)/bench/report
	@$(B)/bench/report $(if $(QUICK),--quick) $(OPTIONS)

# Real light probes, for the report (which asks for them itself) and build/gallery --probe.
probes:
	@./deps.sh probes

# The report's part of README.md.
readme:
	@bench/report/readme.sh

# Mitsuba 3 beside lobe, in turn; skipped, with a word why, where it cannot be installed. OPTIONS: of bench/peers/mitsuba.py.
bench-peers:
	@./deps.sh all
	+@$(MAKE) --no-print-directory $(JOBS) $(B)/bench/throughput
	@bench/peers/mitsuba.sh $(OPTIONS)

# PoCL beside Intel's OpenCL runtime for processors; skipped, with a word why, where that cannot be had.
$(B)/bench/opencl: bench/peers/opencl.c bench/race.c bench/timing.c bench/inputs.c bench/scenes.c bench/machine.c $(BENCH_COMMON) \
		$(wildcard bench/*.h) $(B)/tests/libtest.a $(B)/liblobe.a | $(B)/bench
	@echo "  link  $@"
	$(Q)$(CC) $(TEST_CFLAGS) -I. -Iexamples/common $(filter %.c,$^) $(filter %.a,$^) -o $@ $(TEST_LIBS)

bench-opencl:
	@./deps.sh test
	+@$(MAKE) --no-print-directory $(JOBS) $(B)/bench/opencl
	@bench/peers/opencl.sh

check:
	@./deps.sh all
	@tests/check.sh

deps:
	@./deps.sh all

# --- installation -----------------------------------------------------------------------------------------------------

INSTALLED_LIBS := liblobe.a liblobe.so liblobe.so.0 liblobe.so.$(VERSION)

# Without what only a debugger wants, which is most of their size.
install: $(B)/liblobe.a $(B)/liblobe.so
	install -d $(DESTDIR)$(LIBDIR)/pkgconfig
	for dir in lobe lobe/backend lobe/core lobe/microfacet lobe/lobes; do \
		install -d $(DESTDIR)$(PREFIX)/include/$$dir && \
		install -m 644 include/$$dir/*.* $(DESTDIR)$(PREFIX)/include/$$dir || exit 1; \
	done
	install -m 644 $(B)/liblobe.a $(DESTDIR)$(LIBDIR)
	install -m 755 $(B)/liblobe.so $(DESTDIR)$(LIBDIR)/liblobe.so.$(VERSION)
	$(STRIP) --strip-debug $(DESTDIR)$(LIBDIR)/liblobe.a $(DESTDIR)$(LIBDIR)/liblobe.so.$(VERSION)
	ln -sf liblobe.so.$(VERSION) $(DESTDIR)$(LIBDIR)/liblobe.so.0
	ln -sf liblobe.so.0 $(DESTDIR)$(LIBDIR)/liblobe.so
	printf '%s\n' 'prefix=$(PREFIX)' 'includedir=$${prefix}/include' 'libdir=$(patsubst $(PREFIX)/%,$${prefix}/%,$(LIBDIR))' '' 'Name: lobe' \
		'Description: BSDF lobes in C99 and OpenCL, with the same bits' 'Version: $(VERSION)' \
		'Cflags: -I$${includedir} -ffp-contract=off' 'Libs: -L$${libdir} -llobe -lm' 'Libs.private: $(LIBS)' \
		> $(DESTDIR)$(LIBDIR)/pkgconfig/lobe.pc

uninstall:
	rm -rf $(DESTDIR)$(PREFIX)/include/lobe
	rm -f $(addprefix $(DESTDIR)$(LIBDIR)/,$(INSTALLED_LIBS) pkgconfig/lobe.pc)

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
		'make bench      throughput, its ceilings and scaling, build times, what pruning saves; out/bench/*.csv' \
		'make bench-peers  Mitsuba 3 beside lobe (installs it in build/peers); out/bench/peers.csv' \
		'make bench-opencl  PoCL beside Intel'"'"'s OpenCL runtime (installs it in build/others); out/bench/opencl.csv' \
		'make figures    D, G1, masking, albedo, visible normals: out/figures/*.png' \
		'make report     error against run time, stability, furnaces: out/report/report.md; QUICK=1 in minutes' \
		'make probes     fetches real light probes for the report and the gallery into build/probes' \
		'make readme     puts the last report into README.md and doc/' \
		'make check      static analysis and sanitizers' \
		'make vectors    writes tests/vectors/ anew' \
		'make deps       installs all that the targets above need' \
		'make install    PREFIX=/usr/local LIBDIR=PREFIX/lib DESTDIR=; make uninstall' \
		'make LOBE_OPENCL=0, make LOBE_NATIVE=0   the library without that backend' \
		'make clean      removes build/ and out/'

.PHONY: FORCE all run test test-long vectors bench bench-peers bench-opencl figures report probes readme check deps install uninstall clean help

# Several goals at once (make clean all) in their order.
ifeq ($(MAKELEVEL),0)
ifneq (,$(word 2,$(MAKECMDGOALS)))
.NOTPARALLEL:
endif
endif
