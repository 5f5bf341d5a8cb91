/* The fit: wires the stages from points to model and owns what they share. One file a stage:
 *   fit_data.c        checks, bounding box, repeated points          fit_start.c    the initial control points
 *   fit_choice.c      which method, parametrization, placement       fit_open.c     the pipeline itself; open and close
 *   fit_parameters.c  parameters of the rows                         fit_result.c   report, residuals, model
 *   fit_knots.c       knots and operators                            fit_edit.c     edits of a running fit
 *   fit_foot*.c       parameters moved to foot points                fit_call.c     the one call
 *   fit_constrain.c   points and derivatives met exactly             fit_outcome.c  what is worth saying of the result
 *   fit_robust.c      weights of a robust loss                       fit_epia.c     groups and knot insertion of [2011]
 *   fit_noise.c       a tolerance that the noise suggests            fit_dominant.c Park's dominant columns
 *   fit_tolerance.c   what rows and components may deviate           fit_between.c  a curve between its points
 *   sequence*.c       control points that stand for data lines       fit_corners.c  corners, found or given
 *   fit_support.c     control points that the data do not hold        fit_correct.c  rounds of parameter correction
 *   refine*.c         knots for a tolerance                          fit_options.c  defaults, ranges, sentences of options */
#ifndef PIA_FIT_FIT_H
#define PIA_FIT_FIT_H

#include "cloud.h"
#include "normal.h"
#include "notes.h"
#include "param.h"
#include "place.h"
#include "solve.h"
#include "summary.h"

/* A constraint as asked, its value copied. */
typedef struct pia_fit_constraint {
    pia_constraint asked; /* value is NULL here */
    double *value;        /* [dim]; NULL: the data point */
    int released;
} pia_fit_constraint;

/* A robust loss and the weights it gives. */
typedef struct pia_robust {
    enum { PIA_LOSS_NONE, PIA_LOSS_HUBER, PIA_LOSS_TUKEY } loss;
    double tuning;
    int convex;                /* 1: Tukey's loss is still led by Huber's */
    int settled;               /* 1: the weights are those of the current iterate */
    pia_index round, outliers; /* rounds done; rows of less than half weight */
    pia_index rows;
    double *weight;  /* [rows] factor in [0, 1] on the given weights */
    double *product; /* [rows] both, for the operator */
} pia_robust;

/* Of growth that refines: whether it still helps. */
typedef struct pia_watch {
    double worst, squares; /* when it last did */
    pia_index controls;    /* then; 0: no round yet */
} pia_watch;

/* How far a refinement is, across its pauses. */
typedef struct pia_stage {
    pia_watch watch;   /* scattered points */
    pia_index sparing; /* rounds of sparing */
    int spares;        /* 0: the last of them took nothing away */
    int feet;          /* 0: the last move to foot points brought nothing */
    pia_stop settled;  /* how it ended; PIA_STOP_NONE: not yet */
} pia_stage;

struct pia_fit {
    pia_context *context;
    pia_fit_options options; /* texts and arrays of it are valid during open only */
    int borrowed;            /* points are the caller's until the fit is closed */
    int careful;             /* 1: data are checked before they are used, and control points are numbers before the first step */

    pia_kind kind;
    int was_grid; /* 1: scattered rows are those of a grid, whose parameters have moved */
    int directions;
    int dim; /* components that are fitted: one less than the data's for function graphs */
    int function_graph;
    const double *points; /* [count[0] x count[1] x dim] rows used */
    double *own_points;   /* the same when the fit owns them; NULL when borrowed */
    pia_index count[2], rows;
    pia_index given;    /* rows of the data as given */
    pia_index *row;     /* [rows] data row of each row used; NULL: the same */
    pia_index *dropped; /* [dropped_count] data rows not used */
    pia_index dropped_count;
    double *weights;                        /* [rows]; NULL: 1 */
    double *tolerances, *inverse_tolerance; /* [rows] what each row may deviate; NULL: the option for all */
    double *axis_tolerances;                /* [dim] what each component may deviate beside that; NULL: no such limits */
    int has_holes;
    int unseen; /* 1: nobody has looked at the points yet: no origin, no extent; and the parameters given of a curve may not be in order
                 */
    double origin[PIA_MAX_DIM], low[PIA_MAX_DIM], high[PIA_MAX_DIM];
    double extent; /* of what is fitted */

