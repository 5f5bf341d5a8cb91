#include "view.h"

#include "style.h"
#include "ticks.h"

#include <math.h>

enum { BESIDE = 46, BELOW = 30 }; /* points about the box for ticks and names */

void pia_view_aim(pia_view *view, double azimuth, double elevation)
{
    double a = azimuth * acos(-1.0) / 180, e = elevation * acos(-1.0) / 180;
    double right[3] = {-sin(a), cos(a), 0}, up[3] = {-sin(e) * cos(a), -sin(e) * sin(a), cos(e)};
    double toward[3] = {cos(e) * cos(a), cos(e) * sin(a), sin(e)};
    for (int c = 0; c < 3; c++) {
        view->right[c] = right[c];
        view->up[c] = up[c];
        view->toward[c] = toward[c];
    }
}

/* Component of a position along a direction, from the box's centre. */
static double along(const pia_view *view, const double direction[3], const double at[3])
{
    double sum = 0;
    for (int c = 0; c < 3; c++) sum += direction[c] * view->stretch[c] * (at[c] - 0.5 * (view->low[c] + view->high[c]));
    return sum;
}

/* Width of the box's outline on the page, in stretched units; `direction` is right or up. */
static double outline(const pia_view *view, const double direction[3])
{
    double sum = 0;
    for (int c = 0; c < 3; c++) sum += fabs(direction[c]) * view->stretch[c] * (view->high[c] - view->low[c]);
    return sum;
}

void pia_view_fit(pia_view *view, const pia_box *page)
{
    double wide = fmax(1, page->right - page->left - 2 * BESIDE), tall = fmax(1, page->bottom - page->top - BELOW);
    view->scale = fmin(wide / outline(view, view->right), tall / outline(view, view->up));
    view->middle = (pia_spot){0.5 * (page->left + page->right), 0.5 * (page->top + page->bottom - BELOW)};
}

double pia_view_height(const pia_view *view, double width)
{
    return (width - 2 * BESIDE) * outline(view, view->up) / outline(view, view->right) + BELOW;
}

pia_spot pia_view_spot(const pia_view *view, const double at[3])
{
    return (pia_spot){view->middle.x + view->scale * along(view, view->right, at),
                      view->middle.y - view->scale * along(view, view->up, at)};
}

double pia_view_depth(const pia_view *view, const double at[3])
{
    return along(view, view->toward, at);
}

/* The side of the box that is away from the viewer in direction c. */
static double far_side(const pia_view *view, int c)
{
    return view->toward[c] > 0 ? view->low[c] : view->high[c];
}

static double near_side(const pia_view *view, int c)
{
    return view->toward[c] > 0 ? view->high[c] : view->low[c];
}

static void choose_ticks(const pia_view *view, int axis, pia_ticks *ticks)
{
    double flat = hypot(view->right[axis], view->up[axis]);
    double length = view->scale * flat * view->stretch[axis] * (view->high[axis] - view->low[axis]);
    pia_ticks_linear(view->low[axis], view->high[axis], (int)fmin(6, fmax(2, length / (axis == 2 ? 32 : 45))), ticks);
}

/* The face on which direction `normal` is constant and away from the viewer, with the grid lines of its two directions. */
static void draw_face(pia_canvas *canvas, const pia_view *view, int normal, const pia_ticks ticks[3])
{
    int a = (normal + 1) % 3, b = (normal + 2) % 3;
    double at[3];
    at[normal] = far_side(view, normal);
    pia_spot corner[4];
    for (int k = 0; k < 4; k++) {
        at[a] = k == 1 || k == 2 ? view->high[a] : view->low[a];
        at[b] = k == 2 || k == 3 ? view->high[b] : view->low[b];
        corner[k] = pia_view_spot(view, at);
    }
    canvas->polygon(canvas, corner, 4, pia_colour_grey(normal == 2 ? 0.955 : 0.975), (pia_pen){pia_colour_grey(0.7), 0.6, 0});
    for (int turn = 0; turn < 2; turn++) {
        int across = turn == 0 ? a : b, run = turn == 0 ? b : a;
        for (int i = 0; i < ticks[across].count; i++) {
            at[across] = ticks[across].value[i];
            at[run] = view->low[run];
            pia_spot from = pia_view_spot(view, at);
            at[run] = view->high[run];
            canvas->line(canvas, (pia_spot[]){from, pia_view_spot(view, at)}, 2, (pia_pen){pia_colour_grey(0.87), 0.5, 0});
        }
    }
}

