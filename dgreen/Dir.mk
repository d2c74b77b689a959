DGREEN_OBJECTS = $(patsubst %.c,$(BUILD)/%.o,$(filter-out dgreen/main.c,$(wildcard dgreen/*.c)))
PROGRAMS += $(BUILD)/critvel-dgreen

$(BUILD)/libdgreen.a: $(DGREEN_OBJECTS)
	rm -f $@ && ar rcs $@ $^

$(BUILD)/critvel-dgreen: $(BUILD)/dgreen/main.o $(BUILD)/libdgreen.a $(BUILD)/libcommon.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)
