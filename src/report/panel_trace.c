#include "panel.h"

#include "frame.h"
#include "style.h"
#include "thin.h"

#include <math.h>

/* An error can be drawn on a logarithmic axis. */
static int drawable(double error)
{
    return error > 0 && error < INFINITY;
}

static double error_of(const pia_trace_row *row, int series)
{
    return series == 0 ? row->max_error : row->rms_error;
}

/* Returns 0 when no row can be drawn. */
static int find_range(const pia_trace_row *rows, pia_index count, pia_frame *frame)
{
    double low = INFINITY, high = -INFINITY;
    for (pia_index i = 0; i < 2 * count; i++) {
        double error = error_of(&rows[i / 2], i % 2);
        if (!drawable(error)) continue;
        low = fmin(low, log10(error));
        high = fmax(high, log10(error));
    }
    if (!(low <= high)) return 0;
    /* At least one decade, and ending on round powers of ten where that is near. */
    frame->low[1] = fmin(floor(low + 0.3), low - 0.1);
    frame->high[1] = fmax(fmax(ceil(high - 0.3), high + 0.1), frame->low[1] + 1);
    frame->low[0] = (double)rows[0].iteration;
    frame->high[0] = fmax((double)rows[count - 1].iteration, frame->low[0] + 1);
    pia_range_widen(&frame->low[0], &frame->high[0], frame->high[0] - frame->low[0], 0.015);
    return 1;
}

enum { MOST_INSERTIONS = 40 }; /* more lines could not be told apart */

static pia_index count_insertions(const pia_trace_row *rows, pia_index count)
{
    pia_index changes = 0;
    for (pia_index i = 1; i < count; i++) changes += rows[i].control_count != rows[i - 1].control_count;
    return changes;
}

/* Where the number of control points changed, the error started anew. */
static void draw_insertions(pia_canvas *canvas, const pia_frame *frame, const pia_trace_row *rows, pia_index count)
{
    for (pia_index i = 1; i < count; i++) {
        if (rows[i].control_count == rows[i - 1].control_count) continue;
        double x = pia_frame_spot(frame, (double)rows[i].iteration, 0).x;
        canvas->line(canvas, (pia_spot[]){{x, frame->page.top}, {x, frame->page.bottom}}, 2, (pia_pen){pia_colour_grey(0.7), 0.6, 2});
    }
}

static void draw_series(pia_canvas *canvas, const pia_frame *frame, const pia_trace_row *rows, pia_index count, int series,
                        pia_spot *spots)
{
    static const char *const names[] = {"max", "rms"};
    pia_colour colour = pia_colour_cycle(series == 0 ? 1 : 0);
    pia_index drawn = 0;
    for (pia_index i = 0; i < count; i++)
        if (drawable(error_of(&rows[i], series)))
            spots[drawn++] = pia_frame_spot(frame, (double)rows[i].iteration, log10(error_of(&rows[i], series)));
    drawn = pia_thin_line(spots, drawn, 0.25);
    canvas->line(canvas, spots, drawn, (pia_pen){colour, 1.4, 0});
    for (pia_index i = 0; drawn <= 60 && i < drawn; i++) canvas->disc(canvas, spots[i], 1.9, colour, (pia_pen){.width = 0});
    if (drawn > 0)
        canvas->text(canvas, (pia_spot){frame->page.right + 5, spots[drawn - 1].y}, names[series],
                     (pia_type){.size = PIA_TEXT_SIZE, .colour = colour, .down = series == 0 ? 0.8 : 0.2});
}

pia_status pia_trace_draw(pia_canvas *canvas, pia_context *context, const pia_trace_row *rows, pia_index count, pia_box page)
{
    pia_frame frame = {.page = {page.left + PIA_FRAME_LEFT, page.top, page.right, page.bottom - PIA_FRAME_BELOW},
                       .logarithmic = 1,
                       .name = {"iteration", "error"}};
    if (!find_range(rows, count, &frame)) return PIA_OK;
    pia_spot *spots = pia_take(context, count, sizeof *spots);
    if (spots == NULL) return pia_take_status(context, count, sizeof *spots);
    pia_index insertions = count_insertions(rows, count);
    if (insertions > 0 && insertions <= MOST_INSERTIONS) frame.name[0] = "iteration (dashed: control points added)";
    pia_frame_draw(canvas, &frame);
    if (insertions <= MOST_INSERTIONS) draw_insertions(canvas, &frame, rows, count);
    for (int series = 1; series >= 0; series--) draw_series(canvas, &frame, rows, count, series, spots);
    pia_give(context, spots);
    return PIA_OK;
}
