COMPARE_OBJECTS = $(patsubst %.c,$(BUILD)/%.o,$(filter-out compare/main.c,$(wildcard compare/*.c)))
PROGRAMS += $(BUILD)/critvel-compare

$(BUILD)/libcompare.a: $(COMPARE_OBJECTS)
	rm -f $@ && ar rcs $@ $^

# data/printed.ini travels inside the program: its bytes, as the elements of an array.
$(BUILD)/compare/printed_ini.inc: data/printed.ini
	@mkdir -p $(@D)
	od -An -v -tx1 $< | sed 's/ \(..\)/0x\1, /g' >$@

$(BUILD)/compare/printed_file.o: $(BUILD)/compare/printed_ini.inc
$(BUILD)/compare/printed_file.o: CPPFLAGS += -I$(BUILD)/compare

$(BUILD)/critvel-compare: $(BUILD)/compare/main.o $(BUILD)/libcompare.a $(BUILD)/libsemianalytic.a \
                          $(BUILD)/libdgreen.a $(BUILD)/libcommon.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)