    int square; /* interpolation */
    int degree[2], closed[2];
    const pia_parametrization *parametrization; /* NULL: given, or of a cloud */
    const pia_cloud *cloud;                     /* of scattered points; NULL: given, or still to be chosen */
    const pia_placement *placement;             /* NULL: given */
    double *parameter[2];                       /* [count] a direction; scattered: u,v pairs in [0]; owned unless borrowed_parameters */
    int borrowed_parameters;
    int parameters_moved; /* they are foot points now */
    double *knots[2];     /* [full + degree + 1] */
    pia_index full[2];
    pia_map map[2];
    pia_index offset[2];

    pia_collocation line[2];
    pia_op *op;
    pia_iterate iterate;
    pia_normal *normal;            /* of the data; iterate.normal may wrap it with soft constraints */
    struct pia_sequence *sequence; /* control parameters: knots at dominant points, method epia; NULL: neither */
    struct pia_constraints *soft_constraints;
    pia_fit_constraint *constraint; /* [constraint_count], the caller's ids */
    pia_index constraint_count, constraint_room;
    pia_solve solve;
    pia_values method_values, limiter_values;
    pia_index *unsupported; /* [unsupported_count] unknowns that the data do not hold; NULL: none */
    pia_index unsupported_count;
    double pull, *pull_start; /* what holds them, see pia_addition */
    pia_robust robust;
    pia_notes notes, outcome;        /* what was done; what is to be said of the current result, after the other notes */
    int refining;                    /* knots are still to be found for a tolerance */
    pia_index round;                 /* rounds of growing, sparing, correcting */
    pia_index *corner, corner_count; /* rows used that are corners, rising, without the ends */
    pia_index *corner_row;           /* [corner_rows] data rows of corners, rising, and where a closed curve was opened */
    pia_index corner_rows;           /* 0: none */
    int pinned;                      /* 1: the ends of the curve are the first and the last row */
    pia_index refined_until;         /* of a refinement: the iteration at which it pauses */
    int paused;                      /* 1: it did, with work left */
    int lost;                        /* 1: memory ran out in the middle of a change */
    pia_stage stage;
    double *relaxed;        /* of a refinement: where the last search by relaxation came to, [rows x dim]; NULL: none yet */
    double relaxation;      /* rows passed over by all of them, which is limited */
    int factored;           /* of a refinement: 1: the equations have factors; 2: and those of data and constraints together */
    double began;           /* of a refinement: when it would have begun if it had not been interrupted */
    double *all_parameters; /* of a grid, u then v, once asked for; NULL before */
    double seconds;         /* spent in opening */
    double between_error;   /* of a curve between its rows, see pia_report */
};

/* Whether numbers and counts of the options are in their ranges. */
pia_status pia_fit_check_options(pia_fit *fit, int directions);
/* Leaves the points of an open curve with given parameters unseen: the pass that sums them may look at them as well. Those of such a
 * grid too, unless the fit is careful. */
pia_status pia_fit_take_data(pia_fit *fit, const pia_data *data);
/* The tolerances of points and axes; options.tolerance becomes the largest that a row has where it was not asked. */
pia_status pia_fit_take_tolerances(pia_fit *fit, const double *tolerances);
/* Other tolerances of axes for a running fit, "T1,T2,..." or "none"; the tolerance becomes the radius of the ball around their box. */
pia_status pia_fit_set_axes(pia_fit *fit, const char *text);
/* Whether a distance, the same for every row, is all that the tolerance asks. */
int pia_fit_is_tolerance_alike(const pia_fit *fit);
/* Whether every row keeps its tolerance, on a tolerance that is not the same for all; residuals are made anew. For rules.keeps. */
int pia_fit_keeps_tolerances(pia_iterate *iterate);
/* The largest deviation of each component [dim], from the residuals; returns the one that takes most of its tolerance. */
int pia_fit_axis_errors(const pia_fit *fit, double *out);
/* How far a curve may be from the straight line in the gap behind a row: `factor` tolerances, and what the bend of the points explains.
 */
double pia_fit_swing(const pia_fit *fit, pia_index row, double factor);
/* How far it is, of full control points, *span being one at or before the row, which it then is; -1 where the gap is narrow beside the
 * span. */
