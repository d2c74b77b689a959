# critvel: build, run and check; "make help" lists the targets. Every folder has its own fragment Dir.mk.
ifeq ($(origin CC),default)
CC        = gcc
endif
CFLAGS   ?= -O2 -g
WERROR   ?=
WARNINGS  = -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion $(WERROR)
BUILD    ?= build
PREFIX   ?= /usr/local
JOBS     ?= $(shell nproc 2>/dev/null || echo 1)

PKGS      = gsl lapacke inih jansson mpfr gmp
DEBS      = gcc libc6-dev make pkg-config libgsl-dev liblapacke-dev libmpfr-dev libmpc-dev libgmp-dev \
            libinih-dev libjansson-dev check gnuplot-nox

# no-math-errno: sqrt is an instruction, and loops with it can use vectors
STD       = -std=c17 -fno-math-errno -D_POSIX_C_SOURCE=200809L -D_DEFAULT_SOURCE
HAVE     := $(shell pkg-config --exists $(PKGS) 2>/dev/null && echo yes)
PKG_CPP  := $(shell pkg-config --cflags $(PKGS) 2>/dev/null)
PKG_LIBS := $(shell pkg-config --libs $(PKGS) 2>/dev/null)
LIBS      = $(PKG_LIBS) -lmpc -lmpfr -lgmp -lpthread -lm
COMPILE   = $(CC) $(STD) $(WARNINGS) $(CFLAGS) -I. $(PKG_CPP) $(CPPFLAGS) -MMD -MP

# A make of our own, so that what "deps" installs is seen; in parallel unless the caller said how.
SUBMAKE   = $(MAKE) --no-print-directory $(if $(filter -j%,$(MAKEFLAGS)),,-j$(JOBS))

.PHONY: all
all: programs

include common/Dir.mk semianalytic/Dir.mk dgreen/Dir.mk compare/Dir.mk tests/Dir.mk tests/reference/Dir.mk

.PHONY: programs
programs: $(PROGRAMS)

.PHONY: have-libraries
have-libraries:
	@test -n "$(HAVE)" || { echo "Libraries are missing: run 'make deps', or install $(PKGS) and MPC"; exit 1; }

$(BUILD)/%.o: %.c | have-libraries
	@mkdir -p $(@D)
	$(COMPILE) -c -o $@ $<

# Installs the Debian packages that are missing; touches nothing when all are there.
.PHONY: deps
deps:
	@command -v dpkg-query >/dev/null || { echo "Not Debian: make sure there are $(PKGS), MPC, Check and gnuplot"; exit 0; }; \
	missing=; \
	for p in $(DEBS); do \
	    dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; \
	done; \
	test -n "$$missing" || exit 0; \
	sudo=; \
	if test "$$(id -u)" != 0; then \
	    command -v sudo >/dev/null || { echo "Install as root:$$missing"; exit 1; }; \
	    sudo=sudo; \
	fi; \
	echo "Installing$$missing"; \
	$$sudo apt-get update -q && \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $$missing

.PHONY: run
run: deps
	@$(SUBMAKE) programs
	$(BUILD)/critvel-compare data/paper.ini

# The figures of the paper, into $(BUILD)/figures
.PHONY: figures
figures: deps
	@$(SUBMAKE) programs
	$(BUILD)/critvel-compare figures data/paper.ini -o $(BUILD)/figures

.PHONY: install
install: programs
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/critvel
	install $(PROGRAMS) $(DESTDIR)$(PREFIX)/bin
	install -m 644 data/paper.ini data/track.ini $(DESTDIR)$(PREFIX)/share/critvel

.PHONY: uninstall
uninstall:
	rm -f $(PROGRAMS:$(BUILD)/%=$(DESTDIR)$(PREFIX)/bin/%)
	rm -rf $(DESTDIR)$(PREFIX)/share/critvel

.PHONY: clean
clean:
	rm -rf $(BUILD)

.PHONY: help
help:
	@echo "make                 the programs, in $(BUILD)/"
	@echo "make deps            install the Debian packages that are missing"
	@echo "make run             deps, programs, and the comparison of the paper's cases"
	@echo "make figures         deps, programs, and the figures of the paper in $(BUILD)/figures"
	@echo "make check           deps, programs, and all tests"
	@echo "make check-sanitize  the same with AddressSanitizer and UBSan, in $(BUILD)/sanitize"
	@echo "make check-valgrind  the tests of common/ under valgrind"
	@echo "make bench           the benchmarks of tests/bench"
	@echo "make reference       reference values by ball arithmetic (needs FLINT and Arb; hours)"
	@echo "make install         to DESTDIR PREFIX = $(DESTDIR)$(PREFIX); make uninstall takes it back"
	@echo "make clean           remove $(BUILD)/"
	@echo "Variables: BUILD CC CFLAGS CPPFLAGS LDFLAGS WERROR=-Werror JOBS PREFIX DESTDIR"

.SECONDARY: # keep the objects of tests

-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
