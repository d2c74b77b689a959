# critvel: build, run and check. Every folder has its own fragment Dir.mk.
CC       ?= gcc
CFLAGS   ?= -O2 -g
WARNINGS  = -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion
BUILD    ?= build
PKGS      = gsl lapacke inih jansson mpfr gmp

STD       = -std=c17 -D_POSIX_C_SOURCE=200809L -D_DEFAULT_SOURCE
CPPFLAGS += -I. $(shell pkg-config --cflags $(PKGS) 2>/dev/null)
LIBS      = $(shell pkg-config --libs $(PKGS) 2>/dev/null) -lmpc -lmpfr -lgmp -lpthread -lm

COMPILE   = $(CC) $(STD) $(WARNINGS) $(CFLAGS) $(CPPFLAGS) -MMD -MP

.PHONY: all
all: programs

include common/Dir.mk semianalytic/Dir.mk dgreen/Dir.mk compare/Dir.mk tests/Dir.mk tests/reference/Dir.mk

.PHONY: programs
programs: $(PROGRAMS)

$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	$(COMPILE) -c -o $@ $<

.PHONY: clean
clean:
	rm -rf $(BUILD)

-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
