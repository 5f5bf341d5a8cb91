#include "files.h"

#include "checkpoint.h"
#include "crc32c.h"

static const double reals[] = {1.0 / 3, -0.0, 5e-324, 1e308};
static const pia_index counts[] = {0, -1, INT64_MAX};

static void write_checkpoint(pia_context *context, const char *name)
{
    pia_output *output;
    pia_checkpoint_writer writer;
    assert_ok(context, pia_output_open(context, path_of(name), &output));
    pia_checkpoint_begin(&writer, output);
    pia_checkpoint_put(&writer, "reals", PIA_SECTION_DOUBLE, reals, 4);
    pia_checkpoint_put(&writer, "counts", PIA_SECTION_INDEX, counts, 3);
    pia_checkpoint_put(&writer, "method", PIA_SECTION_TEXT, "lspia", 5);
    pia_checkpoint_put(&writer, "empty", PIA_SECTION_DOUBLE, NULL, 0);
    pia_checkpoint_end(&writer);
    assert_ok(context, pia_output_commit(output));
}

static void sections_come_back_with_the_same_bits(void **state)
{
    pia_checkpoint *checkpoint = NULL;
    void *data;
    pia_index count;
    double copy[4];
    write_checkpoint(*state, "state");
    assert_ok(*state, pia_checkpoint_open(*state, path_of("state"), &checkpoint));
    assert_ok(*state, pia_checkpoint_get(checkpoint, "reals", PIA_SECTION_DOUBLE, &data, &count));
    assert_int_equal(count, 4);
    assert_memory_equal(data, reals, sizeof reals);
    pia_give(*state, data);
    assert_ok(*state, pia_checkpoint_get(checkpoint, "counts", PIA_SECTION_INDEX, &data, &count));
    assert_memory_equal(data, counts, sizeof counts);
    pia_give(*state, data);
    assert_ok(*state, pia_checkpoint_get(checkpoint, "method", PIA_SECTION_TEXT, &data, &count));
    assert_int_equal(count, 5);
    assert_string_equal(data, "lspia");
    pia_give(*state, data);
    assert_ok(*state, pia_checkpoint_copy(checkpoint, "reals", PIA_SECTION_DOUBLE, copy, 4));
    assert_memory_equal(copy, reals, sizeof reals);
    assert_true(pia_checkpoint_has(checkpoint, "empty", PIA_SECTION_DOUBLE, &count));
    assert_int_equal(count, 0);
    assert_false(pia_checkpoint_has(checkpoint, "empty", PIA_SECTION_INDEX, NULL));
    assert_status(*state, pia_checkpoint_get(checkpoint, "missing", PIA_SECTION_DOUBLE, &data, &count), PIA_E_FORMAT);
    assert_status(*state, pia_checkpoint_copy(checkpoint, "reals", PIA_SECTION_DOUBLE, copy, 3), PIA_E_FORMAT);
    pia_checkpoint_close(checkpoint);
}

static void large_sections_come_back(void **state)
{
    enum { COUNT = 100003 };
    double *values = malloc(COUNT * sizeof *values), *copy = malloc(COUNT * sizeof *copy);
    for (int i = 0; i < COUNT; i++) values[i] = sin(i);
    pia_output *output;
    pia_checkpoint_writer writer;
    assert_ok(*state, pia_output_open(*state, path_of("large"), &output));
    pia_checkpoint_begin(&writer, output);
    pia_checkpoint_put(&writer, "values", PIA_SECTION_DOUBLE, values, COUNT);
    pia_checkpoint_end(&writer);
    assert_ok(*state, pia_output_commit(output));
    pia_checkpoint *checkpoint = NULL;
    assert_ok(*state, pia_checkpoint_open(*state, path_of("large"), &checkpoint));
    assert_ok(*state, pia_checkpoint_copy(checkpoint, "values", PIA_SECTION_DOUBLE, copy, COUNT));
    assert_memory_equal(copy, values, COUNT * sizeof *copy);
    pia_checkpoint_close(checkpoint);
    free(values);
    free(copy);
}

static void any_changed_missing_or_added_byte_is_noticed(void **state)
{
    write_checkpoint(*state, "state");
    FILE *file = fopen(path_of("state"), "rb");
    char bytes[1024];
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    pia_checkpoint *checkpoint = NULL;
    for (size_t i = 0; i < size; i++) {
        for (int bit = 0; bit < 8; bit++) {
            bytes[i] = (char)(bytes[i] ^ 1 << bit);
            pia_input input = {.path = "state", .begin = bytes, .end = bytes + size};
            assert_status(*state, pia_checkpoint_scan(*state, &input, &checkpoint), PIA_E_FORMAT);
            bytes[i] = (char)(bytes[i] ^ 1 << bit);
        }
        pia_input input = {.path = "state", .begin = bytes, .end = bytes + i};
        assert_status(*state, pia_checkpoint_scan(*state, &input, &checkpoint), PIA_E_FORMAT);
    }
    pia_input input = {.path = "state", .begin = bytes, .end = bytes + size + 1};
    assert_status(*state, pia_checkpoint_scan(*state, &input, &checkpoint), PIA_E_FORMAT);
    assert_null(checkpoint);
    assert_non_null(strstr(pia_message(*state), "state: is damaged"));
}

static void the_checksum_is_the_published_one(void **state)
{
    (void)state;
    enum { SIZE = 2000 };
    unsigned char bytes[SIZE];
    assert_int_equal(pia_crc32c(0, "123456789", 9), 0xe3069283);
    memset(bytes, 0, 32); /* RFC 3720, appendix B.4 */
    assert_int_equal(pia_crc32c(0, bytes, 32), 0x8a9136aa);
    memset(bytes, 0xff, 32);
    assert_int_equal(pia_crc32c(0, bytes, 32), 0x62a8ab43);
    for (int i = 0; i < SIZE; i++) bytes[i] = (unsigned char)(7 * i);
    for (size_t cut = 0; cut <= SIZE; cut += 7) /* short pieces go bit by bit, long ones eight bytes a step */
        assert_int_equal(pia_crc32c(pia_crc32c(0, bytes, cut), bytes + cut, SIZE - cut), pia_crc32c(0, bytes, SIZE));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(sections_come_back_with_the_same_bits),
        IN_FOLDER(large_sections_come_back),
        IN_FOLDER(any_changed_missing_or_added_byte_is_noticed),
        IN_FOLDER(the_checksum_is_the_published_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
