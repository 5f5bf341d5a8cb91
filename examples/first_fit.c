/* From points to a model: fit a curve through points of a spiral, ask how good it is, evaluate it, write it. */
#include <math.h>
#include <pia/pia.h>
#include <stdio.h>

enum { COUNT = 100 };

int main(void)
{
    double points[COUNT][2];
    for (int i = 0; i < COUNT; i++) {
        points[i][0] = (1 + 0.05 * i) * cos(0.2 * i);
        points[i][1] = (1 + 0.05 * i) * sin(0.2 * i);
    }
    pia_data data;
    pia_data_init(&data);
    data.points = &points[0][0];
    data.count[0] = COUNT;
    data.dim = 2;

    pia_context *context = NULL;
    pia_model *model = NULL;
    pia_report report = {.struct_size = sizeof report};
    double middle[2];
    pia_status status = pia_context_create(NULL, &context);
    if (status == PIA_OK) status = pia_fit_data(context, &data, NULL, &model, &report);
    if (status == PIA_OK) status = pia_model_eval(context, model, &(double){0.5}, 1, 0, middle);
    if (status == PIA_OK) status = pia_model_write(context, "spiral.json", NULL, (const pia_model *const *)&model, 1, PIA_AUTO);
    if (status == PIA_OK)
        printf("%s: largest error %.3g after %lld iterations, middle at (%.4f, %.4f)\n", report.method, report.max_error,
               (long long)report.iterations, middle[0], middle[1]);
    else
        fprintf(stderr, "%s: %s\n", pia_strerror(status), pia_message(context));
    pia_model_destroy(model);
    pia_context_destroy(context);
    return status != PIA_OK;
}
