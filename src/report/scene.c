#include "scene.h"

#include "deviation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void cover(pia_scene *scene, const double *at, pia_index count)
{
    for (pia_index i = 0; i < 3 * count; i++) {
        scene->low[i % 3] = fmin(scene->low[i % 3], at[i]);
        scene->high[i % 3] = fmax(scene->high[i % 3], at[i]);
    }
}

static double diagonal(const pia_scene *scene)
{
    return hypot(hypot(scene->high[0] - scene->low[0], scene->high[1] - scene->low[1]), scene->high[2] - scene->low[2]);
}

static int compare_numbers(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* Nineteen of twenty teeth stay within a twelfth of the picture; the sharpest corners may take a fifth and are cut there, else one
 * leading edge would flatten all the rest. */
static pia_status scale_comb(pia_scene *scene)
{
    pia_index count = 0;
    for (pia_index f = 0; f < scene->figure_count; f++) count += scene->figure[f].tooth_count;
    if (count == 0) return PIA_OK;
    double *curvature = pia_take(scene->context, count, sizeof *curvature);
    if (curvature == NULL) return PIA_E_MEMORY;
    pia_index n = 0;
    for (pia_index f = 0; f < scene->figure_count; f++)
        for (pia_index i = 0; i < scene->figure[f].tooth_count; i++) curvature[n++] = scene->figure[f].tooth[i].curvature;
    qsort(curvature, (size_t)count, sizeof *curvature, compare_numbers);
    double usual = curvature[(count - 1) * 95 / 100], most = curvature[count - 1];
    double reach = usual > 0 ? usual : most;
    scene->comb_scale = reach > 0 ? diagonal(scene) / (12 * reach) : 0;
    scene->comb_longest = diagonal(scene) / 5;
    pia_give(scene->context, curvature);
    return PIA_OK;
}

void pia_scene_tip(const pia_scene *scene, const pia_tooth *tooth, double tip[3])
{
    double length = scene->comb_scale * tooth->curvature;
    double scale = length > scene->comb_longest ? scene->comb_longest / tooth->curvature : scene->comb_scale;
    for (int c = 0; c < 3; c++) tip[c] = tooth->root[c] - scale * tooth->bend[c];
}

static void cover_comb(pia_scene *scene)
{
    for (pia_index f = 0; f < scene->figure_count; f++) {
        for (pia_index i = 0; i < scene->figure[f].tooth_count; i++) {
            double tip[3];
            pia_scene_tip(scene, &scene->figure[f].tooth[i], tip);
            cover(scene, tip, 1);
        }
    }
}

/* Control points are shown as far as they stay near: a wild one must not shrink the shape to a speck. */
static void cover_control(pia_scene *scene)
{
    double low[3], high[3];
    for (int c = 0; c < 3; c++) {
        double reach = 0.25 * (scene->high[c] - scene->low[c]);
        low[c] = scene->low[c] - reach;
        high[c] = scene->high[c] + reach;
    }
    for (pia_index f = 0; f < scene->figure_count; f++)
        if (scene->figure[f].outside == NULL) /* the net of a trimmed surface is not drawn */
            cover(scene, scene->figure[f].control, scene->figure[f].info.control[0] * scene->figure[f].info.control[1]);
    for (int c = 0; c < 3; c++) {
        scene->low[c] = fmax(scene->low[c], low[c]);
        scene->high[c] = fmin(scene->high[c], high[c]);
    }
}

/* What is cut away takes no room. */
static void cover_shape(pia_scene *scene, const pia_figure *figure)
{
    for (pia_index i = 0; i < figure->samples[0].count * figure->samples[1].count; i++)
        if (figure->outside == NULL || !figure->outside[i]) cover(scene, figure->at + 3 * i, 1);
    cover(scene, figure->edge, 2 * figure->edge_count);
}

static pia_status find_bounds(pia_scene *scene)
{
    for (int c = 0; c < 3; c++) {
        scene->low[c] = INFINITY;
        scene->high[c] = -INFINITY;
    }
    for (pia_index f = 0; f < scene->figure_count; f++) cover_shape(scene, &scene->figure[f]);
    cover(scene, scene->point, scene->point_count);
    pia_status status = scale_comb(scene);
    if (status != PIA_OK) return status;
    cover_comb(scene);
    if (scene->options.control) cover_control(scene);
    return PIA_OK;
}

/* Parameters of the points: those given; else, for values of one component, those the model's fit kept; NULL when there are none. */
static const double *known_parameters(const pia_scene *scene, pia_index count)
{
    if (scene->options.parameters != NULL) return scene->options.parameters;
    pia_index kept = 0;
    const pia_figure *first = &scene->figure[0];
    const double *parameters = pia_model_parameters(first->model, &kept);
    return first->info.dim == 1 && kept == count * first->info.directions ? parameters : NULL;
}

static pia_status place_points(pia_scene *scene, const double *points, pia_index count)
{
    const pia_model_info *info = &scene->figure[0].info;
    const double *parameters = known_parameters(scene, count);
    if (info->dim == 1 && parameters == NULL)
        return pia_fail(scene->context, PIA_E_ARGUMENT, "values of one component have no place without parameters; give parameters");
    scene->point = pia_take(scene->context, count, 3 * sizeof *scene->point);
    if (scene->point == NULL) return pia_take_status(scene->context, count, 3 * sizeof *scene->point);
    for (pia_index i = 0; i < count; i++) {
        for (int c = 0; c < info->dim; c++)
            if (!(fabs(points[i * info->dim + c]) < 1e150))
                return pia_fail(scene->context, PIA_E_DATA,
                                "point %lld component %d is %g; pictures need finite coordinates below 1e150", (long long)i, c,
                                points[i * info->dim + c]);
        pia_figure_place(info, info->dim == 1 ? parameters + i * info->directions : NULL, points + i * info->dim, scene->point + 3 * i);
    }
    scene->point_count = count;
    return PIA_OK;
}

/* Distance and place of every point on one model; `distance` [count], `parameter` [count x directions]. */
static pia_status measure(const pia_scene *scene, const pia_figure *figure, const double *points, const double *known,
                          double *parameter, double *distance)
{
    pia_index count = scene->point_count;
    if (known == NULL) return pia_model_closest(scene->context, figure->model, points, count, parameter, distance);
    for (pia_index i = 0; i < count * figure->info.directions; i++) parameter[i] = known[i];
    pia_deviation summary = {.struct_size = sizeof summary};
    return pia_model_deviation(scene->context, figure->model, points, count, known, &summary, distance);
}

/* Every point belongs to the model it is nearest to. Given parameters are those of a single model. */
static pia_status compare_with_models(pia_scene *scene, const double *points, double *parameter, double *distance)
{
    const double *known = scene->figure_count == 1 ? known_parameters(scene, scene->point_count) : NULL;
    scene->parametric = known != NULL;
    for (pia_index i = 0; i < scene->point_count; i++) scene->deviation[i] = INFINITY;
    for (pia_index f = 0; f < scene->figure_count; f++) {
        const pia_model_info *info = &scene->figure[f].info;
        if (info->dim != scene->figure[0].info.dim) continue;
        pia_status status = measure(scene, &scene->figure[f], points, known, parameter, distance);
        if (status != PIA_OK) return status;
        for (pia_index i = 0; i < scene->point_count; i++) {
            if (!(distance[i] < scene->deviation[i])) continue;
            scene->deviation[i] = distance[i];
            scene->owner[i] = f;
            for (int d = 0; d < info->directions; d++) scene->parameter[2 * i + d] = parameter[i * info->directions + d];
        }
    }
    return PIA_OK;
}

/* scratch [point_count]. */
static pia_status summarise(pia_scene *scene, double *scratch)
{
    pia_deviation summary = {.struct_size = sizeof summary};
    memcpy(scratch, scene->deviation, (size_t)scene->point_count * sizeof *scratch);
    pia_status status = pia_deviation_summarize(scene->context, scratch, scene->point_count, &summary);
    scene->largest = summary.max_error;
    scene->rms = summary.rms_error;
    scene->worst = summary.max_error_index;
    return status;
}

static pia_status take_deviations(pia_scene *scene, const double *points)
{
    pia_context *context = scene->context;
    pia_index count = scene->point_count;
    scene->deviation = pia_take(context, count, sizeof *scene->deviation);
    scene->parameter = pia_take_zero(context, count, 2 * sizeof *scene->parameter);
    scene->owner = pia_take_zero(context, count, sizeof *scene->owner);
    double *parameter = pia_take(context, count, 2 * sizeof *parameter), *distance = pia_take(context, count, sizeof *distance);
    pia_status status = PIA_E_MEMORY;
    if (scene->deviation != NULL && scene->parameter != NULL && scene->owner != NULL && parameter != NULL && distance != NULL)
        status = compare_with_models(scene, points, parameter, distance);
    if (status == PIA_OK) status = summarise(scene, distance);
    pia_give(context, parameter);
    pia_give(context, distance);
    return status;
}

static pia_status sample_models(pia_scene *scene, const pia_model *const *models, pia_index count, pia_index most)
{
    scene->figure = pia_take_zero(scene->context, count, sizeof *scene->figure);
    if (scene->figure == NULL) return PIA_E_MEMORY;
    for (pia_index f = 0; f < count; f++) {
        pia_figure *figure = &scene->figure[f];
        pia_status status = pia_figure_take(scene->context, models[f], most, scene->options.comb, figure);
        if (status != PIA_OK) return status;
        scene->figure_count++;
        scene->surface |= figure->info.directions == 2;
        scene->space |= figure->info.directions == 2 || figure->info.dim > 2;
    }
    return PIA_OK;
}

pia_status pia_scene_take(pia_context *context, const pia_model *const *models, pia_index model_count, const double *points,
                          pia_index count, const pia_plot_options *options, pia_index most, pia_scene *out)
{
    *out = (pia_scene){.context = context, .options = *options};
    pia_status status = sample_models(out, models, model_count, most);
    if (status == PIA_OK && count > 0) status = place_points(out, points, count);
    if (status == PIA_OK && count > 0 && options->deviation) status = take_deviations(out, points);
    if (status == PIA_OK) status = find_bounds(out);
    if (status != PIA_OK) pia_scene_give(out);
    return status;
}

void pia_scene_give(pia_scene *scene)
{
    for (pia_index f = 0; f < scene->figure_count; f++) pia_figure_give(scene->context, &scene->figure[f]);
    pia_give(scene->context, scene->figure);
    pia_give(scene->context, scene->point);
    pia_give(scene->context, scene->deviation);
    pia_give(scene->context, scene->parameter);
    pia_give(scene->context, scene->owner);
    *scene = (pia_scene){.context = scene->context};
}
