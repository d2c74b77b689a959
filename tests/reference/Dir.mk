# The referee: reference values in data/reference_*.json from rigorous ball arithmetic (FLINT, Arb). Slow, and
# needs libflint-dev and libflint-arb-dev; not part of "make" or "make check".
REFERENCE_LIBS     = -lflint-arb -lflint -lmpfr -lgmp -ljansson -lm
REFERENCE_MAINS    = points transitions
REFERENCE_SOURCES  = $(filter-out $(REFERENCE_MAINS:%=tests/reference/%.c),$(wildcard tests/reference/*.c))
REFERENCE_OBJECTS  = $(REFERENCE_SOURCES:%.c=$(BUILD)/%.o)
REFERENCE_PROGRAMS = $(REFERENCE_MAINS:%=$(BUILD)/reference-%)

$(BUILD)/reference-%: $(BUILD)/tests/reference/%.o $(REFERENCE_OBJECTS)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(REFERENCE_LIBS)

.PHONY: reference
reference: $(REFERENCE_PROGRAMS)
	$(BUILD)/reference-points data/reference_zeta.json
	nice $(BUILD)/reference-transitions tests/reference/transitions.jobs data/reference_transitions.json
