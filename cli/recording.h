/* What a report replays: models on the way of a fit, and the history of its errors. */
#ifndef PIA_CLI_RECORDING_H
#define PIA_CLI_RECORDING_H

#include "session.h"

enum { RECORDED_FRAMES = 24 };

/* Frames are spaced by logarithm while the end is not known: after each, the next one is due when the iteration has grown by `ratio`;
 * when there is no room, every second one is dropped and the ratio squared. All zero but `ratio` at the start. */
struct recording {
    pia_model *frame[RECORDED_FRAMES]; /* the last one is the model of the last look */
    pia_index frame_count;
    double ratio;
    pia_trace_row *row; /* [row_count], one a look; kept by the session */
    pia_index row_count, row_room;
    const pia_index *unsupported; /* [unsupported_count] of the last look; kept by the session */
    pia_index unsupported_count;
    const pia_index *corners; /* [corner_count] data rows, as unsupported */
    pia_index corner_count;
    const double *parameters; /* see fit_parameters; of the end */
};

void recording_open(struct recording *recording);
void recording_close(struct recording *recording);
/* Records the state of a fit, as `report` tells it. */
pia_status recording_look(struct recording *recording, struct session *session, pia_fit *fit, const pia_report *report);
/* Iterations from `iteration` to the next look. */
pia_index recording_due(const struct recording *recording, pia_index iteration);

#endif