/* The edge that carries an axis' labels: x and y along the near bottom, z along the outline's left. `at` receives the edge's constant
 * coordinates. */
static void choose_edge(const pia_view *view, int axis, double at[3])
{
    for (int c = 0; c < 3; c++) at[c] = near_side(view, c);
    at[2] = view->low[2];
    if (axis != 2) return;
    /* The two outline edges join a near and a far side; the left one is wanted. */
    double near_x[3] = {near_side(view, 0), far_side(view, 1), view->low[2]},
           near_y[3] = {far_side(view, 0), near_side(view, 1), view->low[2]};
    const double *left = pia_view_spot(view, near_x).x < pia_view_spot(view, near_y).x ? near_x : near_y;
    at[0] = left[0];
    at[1] = left[1];
}

/* Unit normal of the edge on the page, pointing out of the box. */
static pia_spot outward(const pia_view *view, int axis, const double edge[3])
{
    double at[3] = {edge[0], edge[1], edge[2]};
    at[axis] = view->low[axis];
    pia_spot from = pia_view_spot(view, at);
    at[axis] = view->high[axis];
    pia_spot to = pia_view_spot(view, at);
    pia_spot middle = {0.5 * (from.x + to.x), 0.5 * (from.y + to.y)};
    double length = hypot(to.x - from.x, to.y - from.y);
    if (!(length > 0)) return (pia_spot){0, 1};
    pia_spot out = {(to.y - from.y) / length, (from.x - to.x) / length};
    int inside = out.x * (middle.x - view->middle.x) + out.y * (middle.y - view->middle.y) < 0;
    return inside ? (pia_spot){-out.x, -out.y} : out;
}

/* Where the edges that carry the labels of x and y meet. */
static pia_spot near_corner(const pia_view *view)
{
    const double at[3] = {near_side(view, 0), near_side(view, 1), view->low[2]};
    return pia_view_spot(view, at);
}

static void draw_axis(pia_canvas *canvas, const pia_view *view, int axis, const pia_ticks *ticks, const char *name)
{
    double at[3], widest = 0;
    char text[3 * PIA_LABEL_SIZE];
    choose_edge(view, axis, at);
    pia_spot out = outward(view, axis, at), corner = near_corner(view);
    pia_type type = {.size = PIA_TICK_SIZE, .colour = pia_style_axis.colour, .across = 0.5 - 0.5 * out.x, .down = 0.5 - 0.5 * out.y};
    for (int i = 0; i < ticks->count; i++) {
        at[axis] = ticks->value[i];
        pia_spot spot = pia_view_spot(view, at);
        canvas->line(canvas, (pia_spot[]){spot, {spot.x + 3 * out.x, spot.y + 3 * out.y}}, 2, pia_style_axis);
        if (axis == 1 && hypot(spot.x - corner.x, spot.y - corner.y) < 13) continue; /* there x has its label */
        pia_tick_label(ticks, i, text);
        canvas->text(canvas, (pia_spot){spot.x + 6 * out.x, spot.y + 6 * out.y}, text, type);
        widest = fmax(widest, canvas->text_width(canvas, text, type));
    }
    at[axis] = view->low[axis];
    pia_spot from = pia_view_spot(view, at);
    at[axis] = view->high[axis];
    pia_spot to = pia_view_spot(view, at);
    canvas->line(canvas, (pia_spot[]){from, to}, 2, pia_style_axis);
    double away = 13 + PIA_TICK_SIZE * fabs(out.y) + widest * fabs(out.x);
    pia_tick_title(ticks, name, text);
    type.size = PIA_TEXT_SIZE;
    type.colour = pia_style_text;
    if (out.x < -0.9 && canvas->text_width(canvas, text, type) > BESIDE / 2) { /* beside an upright edge there is little room */
        type.angle = 90;
        type.across = 0.5;
        type.down = 1;
    }
    canvas->text(canvas, (pia_spot){0.5 * (from.x + to.x) + away * out.x, 0.5 * (from.y + to.y) + away * out.y}, text, type);
}

void pia_view_draw_box(pia_canvas *canvas, const pia_view *view, const char *const name[3])
{
    pia_ticks ticks[3];
    for (int c = 0; c < 3; c++) choose_ticks(view, c, &ticks[c]);
    for (int c = 0; c < 3; c++) draw_face(canvas, view, c, ticks);
    for (int c = 0; c < 3; c++) draw_axis(canvas, view, c, &ticks[c], name[c]);
}
