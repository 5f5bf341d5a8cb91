#include "panel.h"

#include "label.h"
#include "style.h"

#include <math.h>
#include <stdio.h>

double pia_dot_radius(pia_index count)
{
    return fmin(2, fmax(1, 2.6 - 0.4 * log10((double)count + 1)));
}

/* A lone curve under coloured data is drawn dark, so that only one thing speaks by colour. */
pia_colour pia_curve_colour(const pia_scene *scene, pia_index index)
{
    return scene->deviation != NULL && scene->figure_count == 1 ? pia_colour_grey(0.25) : pia_colour_cycle(index);
}

int pia_knots_shown(const pia_scene *scene, const pia_figure *curve)
{
    return scene->options.knots && pia_samples_knots(&curve->samples[0]) <= PIA_MOST_MARKS;
}

void pia_comb_legend(const pia_scene *scene, pia_legend *legend)
{
    char size[PIA_LABEL_SIZE];
    double most = 0;
    if (!(scene->comb_scale > 0)) return;
    for (pia_index f = 0; f < scene->figure_count; f++)
        for (pia_index i = 0; i < scene->figure[f].tooth_count; i++) most = fmax(most, scene->figure[f].tooth[i].curvature);
    pia_label_significant(most, 3, size);
    pia_legend_add(legend, pia_style_comb, PIA_MARK_NONE, pia_style_text, "curvature comb, up to %.40s%s", size,
                   scene->comb_scale * most > scene->comb_longest ? " (cut)" : "");
}

pia_index pia_spot_room(const pia_scene *scene)
{
    pia_index busy = scene->point_count, single = 0;
    for (pia_index f = 0; f < scene->figure_count; f++) {
        const pia_figure *figure = &scene->figure[f];
        busy += figure->samples[0].count;
        if (figure->info.control[0] > single) single = figure->info.control[0];
        if (figure->tooth_count > single) single = figure->tooth_count;
    }
    return busy > single ? busy : single;
}

void pia_curves_legend(const pia_scene *scene, pia_legend *legend)
{
    enum { MOST = 6 }; /* then the colours come again */
    for (pia_index f = 0; f < scene->figure_count && f < MOST; f++) {
        char name[32] = "curve";
        if (scene->figure_count > 1)
            snprintf(name, sizeof name, "curve %lld%s", (long long)f + 1, f + 1 == MOST && scene->figure_count > MOST ? " ..." : "");
        pia_legend_add(legend, (pia_pen){pia_curve_colour(scene, f), pia_curve_width(&scene->figure[0]), 0}, PIA_MARK_NONE,
                       pia_style_text, "%s", name);
    }
}

double pia_curve_width(const pia_figure *curve)
{
    return curve->info.control[0] > PIA_MOST_MARKS ? 0.9 : 1.5;
}

/* How many spots a box covers. */
static pia_index covered(const pia_spot *spots, pia_index count, const pia_box *box)
{
    pia_index inside = 0;
    for (pia_index i = 0; i < count; i++)
        inside += spots[i].x > box->left && spots[i].x < box->right && spots[i].y > box->top && spots[i].y < box->bottom;
    return inside;
}

/* A plate of this width about `spot`, number 0 to 11: four corners, near, further and far away; moved into the page across. */
static pia_box plate_at(pia_spot spot, double width, int number, const pia_box *page)
{
    double side = number & 1 ? -1 : 1, down = number & 2 ? -1 : 1;
    int away = 14 + number / 4 * 20;
    double left = spot.x + 14 * side - (side < 0 ? width : 0), middle = spot.y + away * down;
    left = fmax(page->left, fmin(left, page->right - width));
    return (pia_box){left, middle - 7, left + width, middle + 7};
}

/* The plate inside the page that hides least; of equal ones the one towards the middle of the page, where there are no axes. */
static pia_box choose_plate(pia_spot spot, const pia_spot *busy, pia_index count, double width, const pia_box *page)
{
    int inward = (spot.x > 0.5 * (page->left + page->right)) + 2 * (spot.y > 0.5 * (page->top + page->bottom));
    pia_box best = plate_at(spot, width, inward, page);
    pia_index least = count + 1;
    for (int number = 0; number < 12; number++) {
        pia_box plate = plate_at(spot, width, number ^ inward, page);
        pia_index hidden = covered(busy, count, &plate);
        if (plate.top < page->top || plate.bottom > page->bottom || hidden >= least) continue;
        least = hidden;
        best = plate;
    }
    return best;
}

void pia_worst_draw(pia_canvas *canvas, const pia_scene *scene, const pia_spot *spots, pia_index count, const pia_box *page)
{
    char size[PIA_LABEL_SIZE], text[2 * PIA_LABEL_SIZE];
    if (scene->deviation == NULL || !(scene->largest > 0)) return;
    pia_label_significant(scene->largest, 3, size);
    snprintf(text, sizeof text, "max %.40s at point %lld", size, (long long)scene->worst);
    pia_type type = {.size = PIA_TEXT_SIZE, .colour = pia_style_warning, .down = 0.5};
    pia_spot spot = spots[scene->worst];
    pia_box plate = choose_plate(spot, spots, count, canvas->text_width(canvas, text, type) + 6, page);
    double middle = 0.5 * (plate.top + plate.bottom), end = fmax(plate.left, fmin(spot.x, plate.right));
    double length = hypot(end - spot.x, middle - spot.y);
    const pia_spot corner[4] = {
        {plate.left, plate.top}, {plate.right, plate.top}, {plate.right, plate.bottom}, {plate.left, plate.bottom}};
    const pia_spot leader[2] = {{spot.x + 5 * (end - spot.x) / length, spot.y + 5 * (middle - spot.y) / length}, {end, middle}};
    canvas->line(canvas, leader, 2, (pia_pen){pia_style_warning, 0.7, 0});
    canvas->disc(canvas, spot, 5, pia_colour_faded(pia_style_paper, 0), (pia_pen){pia_style_warning, 1.2, 0});
    canvas->polygon(canvas, corner, 4, pia_colour_faded(pia_style_paper, 0.82), (pia_pen){.width = 0});
    canvas->text(canvas, (pia_spot){plate.left + 3, middle}, text, type);
}
