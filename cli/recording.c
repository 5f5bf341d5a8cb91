#include "recording.h"

#include <math.h>
#include <string.h>

static const double first_ratio = 1.25;

void recording_open(struct recording *recording)
{
    *recording = (struct recording){.ratio = first_ratio};
}

void recording_close(struct recording *recording)
{
    for (pia_index k = 0; k < recording->frame_count; k++) pia_model_destroy(recording->frame[k]);
    recording->frame_count = 0;
}

pia_index recording_due(const struct recording *recording, pia_index iteration)
{
    double next = ceil((double)iteration * recording->ratio);
    return next > (double)iteration + 1 ? (pia_index)next - iteration : 1;
}

/* Every second frame goes, the first and the last stay. */
static void thin(struct recording *recording)
{
    pia_index stay = 0;
    for (pia_index k = 0; k < recording->frame_count; k++) {
        if (k % 2 == 0 || k + 1 == recording->frame_count)
            recording->frame[stay++] = recording->frame[k];
        else
            pia_model_destroy(recording->frame[k]);
    }
    recording->frame_count = stay;
    recording->ratio *= recording->ratio;
}

static void add_row(struct recording *recording, struct session *session, const pia_report *report)
{
    if (recording->row_count == recording->row_room) {
        recording->row_room = 2 * recording->row_room + 64;
        pia_trace_row *row = session_keep(session, (size_t)recording->row_room, sizeof *row);
        if (recording->row_count) memcpy(row, recording->row, (size_t)recording->row_count * sizeof *row);
        recording->row = row;
    }
    recording->row[recording->row_count++] = (pia_trace_row){.iteration = report->iterations,
                                                             .control_count = report->control_count,
                                                             .max_error = report->max_error,
                                                             .rms_error = report->rms_error,
                                                             .adjust_max = NAN,
                                                             .constraint_error = report->constraint_error,
                                                             .seconds = report->seconds};
}

static const pia_index *copy_of(struct session *session, const pia_index *list, pia_index count)
{
    size_t bytes = (size_t)count * sizeof *list;
    return count ? memcpy(session_keep(session, 1, bytes), list, bytes) : NULL;
}

/* The lists are the fit's own, and gone after the next edit. */
static pia_status copy_lists(struct recording *recording, struct session *session, pia_fit *fit)
{
    pia_status status = pia_fit_unsupported(fit, &recording->unsupported, &recording->unsupported_count);
    if (status == PIA_OK) status = pia_fit_corners(fit, &recording->corners, &recording->corner_count);
    if (status != PIA_OK) return status;
    recording->unsupported = copy_of(session, recording->unsupported, recording->unsupported_count);
    recording->corners = copy_of(session, recording->corners, recording->corner_count);
    return status;
}

pia_status recording_look(struct recording *recording, struct session *session, pia_fit *fit, const pia_report *report)
{
    pia_model *model = NULL;
    pia_status status = report->stop != PIA_STOP_NONE ? copy_lists(recording, session, fit) : PIA_OK;
    int known = recording->row_count && recording->row[recording->row_count - 1].iteration == report->iterations;
    if (status == PIA_OK && !known) status = pia_fit_model(fit, &model);
    if (status != PIA_OK || known) return status;
    if (recording->frame_count == RECORDED_FRAMES) thin(recording);
    recording->frame[recording->frame_count++] = model;
    add_row(recording, session, report);
    return PIA_OK;
}
