#include "fuzz.h"
#include "number.h"

/* The reader agrees with strtod in the C locale on everything that both call a number; strtod also knows hexadecimal and nan(...). */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    double value = 0;
    const char *begin = (const char *)data;
    const char *end = pia_number_parse(begin, begin + size, &value);
    if (end == NULL) return 0;
    PROMISE(end > begin && end <= begin + size);
    char *text = malloc((size_t)(end - begin) + 1), *expected_end;
    PROMISE(text != NULL);
    memcpy(text, begin, (size_t)(end - begin));
    text[end - begin] = '\0';
    double expected = strtod(text, &expected_end);
    PROMISE(expected_end == text + (end - begin));
    PROMISE(memcmp(&value, &expected, sizeof value) == 0 || (isnan(value) && isnan(expected)));
    free(text);
    char shortest[PIA_NUMBER_SIZE];
    PROMISE(pia_number_format(value, shortest) < PIA_NUMBER_SIZE);
    PROMISE(strtod(shortest, NULL) == value || isnan(value));
    return 0;
}
