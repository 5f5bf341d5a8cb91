#include "io.h"
#include "number.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* ESRI ASCII grids: a header of keys and values, then rows from north to south. */

typedef struct asc {
    const char *p, *end;
    double columns, rows, cell[2], corner[2], hole;
    int centred[2]; /* 1: `corner` is the centre of the corner cell */
} asc;

static void skip_blanks(asc *grid)
{
    while (grid->p < grid->end && (*grid->p == ' ' || *grid->p == '\t' || *grid->p == '\n' || *grid->p == '\r')) grid->p++;
}

static int is_letter(char c)
{
    return (unsigned char)((c | 0x20) - 'a') < 26;
}

static int scan_number(asc *grid, double *value)
{
    skip_blanks(grid);
    const char *after = pia_number_parse(grid->p, grid->end, value);
    if (after == NULL || (after < grid->end && strchr(" \t\r\n", *after) == NULL)) return 0;
    grid->p = after;
    return 1;
}

/* Stores the value of a key; returns 0 for an unknown key. */
static int store(asc *grid, const char *key, size_t length, double value)
{
    static const char *const name[] = {"ncols",     "nrows",     "cellsize",  "dx",        "dy",
                                       "xllcorner", "yllcorner", "xllcenter", "yllcenter", "nodata_value"};
    size_t k = 0;
    while (k < sizeof name / sizeof *name && (strlen(name[k]) != length || strncasecmp(name[k], key, length) != 0)) k++;
    switch (k) {
    case 0: grid->columns = value; break;
    case 1: grid->rows = value; break;
    case 2: grid->cell[0] = grid->cell[1] = value; break;
    case 3: grid->cell[0] = value; break;
    case 4: grid->cell[1] = value; break;
    case 5:
    case 6: grid->corner[k - 5] = value; break;
    case 7:
    case 8:
        grid->corner[k - 7] = value;
        grid->centred[k - 7] = 1;
        break;
    case 9: grid->hole = value; break;
    default: return 0;
    }
    return 1;
}

/* "nan" begins a row, not a key. */
static int at_key(asc *grid)
{
    double value;
    skip_blanks(grid);
    return grid->p < grid->end && is_letter(*grid->p) && pia_number_parse(grid->p, grid->end, &value) == NULL;
}

static pia_status read_header(pia_context *context, const pia_input *input, asc *grid)
{
    *grid = (asc){.p = input->begin, .end = input->end, .hole = -9999};
    while (at_key(grid)) {
        const char *key = grid->p;
        double value;
        char quote[32];
        while (grid->p < grid->end && (is_letter(*grid->p) || *grid->p == '_')) grid->p++;
        size_t length = (size_t)(grid->p - key);
        pia_input_quote(key, grid->p, quote);
        if (!scan_number(grid, &value)) return pia_input_fail(context, input, key, "'%s' must be followed by a number", quote);
        if (!store(grid, key, length, value)) return pia_input_fail(context, input, key, "'%s' is no key of an ESRI ASCII grid", quote);
    }
    double most = (double)(grid->end - grid->p); /* a value takes at least a digit and a blank */
    if (!(grid->columns >= 1 && grid->rows >= 1 && grid->columns == floor(grid->columns) && grid->rows == floor(grid->rows)))
        return pia_input_fail(context, input, NULL, "has no ncols and nrows; is this an ESRI ASCII grid?");
    if (!(2 * grid->columns * grid->rows - 1 <= most))
        return pia_input_fail(context, input, NULL, "its header claims %g x %g values, more than the file holds; copy it again",
                              grid->rows, grid->columns);
    for (int d = 0; d < 2; d++)
        if (!(grid->cell[d] > 0 && isfinite(grid->cell[d]) && isfinite(grid->corner[d])))
            return pia_input_fail(context, input, NULL, "its cell size must be positive, its corner finite");
    return PIA_OK;
}

static pia_status read_values(pia_context *context, const pia_input *input, asc *grid, pia_index count, double *out)
{
    for (pia_index i = 0; i < count; i++) {
        if (!scan_number(grid, &out[i])) {
            if (grid->p == grid->end)
                return pia_input_fail(context, input, NULL, "ends after %lld of %lld values; copy it again", (long long)i,
                                      (long long)count);
            return pia_input_fail(context, input, grid->p, "value %lld of %lld is not a number", (long long)i, (long long)count);
        }
        if (out[i] == grid->hole) out[i] = NAN;
    }
    return PIA_OK;
}

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    asc grid;
    pia_status status = read_header(context, input, &grid);
    if (status != PIA_OK) return status;
    pia_index rows = (pia_index)grid.rows, columns = (pia_index)grid.columns;
    double *heights = pia_take(context, rows * columns, sizeof *heights);
    if (heights == NULL) return pia_take_status(context, rows * columns, sizeof *heights);
    status = read_values(context, input, &grid, rows * columns, heights);
    if (status == PIA_OK) {
        double first[2], step[2] = {grid.cell[0], -grid.cell[1]};
        first[0] = grid.corner[0] + (grid.centred[0] ? 0 : grid.cell[0] / 2);
        first[1] = grid.corner[1] + ((double)(rows - 1) + (grid.centred[1] ? 0 : 0.5)) * grid.cell[1];
        status = pia_points_from_heights(context, heights, rows, columns, first, step, out);
    }
    pia_give(context, heights);
    return status == PIA_OK ? pia_points_screen(context, input, options, out) : status;
}

const pia_format pia_format_asc = {
    .name = "asc",
    .title = "ESRI ASCII grid of heights",
    .detail = "points are (x, y, value) at the cell centres, the northern row first; NODATA cells are holes",
    .extensions = "asc",
    .read_points = read_points,
};