double pia_fit_excursion(const pia_fit *fit, const double *full, pia_index row, pia_index *span);
/* Measures a refined curve between its rows, and notes where it is far off. */
void pia_fit_look_between(pia_fit *fit);
/* Notes the axes that do not keep their tolerance. */
void pia_fit_describe_axes(pia_fit *fit);
/* Looks at points that no such pass will see. Errors: PIA_E_DATA, also for a grid with holes, which a careful fit expects. */
pia_status pia_fit_see(pia_fit *fit);
/* The `look` of a normal form, owner a fit: that pass's findings become origin and extent, or an error that names the row. */
struct pia_survey;
pia_status pia_fit_look(void *owner, const struct pia_survey *survey);
pia_status pia_fit_choose(pia_fit *fit);
/* The names of what was chosen, into a report. */
void pia_fit_names(const pia_fit *fit, pia_report *report);
/* Corners of a curve that is to be refined; a closed one is opened at its first corner. Before its parameters are computed. */
pia_status pia_fit_take_corners(pia_fit *fit);
pia_status pia_fit_parametrize(pia_fit *fit, const pia_data *data);
/* The error of given parameters [count] that are not good. */
pia_status pia_fit_refuse_parameters(pia_fit *fit, const double *given, int direction, pia_index count);
/* Which base surface suits scattered points best: fit->cloud. Errors: PIA_E_DATA where none does. */
pia_status pia_fit_choose_base(pia_fit *fit);
pia_status pia_fit_place(pia_fit *fit);
pia_status pia_fit_operate(pia_fit *fit);
/* Whether the operator's interpolating curve is found in one step, from data to control points, and nobody asks for what was before. */
int pia_fit_is_one_step(const pia_fit *fit);
/* Whether such a fit, before it has an operator, leaves it to that step to look at the data, on knots that were given. */
int pia_fit_is_trusting(const pia_fit *fit);
/* Operator, normal form and iterate for the current knots, in place of the ones before; control points undefined. */
pia_status pia_fit_assemble(pia_fit *fit);
/* The same when rows, weights or parameters have changed: control points, frozen ones included, stay; the method begins anew. */
pia_status pia_fit_reassemble(pia_fit *fit);
pia_status pia_fit_initial(pia_fit *fit);
/* Whether the method moves control points by groups of data; whether control points stand for data lines: that, or knots placed by
 * curvature. */
int pia_fit_is_grouped(const pia_fit *fit);
int pia_fit_by_line(const pia_fit *fit);
/* The default of stop_change, in units of the extent. */
#define PIA_FIT_CHANGE 1e-14
/* Room for the knots of `full` control points in a direction, which it then has. */
pia_status pia_fit_take_knots(pia_fit *fit, int direction, pia_index full);
/* Whether that many control points suit degree and data. */
pia_status pia_fit_check_control(pia_fit *fit, int direction, pia_index control);
/* The row used for a data row; a dropped row stands for the one it repeats: the first one for a closed curve's last, else the one
 * before. -1: no such row. */
pia_index pia_fit_row(const pia_fit *fit, pia_index data_row);
/* Knots, and control points, of a model in place of the current ones; between the two calls the fit is assembled. */
pia_status pia_fit_adopt_knots(pia_fit *fit, const pia_model *start);
pia_status pia_fit_adopt_control(pia_fit *fit, const pia_model *start);
/* Rows of a closed direction in the order in which the domain of its knots meets them. */
pia_status pia_fit_turn(pia_fit *fit, int direction);
/* Rounds of parameter correction after a least-squares fit of a curve has ended, and whether they are wanted and due. */
int pia_fit_wants_correction(const pia_fit *fit);
pia_status pia_fit_correct(pia_fit *fit);
/* Moves the parameters of a curve to the closest points of the iterate nearby, never past the middle to a neighbour. */
pia_status pia_fit_project(pia_iterate *iterate);
/* The same for scattered rows, never past a fold of the surface; the operator is stale until the fit is assembled again. */
pia_status pia_fit_project_surface(pia_iterate *iterate);
/* Numbers in the parameters: one a row, of a grid one a line, of scattered rows two. */
pia_index pia_fit_parameter_count(const pia_fit *fit);
/* Parameters and control points to come back to, and the weighted squares they leave. Errors: PIA_E_MEMORY, with nothing to drop. */
typedef struct pia_fit_kept {
    double *parameters, *points;
    double squares;
} pia_fit_kept;
pia_status pia_fit_keep(pia_fit *fit, pia_fit_kept *kept);
/* Parameters, then `assemble`, then control points. */
pia_status pia_fit_take_back(pia_fit *fit, const pia_fit_kept *kept, pia_status (*assemble)(pia_fit *fit));
void pia_fit_keep_drop(pia_fit *fit, pia_fit_kept *kept);

