COMPARE_OBJECTS = $(patsubst %.c,$(BUILD)/%.o,$(filter-out compare/main.c,$(wildcard compare/*.c)))
PROGRAMS += $(BUILD)/critvel-compare

$(BUILD)/libcompare.a: $(COMPARE_OBJECTS)
	rm -f $@ && ar rcs $@ $^

$(BUILD)/critvel-compare: $(BUILD)/compare/main.o $(BUILD)/libcompare.a $(BUILD)/libsemianalytic.a \
                          $(BUILD)/libdgreen.a $(BUILD)/libcommon.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)
