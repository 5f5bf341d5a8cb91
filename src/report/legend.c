#include "legend.h"

#include "style.h"
#include "ticks.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

enum { STROKE = 20, MARK = 9, GAP = 5, BETWEEN = 16, ROW = 14 };

static const pia_type entry_type = {.size = PIA_TEXT_SIZE, .colour = {0.13, 0.13, 0.13, 1}, .down = 0.5};

void pia_legend_add(pia_legend *legend, pia_pen pen, pia_mark mark, pia_colour fill, const char *format, ...)
{
    if (legend->count == PIA_MAX_LEGEND) return;
    pia_legend_entry *entry = &legend->entry[legend->count++];
    entry->pen = pen;
    entry->mark = mark;
    entry->fill = fill;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(entry->text, sizeof entry->text, format, arguments);
    va_end(arguments);
}

void pia_mark_draw(pia_canvas *canvas, pia_spot c, pia_mark mark, double size, pia_colour fill, pia_pen rim)
{
    double h = 0.5 * size;
    switch (mark) {
    case PIA_MARK_NONE: break;
    case PIA_MARK_DISC: canvas->disc(canvas, c, h, fill, rim); break;
    case PIA_MARK_SQUARE:
    case PIA_MARK_PATCH: {
        double w = mark == PIA_MARK_PATCH ? 1.6 * h : h;
        pia_spot corner[4] = {{c.x - w, c.y - h}, {c.x + w, c.y - h}, {c.x + w, c.y + h}, {c.x - w, c.y + h}};
        canvas->polygon(canvas, corner, 4, fill, rim);
        break;
    }
    case PIA_MARK_TICK: canvas->line(canvas, (pia_spot[]){{c.x, c.y - h}, {c.x, c.y + h}}, 2, (pia_pen){fill, 0.9, 0}); break;
    }
}

/* Width of an entry's sample. */
static double sample(const pia_legend_entry *entry)
{
    return entry->pen.width > 0 ? STROKE : entry->mark == PIA_MARK_PATCH ? 1.6 * MARK : MARK;
}

static void draw_entry(pia_canvas *canvas, const pia_legend_entry *entry, double left, double y)
{
    static const double size[] = {[PIA_MARK_DISC] = 3.6, [PIA_MARK_SQUARE] = 3.6, [PIA_MARK_TICK] = 7, [PIA_MARK_PATCH] = 8};
    if (entry->pen.width > 0) canvas->line(canvas, (pia_spot[]){{left, y}, {left + STROKE, y}}, 2, entry->pen);
    pia_pen rim = entry->mark == PIA_MARK_SQUARE ? entry->pen : (pia_pen){.width = 0};
    pia_mark_draw(canvas, (pia_spot){left + 0.5 * sample(entry), y}, entry->mark, size[entry->mark], entry->fill, rim);
    canvas->text(canvas, (pia_spot){left + sample(entry) + GAP, y}, entry->text, entry_type);
}

double pia_legend_draw(pia_canvas *canvas, const pia_legend *legend, double left, double right, double top)
{
    double x = left, y = top + 0.5 * ROW;
    for (int i = 0; i < legend->count; i++) {
        double width = sample(&legend->entry[i]) + GAP + canvas->text_width(canvas, legend->entry[i].text, entry_type);
        if (x > left && x + width > right) {
            x = left;
            y += ROW;
        }
        draw_entry(canvas, &legend->entry[i], x, y);
        x += width + BETWEEN;
    }
    return legend->count > 0 ? y + 0.5 * ROW - top : 0;
}

void pia_scale_draw(pia_canvas *canvas, const pia_box *box, pia_ramp ramp, double low, double high, const char *title)
{
    enum { STEPS = 128 };
    double height = box->bottom - box->top;
    /* Each step reaches under the next one, so that no seam of the paper shows between two; not farther, because every layer more makes
     * the rim darker where it cuts a pixel. */
    for (int i = 0; i < STEPS; i++) {
        double y = box->top + height * i / STEPS, end = fmin(box->bottom, y + 2 * height / STEPS);
        pia_spot corner[4] = {{box->left, y}, {box->right, y}, {box->right, end}, {box->left, end}};
        canvas->polygon(canvas, corner, 4, pia_ramp_colour(ramp, 1 - (i + 0.5) / STEPS), (pia_pen){.width = 0});
    }
    pia_ticks ticks;
    char text[3 * PIA_LABEL_SIZE];
    pia_ticks_linear(low, high, (int)fmin(6, fmax(2, height / 50)), &ticks);
    pia_type type = {.size = PIA_TICK_SIZE, .colour = pia_style_axis.colour, .down = 0.5};
    double widest = 0;
    for (int i = 0; i < ticks.count; i++) {
        double y = box->bottom - height * (ticks.value[i] - low) / (high - low);
        canvas->line(canvas, (pia_spot[]){{box->right, y}, {box->right + 3, y}}, 2, pia_style_axis);
        pia_tick_label(&ticks, i, text);
        canvas->text(canvas, (pia_spot){box->right + 6, y}, text, type);
        widest = fmax(widest, canvas->text_width(canvas, text, type));
    }
    pia_tick_title(&ticks, title, text);
    canvas->text(canvas, (pia_spot){box->right + 14 + widest, 0.5 * (box->top + box->bottom)}, text,
                 (pia_type){.size = PIA_TEXT_SIZE, .colour = pia_style_text, .across = 0.5, .angle = 90, .room = height});
}