/* Opens without a copy of the data where the method allows: data outlives the fit. Unless it is to be careful, the start may be left
 * out, and the check of the data left to the solve, which then fails with the points still unseen where it cannot go on, or to the
 * sums: a grid with holes is then PIA_E_DATA. */
pia_status pia_fit_borrow(pia_context *context, const pia_data *data, const pia_fit_options *options, int careful, pia_fit **out);

/* pia_fit_report without a pass over the data: errors are NAN, and their row -1, where they are not known. */
void pia_fit_tell(pia_fit *fit, pia_report *out);
/* pia_fit_model for a fit that can only be closed afterwards: its arrays become the model's where they can. Errors that nobody has
 * asked for yet are not measured for it. */
pia_status pia_fit_turn_into_model(pia_fit *fit, pia_model **out);

/* The constraints of the options; then the rows that the list makes on the current operator (bind), and their end. */
pia_status pia_fit_take_constraints(pia_fit *fit);
/* One more on the list, and those of a join. */
pia_status pia_fit_add_constraint(pia_fit *fit, const pia_constraint *given);
pia_status pia_fit_add_join(pia_fit *fit, const pia_join *given);
pia_status pia_fit_bind(pia_fit *fit);
void pia_fit_unbind(pia_fit *fit);
void pia_fit_constraints_close(pia_fit *fit);
/* iterate.constraint_error of the current control points. */
void pia_fit_measure_constraints(pia_fit *fit);
/* PIA_E_MEMORY for a fit that a change has left in pieces, because memory ran out. */
pia_status pia_fit_whole(const pia_fit *fit);
/* The outcome of a change, which is remembered where it may have left pieces. */
pia_status pia_fit_changed(pia_fit *fit, pia_status status);
/* After an edit: the loop starts over from the current iterate. */
pia_status pia_fit_restart(pia_fit *fit);

/* Adds a note; memory that is too short for a note is not an error. */
void pia_fit_note_add(pia_fit *fit, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The robust loss of the options; then its weights for the current rows, 1 where there are none yet, and their end. */
pia_status pia_fit_choose_loss(pia_fit *fit);
pia_status pia_fit_take_loss(pia_fit *fit);
void pia_fit_robust_close(pia_fit *fit);
/* Weights [rows] for the operator, NULL: 1; they follow the given ones and those of the loss when mixed. */
const double *pia_fit_row_weights(const pia_fit *fit);
void pia_fit_mix_weights(pia_fit *fit);
/* As pia_solve_step, in rounds between which rows are weighed anew. */
pia_status pia_fit_robust_step(pia_fit *fit, pia_index iterations);
/* Notes constraints on a direction that the curve meets in the opposite sense. */
void pia_fit_describe_directions(pia_fit *fit);
void pia_fit_describe_outliers(pia_fit *fit);
/* Points or weights of these rows have changed: normal form and constraints follow. */
pia_status pia_fit_refresh(pia_fit *fit, pia_index first_row, pia_index last_row);

/* Once the start is known: which control points the data do not hold, and, without fairing, what holds them; and its end. */
pia_status pia_fit_support(pia_fit *fit);
void pia_fit_support_close(pia_fit *fit);
void pia_fit_describe_support(pia_fit *fit);
/* The normal form of the data anew, with fairing and pull; not wrapped with soft constraints. */
pia_status pia_fit_open_normal(pia_fit *fit);

enum { PIA_LISTED = 20 }; /* indices that a note lists at most */
/* The outcome anew: inflections where a limiter ran, outliers, control points without hold. Memory that is too short for a note is not
 * an error. */
void pia_fit_conclude(pia_fit *fit);
/* A note of the outcome: "COUNT TEXT: ", then the first PIA_LISTED of list [count]. */
void pia_fit_outcome_add(pia_fit *fit, const char *text, const pia_index *list, pia_index count);
/* A model of the current iterate without what it came from. */
pia_status pia_fit_bare_model(pia_fit *fit, pia_model **out);

/* Makes points and the row numbers the fit's own, so that rows can be dropped or turned. */
pia_status pia_fit_own_rows(pia_fit *fit);
/* Drops rows of a curve or scattered set (keep [rows] 0 or 1), recording them; the points become the fit's own. */
pia_status pia_fit_drop_rows(pia_fit *fit, const unsigned char *keep);
/* The same for whole lines of a grid in one direction. */
pia_status pia_fit_drop_lines(pia_fit *fit, int direction, const unsigned char *keep);

#endif
