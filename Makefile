# Fractional variational integrators: a course that runs.
#
# `make` builds the program build/fvi; `make help` lists the targets. Every file
# that is made goes under $(B), except the figures and the reference headers,
# which are committed. One stem names a module, its chapter, test, proof, figure.

B      := build
PYTHON ?= /usr/bin/python3
GNUPLOT ?= gnuplot
CFLAGS ?= -O2 -g
ifeq ($(origin CC),default)
CC := gcc
endif

# No -ffast-math: the weights need their roundings. No contraction to fma where
# none is written: the last bits must not depend on the compiler.
DIALECT  := -std=c11 -fopenmp-simd -ffp-contract=off
WARNINGS := -Wall -Wextra -Wconversion -Wshadow -pedantic

# pkg-config is asked once, and only after `tools` has had its turn.
GSL_CFLAGS = $(eval GSL_CFLAGS := $$(shell pkg-config --cflags gsl))$(GSL_CFLAGS)
GSL_LIBS   = $(eval GSL_LIBS := $$(shell pkg-config --libs gsl))$(GSL_LIBS)
CHECK_CFLAGS = $(eval CHECK_CFLAGS := $$(shell pkg-config --cflags check))$(CHECK_CFLAGS)
CERF_LIBS    = $(eval CERF_LIBS := $$(shell pkg-config --libs libcerf))$(CERF_LIBS)
CHECK_LIBS   = $(eval CHECK_LIBS := $$(shell pkg-config --libs check))$(CHECK_LIBS)

