#include "io.h"

enum { PER_SPAN = 16, MOST_ON_CURVE = 20000, MOST_A_DIRECTION = 500, LEAST = 64 };

/* Enough for a picture: some for every span. */
static pia_index samples_for_picture(const pia_model *model, int direction)
{
    pia_index most = model->directions == 1 ? MOST_ON_CURVE : MOST_A_DIRECTION;
    pia_index spans = model->control[direction] - model->degree[direction];
    pia_index wanted = spans > most / PER_SPAN ? most : PER_SPAN * spans + 1;
    return wanted > LEAST ? wanted : LEAST;
}

static double parameter_at(const pia_model *model, int direction, pia_index i, pia_index count)
{
    const double *knots = model->knots[direction];
    double first = knots[model->degree[direction]], last = knots[model->control[direction]];
    double share = (double)i / (double)(count - 1);
    return i == count - 1 ? last : first + share * (last - first);
}

static void fill_parameters(const pia_model *model, const pia_index count[2], double *parameters)
{
    for (pia_index i = 0; i < count[0]; i++) {
        for (pia_index j = 0; j < count[1]; j++) {
            *parameters++ = parameter_at(model, 0, i, count[0]);
            if (model->directions == 2) *parameters++ = parameter_at(model, 1, j, count[1]);
        }
    }
}

pia_status pia_model_sample(pia_context *context, const pia_model *model, pia_index samples, double **parameters, double **points,
                            pia_index count[2])
{
    pia_index size[2] = {1, 1}, total, values;
    for (int d = 0; d < model->directions; d++) size[d] = samples == PIA_AUTO ? samples_for_picture(model, d) : samples;
    if (size[0] < 2 || (model->directions == 2 && size[1] < 2))
        return pia_fail(context, PIA_E_ARGUMENT, "%lld samples a direction; ask for at least 2", (long long)samples);
    if (!pia_multiply(size[0], size[1], &total) || !pia_multiply(total, model->dim + model->directions, &values))
        return pia_fail(context, PIA_E_SIZE, "%lld samples a direction do not fit in 64 bits; ask for fewer", (long long)samples);
    double *u = pia_take(context, total * model->directions, sizeof *u);
    if (u == NULL) return pia_take_status(context, total * model->directions, sizeof *u);
    double *x = pia_take(context, total * model->dim, sizeof *x);
    pia_status status = PIA_OK;
    if (x == NULL) {
        status = pia_take_status(context, total * model->dim, sizeof *x);
    } else {
        fill_parameters(model, size, u);
        status = pia_model_eval(context, model, u, total, 0, x);
    }
    if (status != PIA_OK) {
        pia_give(context, u);
        pia_give(context, x);
        return status;
    }
    *parameters = u;
    *points = x;
    count[0] = size[0];
    count[1] = size[1];
    return PIA_OK;
}
