/* The progressive service: a least-squares curve through 10,000 points is open, one point is dragged, and the curve follows at once.
 * Shows how few control points move, how long it takes, and that working on the neighbourhood alone gives the same curve. */
#include <math.h>
#include <pia/pia.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROWS = 10000, CONTROL = 300, EDITED = 6180, NEIGHBOURS = 8 };

static double points[ROWS * 2], before[CONTROL * 2], after[CONTROL * 2], local[CONTROL * 2];

static double milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static void check(pia_context *context, pia_status status)
{
    if (status == PIA_OK) return;
    fprintf(stderr, "%s\n", pia_message(context));
    exit(1);
}

static void control_points(pia_context *context, pia_fit *fit, double *out)
{
    pia_model *model;
    check(context, pia_fit_model(fit, &model));
    pia_model_control(model, out, NULL);
    pia_model_destroy(model);
}

static int moved(const double *now, double threshold, int *nearest)
{
    int count = 0;
    double most = 0;
    for (int i = 0; i < CONTROL; i++) {
        double d = hypot(now[2 * i] - before[2 * i], now[2 * i + 1] - before[2 * i + 1]);
        if (d > most) {
            most = d;
            *nearest = i;
        }
        count += d > threshold;
    }
    return count;
}

int main(void)
{
    pia_context *context;
    check(NULL, pia_context_create(NULL, &context));
    for (int i = 0; i < ROWS; i++) {
        double a = 6.283185307179586 * i / (ROWS - 1);
        points[2 * i] = (3 + cos(7 * a)) * cos(0.95 * a);
        points[2 * i + 1] = (3 + sin(5 * a)) * sin(0.95 * a);
    }
    pia_data data;
    pia_fit_options options;
    pia_fit *fit;
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = ROWS;
    data.dim = 2;
    options.control[0] = CONTROL;
    check(context, pia_fit_open(context, &data, &options, &fit));
    check(context, pia_fit_run(fit, NULL));
    control_points(context, fit, before);

    /* Drag one point by 0.5: only the spans it touches are summed anew, then one banded solve. */
    double dragged[2] = {points[2 * EDITED] + 0.5, points[2 * EDITED + 1]};
    double start = milliseconds();
    check(context, pia_fit_move_point(fit, EDITED, dragged));
    check(context, pia_fit_run(fit, NULL));
    double whole = milliseconds() - start;
    control_points(context, fit, after);
    int nearest = 0;
    printf("%d points, %d control points; point %d moved by 0.5\n", ROWS, CONTROL, EDITED);
    printf("control points that moved by more than 1e-3: %d, 1e-4: %d, 1e-6: %d, 1e-9: %d\n", moved(after, 1e-3, &nearest),
           moved(after, 1e-4, &nearest), moved(after, 1e-6, &nearest), moved(after, 1e-9, &nearest));
    printf("edit and solve: %.3f ms\n", whole);

    /* Back, and again with all but the neighbourhood frozen. */
    check(context, pia_fit_move_point(fit, EDITED, points + 2 * EDITED));
    check(context, pia_fit_run(fit, NULL));
    pia_index frozen[CONTROL], count = 0;
    for (int i = 0; i < CONTROL; i++)
        if (abs(i - nearest) > NEIGHBOURS) frozen[count++] = i;
    start = milliseconds();
    check(context, pia_fit_freeze(fit, frozen, count, 1));
    check(context, pia_fit_move_point(fit, EDITED, dragged));
    check(context, pia_fit_run(fit, NULL));
    double few = milliseconds() - start;
    control_points(context, fit, local);
    double worst = 0;
    for (int i = 0; i < 2 * CONTROL; i++) worst = fmax(worst, fabs(local[i] - after[i]));
    printf("with %d of %d control points free: %.3f ms, largest difference to the whole solve %.1e\n", CONTROL - (int)count, CONTROL,
           few, worst);
    pia_fit_close(fit);
    pia_context_destroy(context);
    return worst < 1e-4 ? 0 : 1;
}
