COMMON_OBJECTS = $(patsubst %.c,$(BUILD)/%.o,$(wildcard common/*.c))

$(BUILD)/libcommon.a: $(COMMON_OBJECTS)
	rm -f $@ && ar rcs $@ $^
