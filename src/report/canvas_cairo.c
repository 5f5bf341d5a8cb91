#include "canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <math.h>
#include <string.h>

typedef struct cairo_canvas {
    pia_canvas base;
    pia_context *context;
    pia_output *output;
    pia_picture picture;
    cairo_surface_t *surface;
    cairo_t *cairo;
    int matched, skipping; /* state of write_svg */
} cairo_canvas;

static cairo_canvas *self(pia_canvas *canvas)
{
    return (cairo_canvas *)canvas;
}

static cairo_status_t write_bytes(void *closure, const unsigned char *data, unsigned length)
{
    cairo_canvas *canvas = closure;
    pia_output_bytes(canvas->output, data, length);
    return CAIRO_STATUS_SUCCESS;
}

/* Cairo names the root group after a counter of its process ("surface7"). The number is left out, so that equal pictures are equal
 * bytes; nothing refers to it. */
static cairo_status_t write_svg(void *closure, const unsigned char *data, unsigned length)
{
    static const char mark[] = "id=\"surface";
    cairo_canvas *canvas = closure;
    unsigned begin = 0;
    for (unsigned i = 0; i < length; i++) {
        int digit = data[i] >= '0' && data[i] <= '9';
        if (canvas->skipping && digit) {
            pia_output_bytes(canvas->output, data + begin, i - begin);
            begin = i + 1;
            continue;
        }
        canvas->skipping = 0;
        canvas->matched = data[i] == (unsigned char)mark[canvas->matched] ? canvas->matched + 1 : data[i] == (unsigned char)mark[0];
        if (mark[canvas->matched] != '\0') continue;
        canvas->skipping = 1;
        canvas->matched = 0;
    }
    pia_output_bytes(canvas->output, data + begin, length - begin);
    return CAIRO_STATUS_SUCCESS;
}

static void set_colour(cairo_t *cairo, pia_colour colour)
{
    cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, colour.alpha);
}

static void set_pen(cairo_t *cairo, pia_pen pen)
{
    set_colour(cairo, pen.colour);
    cairo_set_line_width(cairo, pen.width);
    cairo_set_dash(cairo, &pen.dash, pen.dash > 0 ? 1 : 0, 0);
}

static void trace_path(cairo_t *cairo, const pia_spot *spots, pia_index count)
{
    cairo_new_path(cairo);
    for (pia_index i = 0; i < count; i++) cairo_line_to(cairo, spots[i].x, spots[i].y);
}

static void draw_line(pia_canvas *canvas, const pia_spot *spots, pia_index count, pia_pen pen)
{
    cairo_t *cairo = self(canvas)->cairo;
    trace_path(cairo, spots, count);
    set_pen(cairo, pen);
    cairo_stroke(cairo);
}

static void fill_path(cairo_t *cairo, pia_colour fill, pia_pen rim)
{
    cairo_close_path(cairo);
    set_colour(cairo, fill);
    if (rim.width > 0) {
        cairo_fill_preserve(cairo);
        set_pen(cairo, rim);
        cairo_stroke(cairo);
    } else {
        cairo_fill(cairo);
    }
}

static void draw_polygon(pia_canvas *canvas, const pia_spot *spots, pia_index count, pia_colour fill, pia_pen rim)
{
    cairo_t *cairo = self(canvas)->cairo;
    trace_path(cairo, spots, count);
    fill_path(cairo, fill, rim);
}

static void draw_disc(pia_canvas *canvas, pia_spot centre, double radius, pia_colour fill, pia_pen rim)
{
    cairo_t *cairo = self(canvas)->cairo;
    cairo_new_path(cairo);
    cairo_arc(cairo, centre.x, centre.y, radius, 0, 2 * acos(-1.0));
    fill_path(cairo, fill, rim);
}

static void set_type(cairo_t *cairo, pia_type type)
{
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, type.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, type.size);
}

/* Leaves the font set, in the size that fits. */
static double text_width(pia_canvas *canvas, const char *text, pia_type type)
{
    cairo_t *cairo = self(canvas)->cairo;
    cairo_text_extents_t extents;
    set_type(cairo, type);
    cairo_text_extents(cairo, text, &extents);
    if (!(type.room > 0) || extents.x_advance <= type.room) return extents.x_advance;
    cairo_set_font_size(cairo, type.size * type.room / extents.x_advance);
    return type.room;
}

