SEMIANALYTIC_OBJECTS = $(patsubst %.c,$(BUILD)/%.o,$(filter-out semianalytic/main.c,$(wildcard semianalytic/*.c)))
PROGRAMS += $(BUILD)/critvel-semianalytic

# complex products without the rescue of infinities: every evaluation checks its result instead
$(SEMIANALYTIC_OBJECTS): CPPFLAGS += -fcx-limited-range

$(BUILD)/libsemianalytic.a: $(SEMIANALYTIC_OBJECTS)
	rm -f $@ && ar rcs $@ $^

$(BUILD)/critvel-semianalytic: $(BUILD)/semianalytic/main.o $(BUILD)/libsemianalytic.a $(BUILD)/libcommon.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)
