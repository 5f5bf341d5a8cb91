/* HDF5: the plug-in pia-hdf5 gives the array that is wanted as an NPY file, so that arrays of both mean the same. What it says
 * otherwise is what is wrong. */
#include "plugin.h"

#include <stdio.h>
#include <string.h>

#include "hdf5_answer.h"

const pia_plugin pia_plugin_hdf5 = {.program = "pia-hdf5", .part = "HDF5", .packages = "libhdf5-dev"};

static pia_status fail_as_told(pia_context *context, const pia_input *answer)
{
    char text[301];
    pia_index length = answer->end - answer->begin;
    snprintf(text, sizeof text, "%.*s", length > 300 ? 300 : (int)length, answer->begin);
    for (char *c = text; *c != '\0'; c++)
        if ((unsigned char)*c < ' ') *c = ' ';
    return pia_input_fail(context, answer, NULL, "%s", text);
}

static pia_status parse(pia_context *context, const pia_input *said, const pia_points_options *options, pia_points *out)
{
    static const char array[] = "\x93NUMPY", end[] = PIA_HDF5_END;
    const pia_index start = sizeof array - 1, stop = sizeof end - 1;
    pia_input answer = *said;
    if (said->end - said->begin < stop || memcmp(said->end - stop, end, (size_t)stop) != 0)
        return pia_plugin_broke_off(context, said, &pia_plugin_hdf5);
    answer.end -= stop;
    if (answer.end - answer.begin < start || memcmp(answer.begin, array, (size_t)start) != 0) return fail_as_told(context, &answer);
    return pia_format_find("npy", NULL)->read_points(context, &answer, options, out);
}

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    char *bytes;
    pia_index size;
    const char *name = input->inside != NULL ? input->inside : "";
    if (!input->mapped) /* HDF5 opens files by name */
        return pia_input_fail(context, input, NULL, "HDF5 is read from files, not from pipes or what is empty; save it as a file");
    pia_status status = pia_plugin_run(context, input, &pia_plugin_hdf5, name, &bytes, &size);
    if (status != PIA_OK) return status;
    const pia_input said = {.path = input->path, .begin = bytes, .end = bytes + size};
    status = parse(context, &said, options, out);
    pia_give(context, bytes);
    return status;
}

const pia_format pia_format_hdf5 = {
    .name = "hdf5",
    .title = "HDF5, one array",
    .detail = "FILE.h5:/NAME, or the only array of the file: [n x dim] points, [n x m x dim] grids, or a matrix of heights",
    .extensions = "h5 hdf5 hdf",
    .read_points = read_points,
    .plugin = &pia_plugin_hdf5,
    .holds_arrays = 1,
};
