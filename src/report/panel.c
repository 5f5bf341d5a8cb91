#include "panel.h"

#include "label.h"
#include "style.h"

#include <math.h>
#include <stdio.h>

double pia_dot_radius(pia_index count)
{
    return fmin(2, fmax(1.1, 2.6 - 0.4 * log10((double)count + 1)));
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

void pia_worst_draw(pia_canvas *canvas, const pia_scene *scene, pia_spot spot, const pia_box *page)
{
    char size[PIA_LABEL_SIZE], text[2 * PIA_LABEL_SIZE];
    pia_label_significant(scene->largest, 3, size);
    snprintf(text, sizeof text, "max %.40s at point %lld", size, (long long)scene->worst);
    double side = spot.x < 0.5 * (page->left + page->right) ? 1 : -1, down = spot.y < 0.5 * (page->top + page->bottom) ? 1 : -1;
    pia_spot end = {spot.x + 14 * side, spot.y + 14 * down};
    pia_type type = {.size = PIA_TEXT_SIZE, .colour = pia_style_warning, .down = 0.5};
    double width = canvas->text_width(canvas, text, type) + 6, left = side > 0 ? end.x : end.x - width;
    left = fmax(page->left, fmin(left, page->right - width));
    const pia_spot plate[4] = {{left, end.y - 7}, {left + width, end.y - 7}, {left + width, end.y + 7}, {left, end.y + 7}};
    canvas->line(canvas, (pia_spot[]){{spot.x + 3.5 * side, spot.y + 3.5 * down}, end}, 2, (pia_pen){pia_style_warning, 0.7, 0});
    canvas->disc(canvas, spot, 5, pia_colour_faded(pia_style_paper, 0), (pia_pen){pia_style_warning, 1.2, 0});
    canvas->polygon(canvas, plate, 4, pia_colour_faded(pia_style_paper, 0.82), (pia_pen){.width = 0});
    canvas->text(canvas, (pia_spot){left + 3, end.y}, text, type);
}
