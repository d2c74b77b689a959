# One Check program per tests/test_*.c, each linked with every library; "make check" runs them all.
TEST_LIBS = $(BUILD)/libcompare.a $(BUILD)/libsemianalytic.a $(BUILD)/libdgreen.a $(BUILD)/libcommon.a
TESTS     = $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/test_*.c))
CHECK_LIBS = $(shell pkg-config --libs check 2>/dev/null)

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(TEST_LIBS)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(CHECK_LIBS) $(LIBS)

.PHONY: check
check: programs $(TESTS)
	@set -e; for t in $(TESTS); do $$t; done
