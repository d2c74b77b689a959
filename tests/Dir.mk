# One Check program per tests/test_*.c, each linked with every library, and shell scripts tests/test_*.sh.
# They find the programs in CRITVEL_BUILD; CRITVEL_SEED repeats the random tests of an earlier run.
TEST_LIBS   = $(BUILD)/libcompare.a $(BUILD)/libsemianalytic.a $(BUILD)/libdgreen.a $(BUILD)/libcommon.a
TESTS       = $(patsubst %.c,$(BUILD)/%,$(wildcard tests/test_*.c))
SCRIPT_LOGS = $(patsubst %,$(BUILD)/%.log,$(wildcard tests/test_*.sh))
TEST_LOGS   = $(TESTS:%=%.log)
CHECK_LIBS := $(shell pkg-config --libs check 2>/dev/null)
# Check's own limit is 4 s per test: too near for a loaded machine, sanitizers or valgrind.
TEST_ENV    = CRITVEL_BUILD=$(BUILD) CK_TIMEOUT_MULTIPLIER=20

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(TEST_LIBS)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(CHECK_LIBS) $(LIBS)

# Every test runs, also after a failure; the summary then fails.
RUN_TEST = start=$$(date +%s); $(TEST_ENV) $(1) $< >$@ 2>&1; echo "$$? $$(( $$(date +%s) - start ))" >$@.status; \
           echo "== $<"; cat $@

.PHONY: $(TEST_LOGS) $(SCRIPT_LOGS)
$(TEST_LOGS): %.log: % | programs
	@$(call RUN_TEST,)

$(SCRIPT_LOGS): $(BUILD)/%.log: % | programs
	@mkdir -p $(@D)
	@$(call RUN_TEST,sh)

.PHONY: run-tests
run-tests: $(TEST_LOGS) $(SCRIPT_LOGS)
	@failed=0; \
	echo; \
	for log in $^; do \
	    read status seconds <$$log.status; \
	    test $$status = 0 && word=passed || word="FAILED ($$status)"; \
	    test $$status = 0 || failed=$$((failed + 1)); \
	    printf '%-44s %-12s %4s s\n' "$$(basename $$log .log)" "$$word" $$seconds; \
	done; \
	cat $^ | awk -v programs=$(words $^) -v failed=$$failed ' \
	    /Checks: [0-9]+, Failures/ { match($$0, /Checks: [0-9]+/); n += substr($$0, RSTART + 8, RLENGTH - 8) } \
	    END { printf "%d test programs, %d failed; %d checks\n", programs, failed, n }'; \
	test $$failed = 0

.PHONY: check
check: deps
	@$(SUBMAKE) run-tests

.PHONY: check-sanitize
check-sanitize: deps
	@$(SUBMAKE) run-tests BUILD=$(BUILD)/sanitize \
	    CFLAGS="-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer"

VALGRIND_TESTS = $(filter $(BUILD)/tests/test_common_%,$(TESTS))

.PHONY: check-valgrind
check-valgrind: programs $(VALGRIND_TESTS)
	@command -v valgrind >/dev/null || { echo "valgrind is missing: install the package valgrind"; exit 1; }
	@set -e; for t in $(VALGRIND_TESTS); do \
	    CK_FORK=no $(TEST_ENV) valgrind -q --leak-check=full --error-exitcode=1 $$t; done

# Each tests/bench/*.c is a program.
BENCHES = $(patsubst %.c,$(BUILD)/%,$(wildcard tests/bench/*.c))

$(BUILD)/tests/bench/%: $(BUILD)/tests/bench/%.o $(TEST_LIBS)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)

.PHONY: bench
bench: $(BENCHES)
	@set -e; for b in $^; do echo "== $$b"; $$b; done