PROGRAM  := fvi_cli fvi_run fvi_options fvi_values fvi_output fvi_table fvi_words
MODULES  := $(filter-out $(PROGRAM),$(patsubst src/%.c,%,$(wildcard src/*.c)))
TESTS    := $(patsubst tests/test_%.c,%,$(wildcard tests/test_*.c))
BENCHES  := $(patsubst tests/bench_%.c,%,$(wildcard tests/bench_*.c))
TABLE_memory    := figures/memory_bench.tsv
TABLE_precision := figures/step_search.tsv
TABLE_chain     := figures/chain_bench.tsv
PROOFS   := $(filter-out refgen excerpts links mutants quoted,$(patsubst verify/%.py,%,$(wildcard verify/*.py)))
SCENES   := $(patsubst figures/%.c,%,$(wildcard figures/*.c))
DIAGRAMS := $(filter-out $(SCENES) style,$(patsubst figures/%.gp,%,$(wildcard figures/*.gp)))
CHAPTERS := $(patsubst chapters/%.md,%,$(wildcard chapters/[0-9][0-9]-*.md))
NUMBERS  := $(foreach c,$(CHAPTERS),ch$(firstword $(subst -, ,$c)))

ifeq ($(MAKELEVEL),0)
MAKEFLAGS += --jobs=$(shell nproc 2>/dev/null || echo 2) --output-sync=line
endif
MAKEFLAGS += --no-builtin-rules
# Of tests that fail, all are shown.
ifneq ($(filter test check ch%,$(MAKECMDGOALS)),)
MAKEFLAGS += --keep-going
endif
.DELETE_ON_ERROR:
.SECONDARY:
.SUFFIXES:

all: $B/fvi ## build the program build/fvi (bare `make` does this)
	@echo 'built $B/fvi; "make help" lists the targets'

## -- targets for people ----------------------------------------------------

help: ## print this list
	@echo 'make TARGET, where TARGET is'
	@sed -nE 's/^([a-zA-Z%-]+):[^#]*## (.*)/  \1|\2/p' Makefile | awk -F'|' '{ printf "%-14s %s\n", $$1, $$2 }'
	@echo '  ch04           one chapter: its test, its proof, its figures ($(NUMBERS))'
	@echo 'and, for one STEM, test-STEM, verify-STEM, figures-STEM; stems:'
	@echo '  $(TESTS)' | fold -s -w 76 | sed '2,$$s/^/  /'

check: test test-install test-play verify text ## everything: tests, proofs, chapters equal to the code

test: $(TESTS:%=test-%) test-example ## run every test (needs gcc, GSL, Check; no Python, no gnuplot)

verify: $(PROOFS:%=verify-%) ## prove with sympy; compare the reference values with tests/*_ref.h

figures: $(SCENES:%=figures/%.svg) $(DIAGRAMS:%=figures/%.svg) ## draw what changed of the figures

text: | tools ## compare code and numbers in the chapters with their sources; follow every link
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) verify/excerpts.py --check
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) verify/quoted.py --check
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) verify/links.py

excerpts: | tools ## rewrite code and numbers quoted in the chapters from their sources
	PYTHONDONTWRITEBYTECODE=1 $(PYTHON) verify/excerpts.py
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) verify/quoted.py

book: text | tools ## the chapters as one HTML page, build/book/index.html (pandoc, KaTeX)
	PYTHONDONTWRITEBYTECODE=1 $(PYTHON) chapters/book/build.py $B/book

pdf: book ## the same on paper, build/book/fvi.pdf (Chromium)
	chromium --headless --no-sandbox --disable-gpu --no-pdf-header-footer --generate-pdf-document-outline \
	  --print-to-pdf=$B/book/fvi.pdf "file://$$(cd $B/book && pwd)/print.html" 2>$B/book/chromium.log
	@test -s $B/book/fvi.pdf

# Each number that the prose quotes from a test: the least and the largest seen.
seen: $(patsubst %,$B/seen/%.tsv,$(or $(STEM),$(TESTS))) ## what the tests see, into tests/seen.tsv (STEM=fvi for one)
	PYTHONDONTWRITEBYTECODE=1 $(PYTHON) verify/quoted.py --gather $^

$B/seen/%.tsv: $B/tests/test_% | $B/fvi tools
	@mkdir -p $(@D)
	@: > $@; SEEN=$@ FVI=$B/fvi $<

play: | tools ## the live page, chapters/play/index.html (clang, lld, wasi-libc)
	PYTHONDONTWRITEBYTECODE=1 $(PYTHON) chapters/play/build.py $B/play
	@cmp -s $B/play/index.html chapters/play/index.html || cp $B/play/index.html chapters/play/index.html

test-play: $B/fvi | tools ## the live page's numbers against build/fvi (node)
	@node chapters/play/test_play.mjs chapters/play/index.html $B/fvi

test-page: | tools ## the live page in a browser: a click, a drag, the keyboard (node, Chromium)
	@node chapters/play/test_page.mjs chapters/play/index.html $B/play

refs: $(PROOFS:%=refs-%) ## accept new reference values into tests/

san: ## the tests under AddressSanitizer and UBSan
	ASAN_OPTIONS=allocator_may_return_null=1 $(MAKE) B=$B/san CFLAGS='-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all' test

valgrind: $(TESTS:%=valgrind-%) ## the tests under valgrind (many minutes)

$(TESTS:%=valgrind-%): valgrind-%: $B/tests/test_% $B/fvi | tools
	@FVI=$B/fvi CK_FORK=no CK_TIMEOUT_MULTIPLIER=50 valgrind -q --leak-check=full --error-exitcode=1 $<

stress: $B/stress ## random runs against truths and identities, minutes (SEED=1 FAMILY=exact CASE=7)
	@$< $(or $(SEED),1) $(FAMILY) $(CASE)

bench: $(BENCHES:%=$B/tests/bench_%) ## time the memories and all methods, minutes; then `make figures excerpts`
	+@$(foreach b,$(BENCHES),$B/tests/bench_$b > $B/$b.tsv && mv $B/$b.tsv $(TABLE_$b) &&) true

mutants: $B/libfvi.a | tools ## test the tests: each wrong line of tests/mutants.txt must be named (minutes)
	@CC='$(CC)' CFLAGS='$(DIALECT) -O1 $(GSL_CFLAGS) $(CHECK_CFLAGS)' LIBS='$(GSL_LIBS) $(CHECK_LIBS)' \
	  PYTHONDONTWRITEBYTECODE=1 $(PYTHON) verify/mutants.py $B $(STEM)

clean: ## remove everything that was made
	rm -rf $B

# One chapter: `make ch04` is what belongs to the stem of chapters/04-*.md.
stem = $(patsubst $(patsubst ch%,%,$1)-%,%,$(filter $(patsubst ch%,%,$1)-%,$(CHAPTERS)))
of_stem = $(filter $1 $1_%,$(SCENES) $(DIAGRAMS))
define chapter
$1: $B/fvi $(filter test-$2 test-$2_%,$(TESTS:%=test-%)) $(filter verify-$2 verify-$2_%,$(PROOFS:%=verify-%)) figures-$2
figures-$2: $(patsubst %,figures/%.svg,$(call of_stem,$2))
.PHONY: $1 figures-$2
endef
$(foreach n,$(NUMBERS),$(eval $(call chapter,$n,$(call stem,$n))))

.PHONY: all help check test test-example test-install install uninstall book pdf seen play test-play test-page verify figures text excerpts refs san valgrind stress bench mutants clean tools \
        $(TESTS:%=test-%) $(PROOFS:%=verify-%) $(PROOFS:%=refs-%) $(TESTS:%=valgrind-%)

## -- the library and the program -------------------------------------------

$B/src/%.o: src/%.c | tools
	@mkdir -p $(@D)
	$(CC) $(DIALECT) $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -MMD -MP -c $< -o $@

$B/libfvi.a: $(MODULES:%=$B/src/%.o) | $B/include/fvi
	rm -f $@
	ar rcs $@ $^

# As the headers will be found when they are installed: <fvi/fvi.h>.
$B/include/fvi:
	@mkdir -p $(@D)
	@ln -sfn "$$PWD/src" $@

$B/fvi: $(PROGRAM:%=$B/src/%.o) $B/libfvi.a
	$(CC) $(CFLAGS) $^ $(GSL_LIBS) -o $@

# The installed library: static, shared, headers, pkg-config, program, manual.
VERSION  := 0.1.0
PREFIX   ?= /usr/local
$(if $(word 2,[$(PREFIX)] [$(DESTDIR)]),$(if $(word 3,[$(PREFIX)] [$(DESTDIR)]),$(error no spaces, please, in PREFIX and DESTDIR)))
INTERNAL := double_double exact_inverse exact_pole memory_kinds damping lobatto_memory lobatto_weights band
PUBLIC   := $(filter-out $(INTERNAL:%=src/%.h) src/fvi_%.h,$(wildcard src/*.h))

$B/pic/%.o: src/%.c | tools
	@mkdir -p $(@D)
	$(CC) $(DIALECT) $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -fPIC -MMD -MP -c $< -o $@

$B/libfvi.so.$(VERSION): $(MODULES:%=$B/pic/%.o)
	$(CC) $(CFLAGS) -shared -Wl,-soname,libfvi.so.0 $^ $(GSL_LIBS) -o $@

install: $B/fvi $B/libfvi.a $B/libfvi.so.$(VERSION) ## library, headers, program, manual (PREFIX=/usr/local DESTDIR=)
	mkdir -p $(addprefix $(DESTDIR)$(PREFIX)/,bin lib/pkgconfig include/fvi share/man/man1)
	cp $B/fvi $(DESTDIR)$(PREFIX)/bin/
	cp $B/libfvi.a $B/libfvi.so.$(VERSION) $(DESTDIR)$(PREFIX)/lib/
	ln -sf libfvi.so.$(VERSION) $(DESTDIR)$(PREFIX)/lib/libfvi.so.0
	ln -sf libfvi.so.0 $(DESTDIR)$(PREFIX)/lib/libfvi.so
	@printf '%s\n' 'prefix=$(PREFIX)' 'Name: fvi' 'Version: $(VERSION)' 'Requires: gsl' \
	  'Description: fractional variational integrators' 'Libs: -L$${prefix}/lib -lfvi' \
	  'Cflags: -I$${prefix}/include -idirafter $${prefix}/include/fvi' > $(DESTDIR)$(PREFIX)/lib/pkgconfig/fvi.pc
	cp $(PUBLIC) $(DESTDIR)$(PREFIX)/include/fvi/
	cp src/fvi.1 $(DESTDIR)$(PREFIX)/share/man/man1/
	@test -n "$(DESTDIR)" || test "$$(id -u)" != 0 || ldconfig 2>/dev/null || true

uninstall: ## remove what install put there
	rm -f $(addprefix $(DESTDIR)$(PREFIX)/,bin/fvi lib/libfvi.a lib/libfvi.so lib/libfvi.so.0 \
	  lib/libfvi.so.$(VERSION) lib/pkgconfig/fvi.pc share/man/man1/fvi.1)
	rm -rf $(DESTDIR)$(PREFIX)/include/fvi

## -- tests -----------------------------------------------------------------

$B/tests/test_%: tests/test_%.c $B/libfvi.a | tools
	@mkdir -p $(@D)
	$(CC) $(DIALECT) $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) $(CHECK_CFLAGS) -Isrc -MMD -MP $< \
	  $(EXTRA_$*) $B/libfvi.a $(GSL_LIBS) $(CHECK_LIBS) -o $@

# One test takes another road, by libcerf's complex error functions.
EXTRA_exact_solution_erfc = $(CERF_LIBS)

# The parser is tested in the process, the program by running it.
EXTRA_fvi_options := $(patsubst %,$B/src/%.o,fvi_options fvi_values fvi_words)
$B/tests/test_fvi_options: $(EXTRA_fvi_options)
test-fvi_cli test-fvi_errors test-fvi_files test-fvi_past: $B/fvi

$(TESTS:%=test-%): test-%: $B/tests/test_%
	@FVI=$B/fvi $<

# What README.md tells a programmer: the example against the library as it stands,
# and against an installed copy, by pkg-config and from Python.
test-example: tests/example.c $B/libfvi.a
	$(CC) -std=c11 $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -I$B/include $^ $(GSL_LIBS) -o $B/example
	@$B/example > $B/example.out && test "$$(wc -l < $B/example.out)" -eq 20 && echo 'README example: 20 rows'

test-install: $B/libfvi.so.$(VERSION) $B/libfvi.a $B/fvi test-example
	@$(MAKE) -s B=$B PREFIX=$B/prefix DESTDIR= install
	@export PKG_CONFIG_PATH=$B/prefix/lib/pkgconfig LD_LIBRARY_PATH=$B/prefix/lib; \
	  $(CC) tests/example.c $$(pkg-config --cflags --libs fvi) -o $B/prefix/example && \
	  $B/prefix/example | cmp - $B/example.out && $(PYTHON) tests/example.py libfvi.so.0
	@$(MAKE) -s B=$B PREFIX=$B/prefix DESTDIR= uninstall
	@test -z "$$(find $B/prefix -type f ! -name example)" && echo 'installed, used from C and Python, uninstalled'

$B/tests/bench_%: tests/bench_%.c $B/libfvi.a | tools
	@mkdir -p $(@D)
	$(CC) $(DIALECT) $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -Isrc -MMD -MP $(filter %.c,$^) $B/libfvi.a $(GSL_LIBS) -o $@
$B/tests/bench_precision: tests/peer_product_trapezoid.c

$B/stress: $(wildcard tests/stress*.c) tests/stress.h $B/libfvi.a
	$(CC) $(DIALECT) $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -Isrc -Itests $(filter %.c %.a,$^) $(GSL_LIBS) -o $@

## -- proofs and exact values -----------------------------------------------

$B/verify/%_ref.h: verify/%.py verify/refgen.py | tools
	@mkdir -p $(@D)
	PYTHONDONTWRITEBYTECODE=1 $(PYTHON) $< > $@ && test -s $@

$B/verify/%.ok: $B/verify/%_ref.h tests/%_ref.h
	@cmp $^ && echo 'proved: verify/$*.py, and tests/$*_ref.h is what it gives' || { echo 'verify/$*.py no longer gives tests/$*_ref.h; to accept: make refs-$*'; exit 1; }
	@touch $@

$(PROOFS:%=verify-%): verify-%: $B/verify/%.ok
$(PROOFS:%=refs-%): refs-%: $B/verify/%_ref.h
	cp $< tests/$*_ref.h

## -- figures ---------------------------------------------------------------

$B/figures/%: figures/%.c $B/libfvi.a | tools
	@mkdir -p $(@D)
	$(CC) $(DIALECT) $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -Isrc -MMD -MP $< $B/libfvi.a $(GSL_LIBS) -o $@

# A scene is run again when its program changed, drawn again when its data did.
$B/figures/%.ran: $B/figures/%
	$< > $B/figures/$*.new
	@cmp -s $B/figures/$*.new $B/figures/$*.dat || cp $B/figures/$*.new $B/figures/$*.dat
	@rm $B/figures/$*.new; touch $@
$B/figures/%.dat: $B/figures/%.ran ;

$(SCENES:%=figures/%.svg): figures/%.svg: figures/%.gp figures/style.gp $B/figures/%.dat | tools
	LC_ALL=C.UTF-8 $(GNUPLOT) -e "dat='$B/figures/$*.dat'; out='$B/figures/$*.svg'; stem='$*'" $<
	@mv $B/figures/$*.svg $@

$(DIAGRAMS:%=figures/%.svg): figures/%.svg: figures/%.gp figures/style.gp | tools
	@mkdir -p $B/figures
	LC_ALL=C.UTF-8 $(GNUPLOT) -e "out='$B/figures/$*.svg'; stem='$*'" $<
	@mv $B/figures/$*.svg $@

figures/memory_bench.svg: $(TABLE_memory)
figures/step_search.svg: $(TABLE_precision)

## -- what has to be installed ----------------------------------------------

# Each goal probes for what it needs (some hundredths of a second) and brings
# what is missing, if it may: as root, or by sudo, from Debian's packages.
GOALS := $(or $(MAKECMDGOALS),all)
goal = $(if $(filter $1,$(GOALS)),$2)
NEEDS := $(sort cc gsl \
  $(call goal,check test test-% ch% san valgrind valgrind-% mutants seen,check cerf) \
  $(call goal,figures figures-% figures/% ch%,gnuplot) \
  $(call goal,check verify verify-% refs refs-% ch%,sympy) \
  $(call goal,text excerpts check book pdf mutants seen,python) $(call goal,book pdf,pandoc katex) $(call goal,pdf,chromium) \
  $(call goal,play,wasm) $(call goal,check test-play test-page,node) $(call goal,test-page,chromium) \
  $(call goal,check test-install,numpy) $(call goal,valgrind valgrind-%,valgrind))

tools:
	@have() { case $$1 in \
	  cc) command -v $(firstword $(CC));; \
	  gsl|check) pkg-config --exists $$1;; cerf) pkg-config --exists libcerf;; \
	  gnuplot) command -v $(GNUPLOT);; python) command -v $(PYTHON);; \
	  valgrind|pandoc|katex|chromium|node) command -v $$1;; \
	  wasm) command -v clang && command -v wasm-ld && test -e /usr/lib/wasm32-wasi/libc.a;; \
	  sympy) $(PYTHON) -c 'from importlib.util import find_spec; raise SystemExit(not find_spec("sympy"))';; \
	  numpy) $(PYTHON) -c 'from importlib.util import find_spec; raise SystemExit(not find_spec("numpy"))';; \
	  esac >/dev/null 2>&1; }; \
	packages() { case $$1 in cc) echo gcc libc6-dev;; gsl) echo pkg-config libgsl-dev;; \
	  check) echo pkg-config check;; cerf) echo libcerf-dev;; gnuplot) echo gnuplot-nox;; python) echo python3;; sympy|numpy) echo python3-$$1;; \
	  wasm) echo clang lld wasi-libc libclang-rt-dev-wasm32;; node) echo nodejs;; *) echo $$1;; esac; }; \
	lacks=; for t in $(NEEDS); do have $$t || lacks="$$lacks $$(packages $$t)"; done; \
	test -z "$$lacks" && exit 0; \
	command -v apt-get >/dev/null || { echo "missing; please install (Debian's names):$$lacks" >&2; exit 1; }; \
	sudo=; test "$$(id -u)" = 0 || sudo=sudo; \
	line="$$sudo apt-get install -y --no-install-recommends$$lacks"; \
	test -z "$$sudo" || command -v sudo >/dev/null || { echo "missing; as root, type: apt-get install -y$$lacks" >&2; exit 1; }; \
	echo "this needs$$lacks; running: $$line" >&2; \
	{ $$sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $$line >/dev/null; } || { echo "that failed; please type: $$line" >&2; exit 1; }

-include $(wildcard $B/src/*.d $B/pic/*.d $B/tests/*.d $B/figures/*.d)
