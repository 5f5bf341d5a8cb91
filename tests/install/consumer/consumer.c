#include <pia/pia.h>
#include <stdio.h>

int main(void)
{
    const double points[] = {0, 0, 1, 1, 2, 4, 3, 9, 4, 16};
    pia_context *context;
    pia_model *model;
    pia_data data;
    pia_data_init(&data);
    data.points = points;
    data.count[0] = 5;
    data.dim = 2;
    if (pia_context_create(NULL, &context) != PIA_OK || pia_fit_data(context, &data, NULL, &model, NULL) != PIA_OK) return 1;
    double end[2];
    if (pia_model_eval(context, model, &(double){1}, 1, 0, end) != PIA_OK) return 1;
    printf("pia %s: the curve ends at (%g, %g)\n", pia_version(), end[0], end[1]);
    pia_model_destroy(model);
    pia_context_destroy(context);
    return end[0] < 3.999 || end[1] < 15.999;
}
