#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    return fuzz_points(pia_format_find("ply", NULL), data, size);
}
