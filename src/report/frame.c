#include "frame.h"

#include "style.h"

#include <math.h>

void pia_range_widen(double *low, double *high, double extent, double pad)
{
    double magnitude = fmax(fabs(*low), fabs(*high));
    /* Below 1e-12 of the magnitude an extent is rounding, and shows as one point. */
    double least = extent > 1e-12 * magnitude ? 1e-9 * magnitude : magnitude > 0 ? magnitude : 1;
    double more = pad * fmax(extent, least);
    *low -= more;
    *high += more;
}

void pia_frame_equalise(pia_frame *frame)
{
    double scale[2] = {(frame->high[0] - frame->low[0]) / (frame->page.right - frame->page.left),
                       (frame->high[1] - frame->low[1]) / (frame->page.bottom - frame->page.top)};
    int narrow = scale[0] < scale[1] ? 0 : 1;
    double more = 0.5 * (frame->high[narrow] - frame->low[narrow]) * (scale[1 - narrow] / scale[narrow] - 1);
    frame->low[narrow] -= more;
    frame->high[narrow] += more;
}

pia_spot pia_frame_spot(const pia_frame *frame, double x, double y)
{
    double across = (x - frame->low[0]) / (frame->high[0] - frame->low[0]);
    double up = (y - frame->low[1]) / (frame->high[1] - frame->low[1]);
    return (pia_spot){frame->page.left + across * (frame->page.right - frame->page.left),
                      frame->page.bottom - up * (frame->page.bottom - frame->page.top)};
}

static void choose_ticks(const pia_frame *frame, int axis, pia_ticks *ticks)
{
    double length = axis == 0 ? frame->page.right - frame->page.left : frame->page.bottom - frame->page.top;
    int wanted = (int)fmin(8, fmax(2, length / (axis == 0 ? 70 : frame->logarithmic ? 24 : 42)));
    if (axis == 1 && frame->logarithmic)
        pia_ticks_decades(frame->low[1], frame->high[1], wanted, ticks);
    else
        pia_ticks_linear(frame->low[axis], frame->high[axis], wanted, ticks);
}

static void draw_across(pia_canvas *canvas, const pia_frame *frame, const pia_ticks *ticks)
{
    const pia_box *page = &frame->page;
    char text[3 * PIA_LABEL_SIZE];
    for (int i = 0; i < ticks->count; i++) {
        double x = pia_frame_spot(frame, ticks->value[i], frame->low[1]).x;
        canvas->line(canvas, (pia_spot[]){{x, page->bottom}, {x, page->top}}, 2, pia_style_grid);
        pia_tick_label(ticks, i, text);
        canvas->text(canvas, (pia_spot){x, page->bottom + 6}, text,
                     (pia_type){.size = PIA_TICK_SIZE, .colour = pia_style_axis.colour, .across = 0.5});
    }
    pia_tick_title(ticks, frame->name[0], text);
    canvas->text(canvas, (pia_spot){0.5 * (page->left + page->right), page->bottom + 20}, text,
                 (pia_type){.size = PIA_TEXT_SIZE, .colour = pia_style_text, .across = 0.5});
}

static void draw_up(pia_canvas *canvas, const pia_frame *frame, const pia_ticks *ticks)
{
    const pia_box *page = &frame->page;
    pia_type type = {.size = PIA_TICK_SIZE, .colour = pia_style_axis.colour, .across = 1, .down = 0.5};
    char text[3 * PIA_LABEL_SIZE];
    double widest = 0;
    for (int i = 0; i < ticks->count; i++) {
        double y = pia_frame_spot(frame, frame->low[0], ticks->value[i]).y;
        canvas->line(canvas, (pia_spot[]){{page->left, y}, {page->right, y}}, 2, pia_style_grid);
        pia_tick_label(ticks, i, text);
        canvas->text(canvas, (pia_spot){page->left - 5, y}, text, type);
        widest = fmax(widest, canvas->text_width(canvas, text, type));
    }
    pia_tick_title(ticks, frame->name[1], text);
    canvas->text(
        canvas, (pia_spot){page->left - 12 - widest, 0.5 * (page->top + page->bottom)}, text,
        (pia_type){
            .size = PIA_TEXT_SIZE, .colour = pia_style_text, .across = 0.5, .down = 1, .angle = 90, .room = page->bottom - page->top});
}

void pia_frame_draw(pia_canvas *canvas, const pia_frame *frame)
{
    const pia_box *page = &frame->page;
    pia_ticks ticks;
    choose_ticks(frame, 0, &ticks);
    draw_across(canvas, frame, &ticks);
    choose_ticks(frame, 1, &ticks);
    draw_up(canvas, frame, &ticks);
    canvas->line(canvas,
                 (pia_spot[]){{page->left, page->top},
                              {page->right, page->top},
                              {page->right, page->bottom},
                              {page->left, page->bottom},
                              {page->left, page->top}},
                 5, pia_style_axis);
}
