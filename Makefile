# spar. `make help` lists the targets; B=DIR builds elsewhere, V=1 shows the commands.

B       = build
CONFIG  = build/config.mk
VENV    = build/venv
PREFIX  = /usr/local

# MODE is what differs between the release build and those of check-build and coverage.
MODE    = -O3 -fno-backtrace
# -Wmaybe-uninitialized cries wolf over descriptors of allocatables at -O3.
WARN    = -Wall -Wextra -Wimplicit-interface -Wconversion -fimplicit-none -Wno-maybe-uninitialized
WERROR ?= $(if $(filter true,$(CI)),1,0)
CHECK   = -O1 -fcheck=all,no-array-temps -fsanitize=address,undefined \
          -fno-sanitize-recover=undefined -fno-omit-frame-pointer -ffpe-trap=invalid,zero,overflow

all: $(B)/spar  ## build the program (default)

.PHONY: all programs setup venv demo test check-build coverage lint bench docs validation \
        check-validation check-vtk install clean help FORCE
.DELETE_ON_ERROR:
.SUFFIXES:
Q = $(if $(V),,@)

ifeq ($(MAKELEVEL) $(filter -j%,$(MAKEFLAGS)),0 )
MAKEFLAGS += -j$(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
endif

# --- sources: one module a file, named like it; two of the files are programs -------------------

SRC      := $(wildcard src/*/*.f90)
TESTS    := $(wildcard tests/unit/*.f90)
LIB_OBJ  := $(patsubst %.f90,$(B)/%.o,$(notdir $(filter-out src/app/main.f90,$(SRC))))
TEST_OBJ := $(patsubst %.f90,$(B)/%.o,$(notdir $(TESTS)))
MODULES  := $(patsubst %.f90,%,$(notdir $(filter-out %/main.f90 %/run_tests.f90,$(SRC) $(TESTS))))
VPATH     = $(sort $(dir $(SRC) $(TESTS)))

# --- what tools/setup proved, then flags and dependencies; not for help and clean ---------------

ifneq ($(filter-out help clean,$(or $(MAKECMDGOALS),all)),)
include $(CONFIG)
endif

USER_FC := $(filter-out default undefined,$(origin FC))
ifeq ($(USER_FC),)
FC = $(CONFIG_FC)
endif
COMPILER := $(if $(FC),$(FC) $(shell $(FC) -dumpfullversion 2>/dev/null))

$(CONFIG): tools/setup $(wildcard tools/probe/*.f90)
	@$(if $(USER_FC),FC='$(FC)') tools/setup $@

ifeq ($(MAKE_RESTARTS),)
ifneq ($(COMPILER),$(CONFIG_COMPILER))
$(CONFIG): FORCE
endif
endif

STATIC ?= $(if $(CONFIG_STATIC_LIBS),1,0)
LIBS    = $(if $(filter 1,$(STATIC)),$(or $(CONFIG_STATIC_LIBS),$(no_static)),$(CONFIG_LIBS))
FFLAGS  = -std=f2008 $(MODE) -g $(WARN) $(if $(filter 1,$(WERROR)),-Werror) $(FFLAGS_EXTRA)
no_static = $(error STATIC=1: tools/setup could not link the libraries statically)

ifdef CONFIG_FC
# $(call remember,NAME,TEXT): a file that changes when its text does and not otherwise.
remember = $(shell mkdir -p $(B); printf '%s\n' '$(2)' | cmp -s - $(B)/$(1) || \
                   printf '%s\n' '$(2)' >$(B)/$(1))
$(call remember,flags,$(COMPILER) $(FFLAGS) $(CONFIG_FLAGS))
$(call remember,link,$(LIBS))
$(call remember,sources,$(SRC) $(TESTS))
include $(B)/depend.mk
endif

# --- building -----------------------------------------------------------------------------------

programs: $(B)/spar $(B)/run_tests

# A static HDF5 brings a warning about dlopen, for a plugin loader that is not used: left out.
define link
@echo "  LINK $@"
$(Q)$(FC) $(MODE) -g -o $@ $(filter %.o %.a,$^) $(LIBS) 2>$@.log || { cat $@.log >&2; exit 1; }
@grep -v -e H5PL__open -e "'dlopen'" $@.log >&2 || true
endef

$(B)/spar: $(B)/main.o $(B)/libspar.a $(B)/link
	$(link)

$(B)/run_tests: $(TEST_OBJ) $(B)/libspar.a $(B)/link
	$(link)

$(B)/libspar.a: $(LIB_OBJ) $(B)/sources
	$(Q)rm -f $@ && ar rcs $@ $(LIB_OBJ)

$(B)/%.o: %.f90 $(B)/flags
	@echo "  FC   $<"
	$(Q)$(FC) $(FFLAGS) $(CONFIG_FLAGS) -J $(B) -c -o $@ $<

# Users wait for the .mod file, which gfortran leaves alone while the interface stays the same: a
# change inside a procedure recompiles one file.
$(MODULES:%=$(B)/%.mod): $(B)/%.mod: $(B)/%.o ;

$(B)/depend.mk: $(SRC) $(TESTS) $(B)/sources
	$(Q)rm -f $(filter-out $(MODULES:%=$(B)/%.mod) $(LIB_OBJ) $(TEST_OBJ) $(B)/main.o, \
	  $(wildcard $(B)/*.mod $(B)/*.o))
	$(Q)awk -v b=$(B) -v modules='$(MODULES)' ' \
	  BEGIN { n = split(modules, word, " "); for (i = 1; i <= n; i++) ours[word[i]] = 1 } \
	  FNR == 1 { file = FILENAME; sub(".*/", "", file); sub("[.]f90$$", "", file) } \
	  tolower($$0) ~ /^[ \t]*use[ \t,:]/ { \
	    line = tolower($$0); sub("!.*", "", line); sub("^[ \t]*use", "", line); \
	    if (line ~ /^[ \t]*,[ \t]*intrinsic/) next; \
	    sub("^[ \t]*,[ \t]*non_intrinsic", "", line); gsub("^[ \t:]+", "", line); \
	    sub("[^a-z0-9_].*", "", line); \
	    if (line in ours && !((file, line) in seen)) { \
	      seen[file, line] = 1; print b "/" file ".o: " b "/" line ".mod" } }' \
	  $(filter %.f90,$^) >$@

# --- using and checking -------------------------------------------------------------------------

demo: $(B)/spar  ## solve decks/channel.deck, result in build/channel.h5
	@echo "$(B)/spar run decks/channel.deck -o $(B)/channel.h5"
	@$(B)/spar run decks/channel.deck -o $(B)/channel.h5

test: programs  ## run all tests, or with ONLY=word those whose name contains the word
	@SPAR_PROGRAM=$(B)/spar $(B)/run_tests $(ONLY)

check-build:  ## the same tests with run-time checks, sanitizers and trapped exceptions
	@$(MAKE) --no-print-directory B=$(B)-check STATIC=0 WERROR=0 MODE='$(CHECK)' test

coverage:  ## the same tests, then the share of lines executed in each source file
	@rm -f $(B)-coverage/*.gcda
	@$(MAKE) --no-print-directory B=$(B)-coverage STATIC=0 WERROR=0 MODE='-O0 --coverage' test
	@gcov -n $(patsubst $(B)/%.o,$(B)-coverage/%.gcno,$(LIB_OBJ) $(B)/main.o) 2>/dev/null | \
	awk -F "['%:]" ' \
	  /^File/ { file = $$2 } \
	  /^Lines executed/ && file ~ /^src\// { \
	    split($$3, part, " "); total += part[2]; hit += $$2*part[2]/100; \
	    printf "%6.1f %% of %4d lines  %s\n", $$2, part[2], file | "sort -k 6"; file = "" } \
	  END { close("sort -k 6"); \
	    printf "%6.1f %% of %4d lines  in all\n", 100*hit/(total ? total : 1), total }'

# Warnings of every file have to show: without WERROR=1 the strict build has a folder of its own.
lint: $(VENV)/ready  ## strict build, layers, fortitude, lengths, blanks
	@$(MAKE) --no-print-directory B=$(B)$(if $(filter 1,$(WERROR)),,-lint) WERROR=1 programs
	@tools/lint $(VENV)

docs: $(B)/spar  ## write docs/manual.md from the keyword table
	@tools/manual $(B)/spar >$(B)/manual.md && cp $(B)/manual.md docs/manual.md

validation: $(B)/spar $(VENV)/plots  ## run the validation problems, write docs/validation.md
	@SPAR_PROGRAM=$(B)/spar $(VENV)/bin/python3 tools/validation.py

check-validation: $(B)/spar $(VENV)/ready  ## the same runs against the numbers of that page
	@SPAR_PROGRAM=$(B)/spar $(VENV)/bin/python3 tools/validation.py --check

check-vtk: $(B)/spar $(VENV)/vtk  ## read drawings of results with VTK, check every point
	@SPAR_PROGRAM=$(B)/spar $(VENV)/bin/python3 tools/check_vtk.py

bench: $(B)/spar $(B)/bench_tangent $(B)/bench_recorder  ## measure speed and memory (tools/bench)
	@SPAR_PROGRAM=$(B)/spar BENCH_TANGENT=$(B)/bench_tangent \
	BENCH_RECORDER=$(B)/bench_recorder tools/bench

$(B)/bench_%: tests/bench/bench_%.f90 $(B)/libspar.a $(B)/link
	$(Q)$(FC) $(FFLAGS) $(CONFIG_FLAGS) -I $(B) -o $@ $< $(B)/libspar.a $(LIBS) 2>/dev/null

install: DIR = $(DESTDIR)$(PREFIX)
install: $(B)/spar  ## install under PREFIX=/usr/local, or under DESTDIR before that
	install -d $(DIR)/bin $(DIR)/share/doc/spar/docs/images $(DIR)/share/man/man1
	install -m 755 $(B)/spar $(DIR)/bin/spar
	install -m 644 LICENSE README.md CHANGELOG.md $(DIR)/share/doc/spar
	install -m 644 $(filter-out docs/manual_%,$(wildcard docs/*.md)) $(DIR)/share/doc/spar/docs
	install -m 644 $(wildcard docs/images/*) $(DIR)/share/doc/spar/docs/images
	$(if $(wildcard docs/spar.1),install -m 644 docs/spar.1 $(DIR)/share/man/man1/spar.1)
	$(if $(wildcard decks/*),cp -R decks $(DIR)/share/doc/spar/)

setup: $(CONFIG)  ## find or install compiler and libraries
	@cat $(CONFIG)

venv: $(VENV)/ready $(VENV)/vtk $(VENV)/plots  ## Python environment of the developers' tools

$(VENV)/ready: tools/setup
	@tools/setup venv $(VENV)

$(VENV)/vtk $(VENV)/plots: $(VENV)/ready
	@tools/setup $(@F) $(VENV)

clean:  ## remove everything built
	rm -rf $(B) $(B)-check $(B)-coverage $(B)-lint

help:  ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-12s %s\n", $$1, $$2 }' Makefile

FORCE:
