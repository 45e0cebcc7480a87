# Fractional variational integrators: a course that runs.
#
# `make` builds the program build/fvi; `make help` lists the targets, V=1 shows the
# commands. Every file that is made goes under $(B), except what is committed: figures,
# reference headers (refs), tables (bench, seen), the live page (play) and the quotes in
# the chapters (excerpts). One stem names a module, its chapter, test, proof and figure.
# What is more than a line of shell stands in src/make/.

B       := build
# Objects stood in $(B)/src before the sources had rooms; programs, where folders are now;
# those for the shared library in $(B)/pic.
ifneq ($(if $(filter clean,$(MAKECMDGOALS)),,$(wildcard $B/src/*.o $B/pic)),)
$(error $B/ is of an older version, whose files stood elsewhere; please type: rm -rf $B)
endif
PYTHON  ?= /usr/bin/python3
GNUPLOT ?= gnuplot
# For a debugger, make CFLAGS='-O0 -g'; -g for everybody takes a fifth of the time.
# The rooms of the program have no long loops, and compile in three quarters of the time.
LEVEL   := -O2
CFLAGS  ?= $(LEVEL)
$B/program/%.o $B/command_%.o $B/output/%.o $B/options/%.o $B/input/%.o: LEVEL := -O1
ifeq ($(origin CC),default)
CC := gcc
endif
export CC PYTHON GNUPLOT
export PYTHONDONTWRITEBYTECODE = 1

# No -ffast-math: the weights need their roundings. No contraction to fma where
# none is written: the last bits must not depend on the compiler.
DIALECT  := -std=c11 -fopenmp-simd -ffp-contract=off -fvisibility=hidden
# A loop with a choice becomes one of vectors if what is then not chosen may be computed, too.
$B/newton/newton_lanes.o $B/expression/tape.o: DIALECT += -fno-trapping-math
WARNINGS := -Wall -Wextra -Wconversion -Wshadow -pedantic

# What Debian's packages say stands in for a package that is yet to be installed.
GSL_CFLAGS   := $(shell pkg-config --cflags gsl 2>/dev/null)
GSL_LIBS     := $(shell pkg-config --libs gsl 2>/dev/null || echo -lgsl -lgslcblas -lm)
# Only programs that solve with sparse matrices open CHOLMOD and UMFPACK, and what they need.
CHOLMOD_LIBS := -Wl,--as-needed -lumfpack -lcholmod -Wl,--no-as-needed
LINKED        = $(CHOLMOD_LIBS) $(GSL_LIBS)
CHECK_CFLAGS := $(shell pkg-config --cflags check 2>/dev/null || echo -pthread)
CHECK_LIBS   := $(shell pkg-config --libs check 2>/dev/null || echo -lcheck_pic -pthread -lrt -lm -lsubunit)
CERF_LIBS    := $(shell pkg-config --libs libcerf 2>/dev/null || echo -lcerf)
COMPILE       = $(CC) $(DIALECT) $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -Isrc -MMD -MP

PROGRAM  := $(wildcard src/program/*.c src/command_*/*.c src/output/*.c src/options/*.c src/input/*.c)
LIBRARY  := $(filter-out $(PROGRAM) src/petsc/% src/course/%,$(wildcard src/*/*.c))
HEADERS  := $(wildcard src/fvi/*.h src/fvi/paper/*.h)
TESTS    := $(patsubst test_%.c,%,$(notdir $(wildcard tests/*/test_*.c)))
BENCHES  := $(patsubst tests/bench/bench_%.c,%,$(wildcard tests/bench/bench_*.c))
# What proofs import, and what proves nothing itself, stands in verify/shared/.
PROOFS   := $(patsubst %.py,%,$(notdir $(filter-out verify/shared/%,$(wildcard verify/*/*.py))))
SCENES   := $(patsubst figures/%.c,%,$(wildcard figures/*/*.c))
DIAGRAMS := $(filter-out $(SCENES),$(patsubst figures/%.gp,%,$(wildcard figures/*/*.gp)))
# The Course's chapters, and the pages of Further and of the Handbook.
CHAPTERS := $(patsubst %.md,%,$(notdir $(wildcard chapters/[0-9][0-9]-*.md)))
PAGES    := $(sort $(patsubst %.md,%,$(notdir $(wildcard chapters/further/[0-9][0-9]-*.md chapters/handbook/[0-9][0-9]-*.md))))
number    = $(firstword $(subst -, ,$1))
after     = $(patsubst $(call number,$1)-%,%,$1)
NUMBERS  := $(foreach c,$(CHAPTERS),ch$(call number,$c)) $(foreach p,$(PAGES),h$(call number,$p))
vpath test_%.c $(wildcard tests/*)

ifeq ($(MAKELEVEL),0)
MAKEFLAGS += --jobs=$(shell nproc 2>/dev/null || echo 2) --output-sync=line
endif
MAKEFLAGS += --no-builtin-rules
# Of tests that fail, all are shown.
ifneq ($(filter test check $(NUMBERS),$(MAKECMDGOALS)),)
MAKEFLAGS += --keep-going
endif
ifneq ($V,1)
.SILENT:
endif
.DELETE_ON_ERROR:
.SECONDARY:
.SUFFIXES:

all: $B/fvi $B/libfvi.a ## build the program build/fvi and the library (bare `make` does this)
	echo 'built $B/fvi; "make help" lists the targets'

## -- targets for people ----------------------------------------------------

help: ## print this list
	echo 'make TARGET, where TARGET is'
	sed -nE 's/^([a-zA-Z%-]+):[^#]*## (.*)/  \1|\2/p' Makefile | awk -F'|' '{ printf "%-14s %s\n", $$1, $$2 }'
	echo '  ch06         a chapter of the Course: its program, tests, proofs and figures (ch01 to ch12)'
	echo '  h09          a page of Further or the Handbook: its tests, proofs and figures (h00 to h30)'
	echo '  workshop-04  its code by your hand, tested and drawn ($(HELD))'
	echo '  exercise-04-7  an exercise; with ANSWER=527, is that right? (exercises: the table of all)'
	echo 'and, for one STEM, test-STEM; where it has a proof, verify-STEM; a chapter, figures-STEM; stems:'
	echo '  $(sort $(TESTS))' | fold -s -w 76 | sed '2,$$s/^/  /'

check: test test-install test-python test-play test-workshop verify text errata layers ## everything: tests, proofs, chapters equal to the code
	sh src/make/count.sh $B

test: $(TESTS:%=test-%) test-example test-fuzz ## run every test (needs gcc, GSL, Check, libcerf; no Python, no gnuplot)

verify: | needs ## prove with sympy; compare the reference values with tests/*/*_ref.h
	$(PYTHON) src/make/prove.py $B $(PROOFS)

figures: $(SCENES:%=figures/%.svg) $(DIAGRAMS:%=figures/%.svg) ## draw what changed of the figures
	echo 'all $(words $(SCENES) $(DIAGRAMS)) pictures are as their data: figures/*/*.svg'

layers: $B/libfvi.a $B/program.a $B/peers.a | needs ## see that the arrows between the rooms of src/ point down only
	$(PYTHON) src/make/layers.py $^

text: test-headers | needs ## compare code and numbers in the chapters with their sources; follow every link; count words; see that no NaN is lost, that the lines of mutants stand, that the holes of the workshop fit, and that need.sh knows what targets start
	$(PYTHON) chapters/tools/excerpts.py --check
	$(PYTHON) chapters/tools/quoted.py --check
	$(PYTHON) chapters/tools/links.py
	$(PYTHON) chapters/tools/formulas.py --check
	$(PYTHON) chapters/tools/evidence.py --check
	$(PYTHON) chapters/tools/words.py --check
	$(PYTHON) chapters/tools/colours.py
	$(PYTHON) src/make/top_level.py
	$(PYTHON) src/make/lost_nan.py
	$(PYTHON) tests/harness/mutants.py --lines
	$(WORKSHOP) $B text
	$(PYTHON) src/make/needs.py

test-headers: $B/libfvi.a | needs ## compile the examples in the comments of the public headers; run what can stand alone
	FLAGS='$(CFLAGS) $(GSL_CFLAGS)' LIBS='$(LINKED)' $(PYTHON) src/make/header_examples.py $B

excerpts: | needs ## rewrite code and numbers quoted in the chapters from their sources
	$(PYTHON) chapters/tools/excerpts.py
	$(PYTHON) chapters/tools/quoted.py

errata: $B/fvi | needs ## each row of H 16 with its counterexample; `make erratum-17` for one
	$(PYTHON) chapters/tools/errata.py $B/fvi > $B/errata.log || { tail -1 $B/errata.log; exit 1; }
	echo "errata: $$(grep -c '^  printed' $B/errata.log) rows of H 16 are as they say"

erratum-%: $B/fvi | needs
	$(PYTHON) chapters/tools/errata.py $B/fvi $*

book: text | needs ## the course as a folder of pages, build/book/index.html (pandoc, KaTeX)
	$(PYTHON) chapters/book/build.py $B/book

pdf: book ## the chapters on paper, build/book/fvi.pdf (Chromium, poppler, qpdf; a minute or two)
	node chapters/book/print.mjs $B/book
	node chapters/book/test_pdf.mjs $B/book

# axe-core knows WCAG's rules; where npm does not reach it, the rest is tested.
AXE := $B/npm/node_modules/axe-core/axe.min.js
test-book: book $B/fvi | needs ## the pages in a browser: widths, themes, search, figures that move, WCAG (Chromium, Firefox, npm; PAGE=04)
	test -e $(AXE) || npm install --silent --no-audit --no-fund --prefix $B/npm axe-core@4.14.1 2>/dev/null || true
	+node chapters/book/test_book.mjs $B/book $B/fvi $(AXE) $(PAGE)

slides: | needs ## slides of every chapter, its pictures and equations, build/slides (pandoc, KaTeX, node)
	$(PYTHON) src/make/slides.py $B/slides

# Each number that the prose quotes from a test: the least and the largest seen.
seen: $(patsubst %,$B/seen/%.tsv,$(or $(STEM),$(TESTS))) ## what the tests see, into tests/harness/seen.tsv (STEM=fvi for one)
	$(PYTHON) chapters/tools/quoted.py --gather $^

$B/seen/%.tsv: $B/tests/test_% | $B/fvi needs
	mkdir -p $(@D)
	: > $@; SEEN=$@ FVI=$B/fvi $<

play: | needs ## the live page, chapters/play/index.html (clang, lld, wasi-libc)
	$(PYTHON) chapters/play/build.py $B/play
	cmp -s $B/play/index.html chapters/play/index.html || cp $B/play/index.html chapters/play/index.html

test-play: $B/fvi | needs ## the live page's numbers against build/fvi (node)
	node chapters/play/test_play.mjs chapters/play/index.html $B/fvi

test-page: | needs ## the live page in a browser: a click, a drag, the keyboard (node, Chromium)
	node chapters/play/test_page.mjs chapters/play/index.html $B/play

refs: | needs ## accept new reference values into tests/
	$(PYTHON) src/make/prove.py $B --accept $(PROOFS)

san: ## the tests under AddressSanitizer and UBSan
	CPATH='$(CURDIR)/src' ASAN_OPTIONS=allocator_may_return_null=1 CK_TIMEOUT_MULTIPLIER=5 $(MAKE) B=$B/san CFLAGS='-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all' test

fuzz: ## random command lines and files under the sanitizers, minutes (SEED=1 CASE=7)
	$(MAKE) B=$B/san CFLAGS='-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all' $B/san/fuzz
	ASAN_OPTIONS=allocator_may_return_null=1 $B/san/fuzz $(or $(SEED),1) 100000 10000 100000 1 $(CASE)

test-fuzz: $B/fuzz
	$< 1 1500 300 3000 50

# Not under valgrind: the peers' truth is in long double, which has 64 bits there; and a test
# of errors limits the memory of the process, which is valgrind's, too.
UNDER := $(filter-out peers error,$(TESTS))
valgrind: $(UNDER:%=valgrind-%) ## the tests under valgrind, all but two (an hour; CFLAGS='-O2 -g' for lines)

$(UNDER:%=valgrind-%): valgrind-%: $B/tests/test_% $B/fvi | needs
	FVI=$B/fvi CK_FORK=no CK_TIMEOUT_MULTIPLIER=50 valgrind -q --suppressions=tests/harness/valgrind.supp \
	  --leak-check=full --error-exitcode=1 $<
	$(if $(filter fvi_sweep,$*),valgrind -q --trace-children=yes --leak-check=full --error-exitcode=1 $B/fvi sweep --vary x0=1:2:2 --steps 3 --jobs 2 -o $B/swept.tsv)

cppcheck: | needs ## a static analyser of C has nothing to say of library, program and figures (cppcheck, half a minute)
	mkdir -p $B/cppcheck
	cppcheck -q -j $(shell nproc 2>/dev/null || echo 2) --std=c11 --cppcheck-build-dir=$B/cppcheck --error-exitcode=1 -Isrc \
	  --enable=warning,performance,portability --suppressions-list=src/make/cppcheck.txt src figures
	echo 'cppcheck: nothing to say of src/ and figures/'

portability: | needs ## the same digits by other compilers, options, C libraries, in threads; the two commands on a bare Debian (half an hour; PARTS=clang)
	+$(PYTHON) src/make/portability.py $B $(PARTS)

stress: $B/stress $B/tests/test_fvi_memory $B/failing_malloc.so $B/fvi ## random runs against truths and identities; each allocation failing once; minutes (SEED=1 FAMILY=exact CASE=7)
	$(if $(FAMILY),,FVI=$B/fvi ALL=1 $B/tests/test_fvi_memory)
	$< $(or $(SEED),1) $(FAMILY) $(CASE)

bench: $(BENCHES:%=$B/tests/bench_%) ## time the memories and all methods, into figures/*/*.tsv, minutes; then `make figures excerpts`
	+$(foreach b,$(BENCHES),$B/tests/bench_$b > $B/$b.tsv && mv $B/$b.tsv $(TABLE_$b) &&) true

petsc: $B/fvi $B/libfvi.a | needs ## build/fvi_petsc, structures on many machines; 1 to 4 ranks against build/fvi; COST=1: what ten dampers cost (PETSc, MPI)
	LIBS='$(LINKED)' FLAGS='$(DIALECT) $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS)' COST='$(COST)' sh src/make/petsc.sh $B

mutants: $B/libfvi.a $B/peers.a $(if $(STEM),,test-workshop-accidents) | needs ## test the tests: each wrong line of tests/*/mutants.txt must be named (minutes)
	CFLAGS='$(DIALECT) -O1 $(GSL_CFLAGS) $(CHECK_CFLAGS)' LIBS='$(LINKED) $(CHECK_LIBS)' \
	  $(PYTHON) tests/harness/mutants.py $B $(STEM)

clean: ## remove everything that was made
	rm -rf $B

# `make ch06` is what belongs to the stem of chapters/06-*.md and to the stems beside it, and the
# pictures of the page;
# `make h09` what belongs to the stem of the page with this number.
BESIDE_02 := fractional_derivative
BESIDE_05 := discrete_principle
BESIDE_06 := legendre
BESIDE_10 := convergence
define stem
figures-$1: $(patsubst %,figures/%.svg,$(filter $1/%,$(SCENES) $(DIAGRAMS)))
.PHONY: figures-$1
endef
define chapter
$1: $B/fvi $3 $(foreach s,$2,$(filter test-$s test-$s_%,$(TESTS:%=test-%)) $(filter verify-$s verify-$s_%,$(PROOFS:%=verify-%)) figures-$s)
.PHONY: $1
endef
$(foreach s,$(sort $(foreach p,$(PAGES) $(CHAPTERS),$(call after,$p))),$(eval $(call stem,$s)))
shown = $(shell sed -nE 's|.*\]\(\.\./(figures/course/[a-z_]+\.svg)\).*|\1|p' $(wildcard chapters/$(call number,$1)-*.md))
$(foreach c,$(CHAPTERS),$(eval $(call chapter,ch$(call number,$c),$(call after,$c) $(BESIDE_$(call number,$c)),$(filter test-body_$(call number,$c)%,$(TESTS:%=test-%)) verify-course $(call shown,$c))))
$(foreach p,$(PAGES),$(eval $(call chapter,h$(call number,$p),$(call after,$p))))

.PHONY: all help slides check errata test test-example test-headers test-fuzz exercises test-workshop test-workshop-accidents workshop hint $(HELD:%=workshop-%) fuzz test-install python test-python install uninstall notebook book pdf test-book seen play test-play test-page verify figures layers text excerpts refs san valgrind cppcheck portability stress bench petsc mutants clean needs \
        $(TESTS:%=test-%) $(PROOFS:%=verify-%) $(PROOFS:%=refs-%) $(UNDER:%=valgrind-%)

## -- the library and the program -------------------------------------------

# Archive and shared library are made of the same objects, so each is position-independent.
$B/%.o: src/%.c | needs
	mkdir -p $(@D)
	$(COMPILE) -fPIC -c $< -o $@

$B/libfvi.a: $(LIBRARY:src/%.c=$B/%.o)
	rm -f $@
	ar rcs $@ $^

$B/program.a: $(PROGRAM:src/%.c=$B/%.o)
	rm -f $@
	ar rcs $@ $^

# The program has GSL within where that is there as archives, and opens CHOLMOD and UMFPACK, with the
# dozen libraries that they bring, when it first solves by them (src/program/fvi_solver_libraries.c):
# a short run takes less than half of its time.
archive  = $(if $(findstring /,$2),$2,$1)
GSL_WITHIN = $(if $(filter -L%,$(GSL_LIBS)),$(GSL_LIBS),$(foreach l,$(GSL_LIBS),$(if $(filter -lgsl%,$l),$(call archive,$l,$(shell $(CC) -print-file-name=$(l:-l%=lib%.a))),$l)))

$B/fvi: $(PROGRAM:src/%.c=$B/%.o) $B/libfvi.a
	$(CC) $(CFLAGS) $^ $(CHOLMOD_LIBS) $(GSL_WITHIN) -o $@

# The installed library: static, shared, headers, pkg-config, program, manual.
VERSION := $(shell sed -n 's/^\#define FVI_VERSION "\(.*\)"/\1/p' src/fvi/version.h)
SONAME  := libfvi.so.$(basename $(VERSION))
PREFIX  ?= /usr/local
$(if $(word 2,[$(PREFIX)] [$(DESTDIR)]),$(if $(word 3,[$(PREFIX)] [$(DESTDIR)]),$(error no spaces, please, in PREFIX and DESTDIR)))

$B/libfvi.so.$(VERSION): $(LIBRARY:src/%.c=$B/%.o)
	$(CC) $(CFLAGS) -shared -Wl,-soname,$(SONAME) $^ $(LINKED) -o $@

install: $B/fvi $B/libfvi.a $B/libfvi.so.$(VERSION) ## library, headers, program, manual, completions (PREFIX=/usr/local DESTDIR=)
	mkdir -p $(addprefix $(DESTDIR)$(PREFIX)/,bin lib/pkgconfig include/fvi/paper share/man/man1 \
	  share/bash-completion/completions share/zsh/site-functions)
	cp $B/fvi $(DESTDIR)$(PREFIX)/bin/
	cp $B/libfvi.a $B/libfvi.so.$(VERSION) $(DESTDIR)$(PREFIX)/lib/
	ln -sf libfvi.so.$(VERSION) $(DESTDIR)$(PREFIX)/lib/$(SONAME)
	ln -sf $(SONAME) $(DESTDIR)$(PREFIX)/lib/libfvi.so
	printf '%s\n' 'prefix=$(PREFIX)' 'Name: fvi' 'Version: $(VERSION)' 'Requires: gsl' \
	  'Description: fractional variational integrators' 'Libs: -L$${prefix}/lib -lfvi' 'Libs.private: -lumfpack -lcholmod' \
	  'Cflags: -I$${prefix}/include' > $(DESTDIR)$(PREFIX)/lib/pkgconfig/fvi.pc
	cp src/fvi/*.h $(DESTDIR)$(PREFIX)/include/fvi/
	cp src/fvi/paper/*.h $(DESTDIR)$(PREFIX)/include/fvi/paper/
	cp src/program/manual/fvi.1 $(DESTDIR)$(PREFIX)/share/man/man1/
	cp src/program/manual/fvi.bash $(DESTDIR)$(PREFIX)/share/bash-completion/completions/fvi
	cp src/program/manual/fvi.zsh $(DESTDIR)$(PREFIX)/share/zsh/site-functions/_fvi
	test -n "$(DESTDIR)" || test "$$(id -u)" != 0 || ldconfig 2>/dev/null || true

uninstall: ## remove what install put there
	rm -f $(addprefix $(DESTDIR)$(PREFIX)/,bin/fvi lib/libfvi.a lib/libfvi.so lib/$(SONAME) \
	  lib/libfvi.so.$(VERSION) lib/pkgconfig/fvi.pc share/man/man1/fvi.1 \
	  share/bash-completion/completions/fvi share/zsh/site-functions/_fvi)
	rm -rf $(DESTDIR)$(PREFIX)/include/fvi

# The Python package: laid out with headers and library in one folder, then made a wheel.
PACKAGE := $(wildcard src/python/*.* src/python/declarations/* src/python/fvi/*)

python: $B/python/wheel ## the Python package as a wheel, build/python/fvi-*.whl (cffi)
	ls $B/python/*.whl

$B/python/wheel: $(PACKAGE) $(HEADERS) $B/libfvi.a $B/fvi
	rm -rf $B/python
	mkdir -p $B/python/package/include
	cp -r src/python/. $B/python/package
	cp -r src/fvi $B/python/package/include
	cp $B/libfvi.a $B/python/package
	cp $B/fvi $B/python/package/fvi/program
	cd $B/python/package && $(PYTHON) setup.py -q bdist_wheel -d .. >../wheel.log 2>&1 || { cat ../wheel.log; exit 1; }
	touch $@

$B/python/site: $B/python/wheel
	rm -rf $@
	$(PYTHON) -m zipfile -e $B/python/fvi-*.whl $@

notebook: $B/python/site | needs ## the notebooks of the twelve weeks, executed, into build/notebooks (Jupyter; WEEK=03-discrete_mechanics for one)
	PYTHONPATH=$(abspath $<) $(PYTHON) src/make/notebooks.py $B/notebooks $(WEEK)

## -- tests -----------------------------------------------------------------

# A test is compiled for one run: -O0 takes a quarter of the time. The library is as
# CFLAGS say, and no digit depends on it.
$B/tests/test_%.o: test_%.c | needs
	mkdir -p $(@D)
	$(COMPILE) $(or $(LEVEL_$*),-O0) $(CHECK_CFLAGS) -Itests -c $< -o $@

# These have much arithmetic of their own: forms, polynomials of H 14, the series and meshes of 20,
# complex steps, turns around a zero.
LEVEL_stability_rounding := -O2
$(foreach t,stability_stages convergence_bound convergence_orders convergence_springs convergence_stages convergence_times \
  adjoint_chain lobatto_coordinates observer_start,$(eval LEVEL_$t := -O1))

# Gold takes half the time for these 130 links.
GOLD := $(if $(shell command -v ld.gold),-fuse-ld=gold)
$B/tests/test_%: $B/tests/test_%.o $B/libfvi.a
	$(CC) $(CFLAGS) $(GOLD) $< $(EXTRA_$*) $B/libfvi.a $(LINKED) $(CHECK_LIBS) -o $@

# One test takes another road, by libcerf's complex error functions.
EXTRA_exact_solution_erfc = $(CERF_LIBS)

# The peers of the benchmark, which stand in a library of their own.
EXTRA_peers := $B/peers.a
$B/tests/test_peers: $B/peers.a

# The parser is tested in the process, the program by running it.
EXTRA_fvi_options := $B/program.a
$B/tests/test_fvi_options: $B/program.a
$(patsubst test_%.c,test-%,$(notdir $(wildcard tests/program/test_*.c))): $B/fvi
test-fvi_memory: $B/failing_malloc.so

$B/failing_malloc.so: tests/harness/failing_malloc.c | needs
	$(CC) -std=c11 $(WARNINGS) -O1 -shared -fPIC $< -o $@

$(TESTS:%=test-%): test-%: $B/tests/test_%
	FVI=$B/fvi $< > $<.log 2>&1 || { cat $<.log; exit 1; }; tail -1 $<.log | sed 's/^[0-9]*%: //; s|^|$*: |'

# What README.md tells a programmer: the example against the library as it stands, and
# against an installed copy, by pkg-config; and what the headers promise against what
# the library exports. The program itself, linked with the shared library, finds all that it needs
# there, and says the same; it is delivered with the archive because it starts in two fifths of the time
# so (0.75 ms against 2.0 ms). test-python compares its numbers with the other two examples'.
test-example: tests/example/duffing.c $B/libfvi.a
	$(CC) -std=c11 $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -Isrc $^ $(LINKED) -o $B/example
	$B/example > $B/example.out && test "$$(wc -l < $B/example.out)" -eq 201 && echo 'README example: 201 rows'
	$(CC) -std=c11 $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -Isrc tests/example/observer.c $B/libfvi.a $(LINKED) -o $B/example_observer
	test "$$($B/example_observer | wc -l)" -eq 200 && echo 'example of an observer: 200 rows'
	$(CC) -std=c11 $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -Isrc tests/example/moving.c $B/libfvi.a $(LINKED) -o $B/example_moving
	$B/example_moving | cmp - $B/example.out && echo 'example of version 0.2, with new names: the same 201 rows'

test-install: $B/libfvi.so.$(VERSION) $B/libfvi.a $B/fvi test-example
	GSL_CFLAGS='$(GSL_CFLAGS)' $(PYTHON) src/make/interface.py $<
	$(MAKE) -s B=$B PREFIX=$B/prefix DESTDIR= install
	export PKG_CONFIG_PATH=$B/prefix/lib/pkgconfig LD_LIBRARY_PATH=$B/prefix/lib; \
	  $(CC) tests/example/duffing.c $$(pkg-config --cflags --libs fvi) -o $B/prefix/example && \
	  $B/prefix/example | cmp - $B/example.out && \
	  $(CC) $(CFLAGS) $(PROGRAM:src/%.c=$B/%.o) $B/prefix/lib/libfvi.so -lm -o $B/fvi_shared && \
	  for words in 'run --error 1e-9' 'exact --steps 9' 'gradient --steps 9' methods; do $B/fvi_shared $$words >$B/shared.out 2>&1 && $B/fvi $$words 2>&1 | cmp - $B/shared.out || exit 1; done
	$(MAKE) -s B=$B PREFIX=$B/prefix DESTDIR= uninstall
	test -z "$$(find $B/prefix -type f ! -name example)" && echo 'installed, used, uninstalled'

# The wheel, installed into an empty folder, from which alone it is taken.
test-python: test-example $B/fvi $B/python/site | needs ## the Python package (cffi, numpy, pytest)
	PYTHONPATH=$B/python/site FVI=$B/fvi EXAMPLE=$B/example.out $(PYTHON) -m pytest -q -p no:cacheprovider tests/python > $B/python/test.log || \
	  { cat $B/python/test.log; exit 1; }; tail -1 $B/python/test.log | sed 's/^/python: /'

$B/tests/bench_%: tests/bench/bench_%.c $(wildcard tests/bench/*.h) $B/libfvi.a | needs
	mkdir -p $(@D)
	$(COMPILE) '-DOPTIONS="$(CFLAGS)"' -Itests $(filter %.c,$^) $(filter-out $B/libfvi.a,$(filter %.a,$^)) $B/libfvi.a $(LINKED) -o $@
$B/tests/bench_memory: $B/peers.a
$B/tests/bench_precision: $(wildcard tests/bench/precision_*.c) $B/peers.a | $B/fvi
$B/tests/bench_batch: | $B/fvi
$B/tests/bench_variable_steps $B/tests/bench_prototype: tests/bench/variable.c
$B/tests/bench_prototype: tests/bench/prototype_random.c

# The peers, the problems and their solutions; they are compiled as the library is.
PEERS := $(wildcard tests/bench/peers/*.c) tests/bench/problems.c tests/bench/reference.c tests/bench/fft_blocks.c
$B/peers/%.o: tests/bench/peers/%.c | needs
	mkdir -p $(@D)
	$(COMPILE) -c $< -o $@
$B/peers/%.o: tests/bench/%.c | needs
	mkdir -p $(@D)
	$(COMPILE) -c $< -o $@
$B/peers.a: $(patsubst %.c,$B/peers/%.o,$(notdir $(PEERS)))
	rm -f $@
	ar rcs $@ $^
TABLE_memory    := figures/memory/memory_bench.tsv
TABLE_chain     := figures/memory/chain_bench.tsv
TABLE_precision := figures/step_search/step_search.tsv
TABLE_variable_steps := figures/variable_steps/variable_steps.tsv
TABLE_prototype := figures/variable_steps/prototype.tsv
TABLE_adjoint   := figures/adjoint/adjoint_bench.tsv
TABLE_blocks    := figures/blocks/blocks_bench.tsv
TABLE_batch     := figures/blocks/batch_bench.tsv
TABLE_structures := figures/structures/structures_bench.tsv
TABLE_structures_order := figures/structures/structures_order.tsv

$B/trajectories: tests/run/trajectories.c tests/run/many_runs.h $B/libfvi.a
	$(COMPILE) -Itests $(filter %.c %.a,$^) $(LINKED) -o $@

# The program in one process: its main under another name.
$B/fuzz: $(wildcard tests/random/fuzz/*.[ch]) $(filter-out $B/program/fvi_cli.o,$(PROGRAM:src/%.c=$B/%.o)) $B/libfvi.a
	$(COMPILE) -Dmain=fvi_main -c src/program/fvi_cli.c -o $B/fuzz_cli.o
	$(COMPILE) $(filter %.c,$^) $B/fuzz_cli.o $(filter %.o %.a,$^) $(LINKED) -o $@

$B/stress: $(wildcard tests/random/stress/*.[ch]) tests/variable_steps/adaptive_problems.h tests/variable_steps/pulse_problems.h $B/libfvi.a
	$(CC) $(DIALECT) $(WARNINGS) $(CFLAGS) $(GSL_CFLAGS) -Isrc -Itests $(filter %.c %.a,$^) $(LINKED) -o $@

## -- the workshop ----------------------------------------------------------

# What students write is built with sanitizers, and so is the library that they call:
# else it would overrun their arrays unseen. workshop/ is theirs: no rule writes there
# what exists, and none removes it.
SANITIZE := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all
WORKSHOP  = FLAGS='$(DIALECT) $(STUDENT) $(GSL_CFLAGS) $(CHECK_CFLAGS)' LIBS='$(GOLD) $(LINKED) $(CHECK_LIBS)' $(PYTHON) src/make/workshop.py
HELD     := $(sort $(shell sed -nE 's/^shows +([0-9]+)\..*/0\1/; s/^(chapter +)?0*([0-9]{2})$$/\2/p' tests/workshop/holes.txt))
workshop hint $(HELD:%=workshop-%) test-workshop-accidents: STUDENT := $(SANITIZE)

# From stage 6 on, workshop/body.c is compared with the library, too.
workshop: $(if $(wildcard workshop/body_05.c),$B/libfvi.a) | needs ## your own integrator, from an empty file, stage by stage (chapters/workshop)
	$(WORKSHOP) $B start

hint: | needs ## a hint for the stage of the workshop at hand; after three of them the answer (HINT=2 for one)
	$(WORKSHOP) $B hint $(HINT)

$(HELD:%=workshop-%): workshop-%: | needs
	test -e $B/san/libfvi.a || echo 'building the library with sanitizers, once: a minute or two'
	$(MAKE) -s B=$B/san CFLAGS='$(SANITIZE)' $B/san/libfvi.a $$($(WORKSHOP) $B tests $* | sed 's|[^ ]*|$B/san/tests/&.o|g')
	$(WORKSHOP) $B/san chapter $*

# What the exercises by experiment are judged by: the program, and the data of figures.
MEASURED := $B/fvi $B/libfvi.a $(patsubst %,$B/figures/%.dat,springpot/springpot_creep damping_laws/damping_laws_motion)

exercise-%: $(MEASURED) | needs
	$(WORKSHOP) $B exercise $* '$(ANSWER)'

exercises: | needs
	$(WORKSHOP) $B exercises

# The tests that name the holes: objects of this very run of make, which may be at work on others.
NAMED := $(shell grep -lE "START_TEST\(($$(sed -nE 's/^named +//p' tests/workshop/holes.txt | paste -sd '|'))\)" tests/*/test_*.c)

test-workshop: $(MEASURED) $(patsubst %.c,$B/tests/%.o,$(notdir $(NAMED))) | needs
	$(WORKSHOP) $B check

test-workshop-accidents: | needs
	$(WORKSHOP) $B/accidents accidents

## -- proofs and exact values -----------------------------------------------

$(PROOFS:%=verify-%): verify-%: | needs
	$(PYTHON) src/make/prove.py $B $*

$(PROOFS:%=refs-%): refs-%: | needs
	$(PYTHON) src/make/prove.py $B --accept $*

## -- figures ---------------------------------------------------------------

$B/figures/%: figures/%.c $B/libfvi.a | needs
	mkdir -p $(@D)
	$(COMPILE) $< $B/libfvi.a $(LINKED) -o $@

# A scene is run again when its program changed, drawn again when its data did.
$B/figures/%.ran: $B/figures/%
	$< > $B/figures/$*.new
	cmp -s $B/figures/$*.new $B/figures/$*.dat || cp $B/figures/$*.new $B/figures/$*.dat
	rm $B/figures/$*.new; touch $@
$B/figures/%.dat: $B/figures/%.ran ;

define draw
mkdir -p $(@D:%=$B/%)
LC_ALL=C.UTF-8 $(GNUPLOT) -e "dat='$B/figures/$*.dat'; out='$B/figures/$*.svg'; stem='$(notdir $*)'" $<
sed 's/font-family="DejaVu Sans"/font-family="DejaVu Sans, Verdana, Helvetica, Arial, sans-serif"/g' $B/figures/$*.svg > $@
echo 'drew $@'
endef

$(SCENES:%=figures/%.svg): figures/%.svg: figures/%.gp figures/style.gp $B/figures/%.dat | needs
	$(draw)

$(DIAGRAMS:%=figures/%.svg): figures/%.svg: figures/%.gp figures/style.gp | needs
	$(draw)

figures/memory/memory_bench.svg: $(TABLE_memory)
figures/step_search/step_search.svg: $(TABLE_precision)
figures/blocks/blocks_bench.svg: $(TABLE_blocks)
figures/structures/structures_bench.svg: $(TABLE_structures)
figures/structures/structures_order.svg: $(TABLE_structures_order)

## -- what has to be installed ----------------------------------------------

# Each goal probes for what it needs (some hundredths of a second). The bare `make`
# only says what is missing; the others bring it if they may (src/make/need.sh).
GOALS := $(or $(MAKECMDGOALS),all)
goal = $(if $(filter $1,$(GOALS)),$2)
NEEDS := $(sort cc gsl cholmod \
  $(call goal,check test test-% $(NUMBERS) workshop hint workshop-% san valgrind valgrind-% portability mutants seen,check cerf) \
  $(call goal,figures figures-% figures/% $(NUMBERS),gnuplot) \
  $(call goal,check verify verify-% refs refs-% $(NUMBERS),python sympy) \
  $(call goal,text errata erratum-% excerpts check workshop hint workshop-% exercise-% exercises test-workshop test-workshop-accidents layers portability mutants seen python notebook test-python test-install test-headers,python) \
  $(call goal,book pdf test-book slides petsc,python) \
  $(call goal,book pdf test-book slides,pandoc katex node) \
  $(call goal,book pdf test-book slides,wasm) \
  $(call goal,pdf test-book,chromium) $(call goal,pdf,pdfinfo qpdf) \
  $(call goal,play,wasm) $(call goal,check test-play test-page,node) $(call goal,test-page,chromium) \
  $(call goal,check python notebook test-python,cffi setuptools wheel numpy Python.h) $(call goal,notebook,nbclient nbformat ipykernel matplotlib) $(call goal,check test-python,pytest) $(call goal,cppcheck,cppcheck) $(call goal,valgrind valgrind-%,valgrind))

needs:
	sh src/make/need.sh $(if $(filter all $B/fvi install,$(GOALS)),,--bring) $(NEEDS)

-include $(wildcard $B/*/*.d $B/figures/*/*.d)