static void draw_text(pia_canvas *canvas, pia_spot spot, const char *text, pia_type type)
{
    const double capital = 0.73; /* height of capital letters in the usual sans-serif faces, of the size */
    cairo_t *cairo = self(canvas)->cairo;
    double width = text_width(canvas, text, type);
    cairo_save(cairo);
    cairo_translate(cairo, spot.x, spot.y);
    cairo_rotate(cairo, -type.angle * acos(-1.0) / 180);
    cairo_move_to(cairo, -type.across * width, (1 - type.down) * capital * type.size);
    set_colour(cairo, type.colour);
    cairo_show_text(cairo, text);
    cairo_restore(cairo);
}

static void clip(pia_canvas *canvas, const pia_box *box)
{
    cairo_t *cairo = self(canvas)->cairo;
    cairo_reset_clip(cairo);
    if (box == NULL) return;
    cairo_rectangle(cairo, box->left, box->top, box->right - box->left, box->bottom - box->top);
    cairo_clip(cairo);
}

static pia_status close_canvas(pia_canvas *base)
{
    cairo_canvas *canvas = self(base);
    pia_context *context = canvas->context;
    cairo_status_t status = cairo_status(canvas->cairo);
    cairo_destroy(canvas->cairo);
    if (status == CAIRO_STATUS_SUCCESS && canvas->picture == PIA_PICTURE_PNG)
        status = cairo_surface_write_to_png_stream(canvas->surface, write_bytes, canvas);
    cairo_surface_finish(canvas->surface);
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(canvas->surface);
    cairo_surface_destroy(canvas->surface);
    pia_give(context, canvas);
    if (status == CAIRO_STATUS_SUCCESS) return PIA_OK;
    if (status == CAIRO_STATUS_NO_MEMORY) return pia_fail(context, PIA_E_MEMORY, "out of memory for a picture; ask for a smaller one");
    return pia_fail(context, PIA_E_INTERNAL, "Cairo could not draw the picture: %s", cairo_status_to_string(status));
}

static cairo_surface_t *surface_of(cairo_canvas *canvas, double width, double height, double scale)
{
    if (canvas->picture == PIA_PICTURE_SVG) return cairo_svg_surface_create_for_stream(write_svg, canvas, width, height);
    if (canvas->picture == PIA_PICTURE_PDF) return cairo_pdf_surface_create_for_stream(write_bytes, canvas, width, height);
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)lround(scale * width), (int)lround(scale * height));
}

/* Letters keep their shapes and widths whatever the resolution, so that all formats break and place text alike. */
static void start_page(cairo_canvas *canvas, double scale)
{
    cairo_font_options_t *font = cairo_font_options_create();
    cairo_font_options_set_hint_metrics(font, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_hint_style(font, CAIRO_HINT_STYLE_NONE);
    cairo_set_font_options(canvas->cairo, font);
    cairo_font_options_destroy(font);
    cairo_set_line_join(canvas->cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(canvas->cairo, CAIRO_LINE_CAP_ROUND);
    if (canvas->picture == PIA_PICTURE_PNG) cairo_scale(canvas->cairo, scale, scale);
    set_colour(canvas->cairo, pia_colour_grey(1));
    cairo_paint(canvas->cairo);
}

pia_status pia_canvas_open(pia_context *context, pia_output *output, pia_picture picture, double width, double height, double scale,
                           pia_canvas **out)
{
    cairo_canvas *canvas = pia_take_zero(context, 1, sizeof *canvas);
    if (canvas == NULL) return PIA_E_MEMORY;
    canvas->base = (pia_canvas){width, height, draw_line, draw_polygon, draw_disc, draw_text, text_width, clip, close_canvas};
    canvas->context = context;
    canvas->output = output;
    canvas->picture = picture;
    canvas->surface = surface_of(canvas, width, height, scale);
    canvas->cairo = cairo_create(canvas->surface);
    start_page(canvas, scale);
    *out = &canvas->base;
    return PIA_OK;
}
