/* libpia: B-spline and NURBS curves and surfaces fitted to points by progressive-iterative approximation.
 *
 * The header follows a fit from input to output: context, points, options, the one call, the progressive
 * service, models, files, pictures. Read it once from top to bottom.
 *
 * Conventions, valid for every declaration:
 *   - Calls that can fail return a pia_status; PIA_OK is 0. Outputs come last and are untouched on failure
 *     unless a declaration says otherwise. pia_message(context) tells what, where and what to do.
 *   - Arrays are borrowed for the duration of the call and never modified, unless a declaration says otherwise.
 *   - A point array is row-major, [count x dim] doubles. "Extent" is the diagonal of a bounding box.
 *   - Structs with a struct_size member are filled by their init function; then members are changed by name.
 *     Zero means zero; PIA_AUTO means "the library chooses, and the report says what it took".
 *   - A context serves one thread at a time. A model is immutable and may be read by any number of threads, each
 *     with its own context. Everything created with a context is destroyed before the context.
 *   - Destroy functions accept NULL. Degrees are degrees, never orders. Indices count from 0.
 *   - Methods are cited by paper: [2004] Lin, Wang, Dong, "Constructing iterative non-uniform B-spline curve and
 *     surface to fit data points"; [2011] Lin, Zhang, "An extended iterative format for the progressive-iteration
 *     approximation"; [2014] Deng, Lin, LSPIA; [2023] CLSPIA. docs/methods has one page for each. */
#ifndef PIA_PIA_H
#define PIA_PIA_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

/* ------------------------------------------------------------------------------------------------ basics ---- */

typedef int64_t pia_index;              /* counts, indices, offsets */
typedef struct pia_context pia_context; /* threads, backend, allocator, log, last message */
typedef struct pia_model pia_model;     /* an immutable B-spline or NURBS curve or surface */
typedef struct pia_fit pia_fit;         /* one problem being iterated */
typedef struct pia_points pia_points;   /* points read from a file */

enum { PIA_AUTO = -1 }; /* "chosen by the library" for counts, degrees, thresholds */
enum { PIA_MAX_DEGREE = 25, PIA_MAX_DIM = 16 };

/* What a call answers. */
typedef enum pia_status {
    PIA_OK,
    PIA_E_ARGUMENT,    /* an argument is out of its range or names something unknown; also pairs that make no sense */
    PIA_E_SHAPE,       /* counts or dimensions do not fit together */
    PIA_E_DATA,        /* the points cannot be fitted: not finite, too few, all equal, ... */
    PIA_E_CONSTRAINT,  /* constraints contradict each other or are more than the space can hold */
    PIA_E_MEMORY,      /* the allocator returned NULL */
    PIA_E_SIZE,        /* a product of sizes does not fit in 64 bits */
    PIA_E_UNAVAILABLE, /* this build or this machine lacks the part that was asked for */
    PIA_E_FORMAT,      /* a file does not hold what its format promises */
    PIA_E_FILE,        /* the operating system refused a file */
    PIA_E_INTERNAL     /* a defect of the library */
} pia_status;

/* Why an iteration ended. Not an error: the model is valid whatever the reason. */
typedef enum pia_stop {
    PIA_STOP_NONE,         /* still running */
    PIA_STOP_TOLERANCE,    /* the largest deviation is at most the tolerance */
    PIA_STOP_CHANGE,       /* no control point moves more than stop_change */
    PIA_STOP_GRADIENT,     /* the relative gradient is at most stop_gradient */
    PIA_STOP_ITERATIONS,   /* max_iterations were done */
    PIA_STOP_TIME,         /* time_limit passed */
    PIA_STOP_CANCELLED,    /* the progress callback asked to stop */
    PIA_STOP_STALLED,      /* steps no longer reduce the error: limiter, condition or rounding */
    PIA_STOP_FINITE,       /* the method is direct and done */
    PIA_STOP_NO_KNOT_LEFT, /* the tolerance needs knots that the data cannot hold */
    PIA_STOP_INFEASIBLE    /* constraints and shape limiter leave no step */
} pia_stop;

/* How the points are ordered: along a curve, as a grid, or not at all. */
typedef enum pia_kind { PIA_CURVE, PIA_GRID, PIA_SCATTERED } pia_kind;

/* One fixed sentence for a status; never NULL. */
const char *pia_strerror(pia_status status);
/* The word that cli.md and the JSON reports use for a stop reason ("tolerance", "change", ...); "none" while running. */
const char *pia_stop_name(pia_stop stop);
/* Version of the library, "major.minor.patch". */
const char *pia_version(void);

/* ----------------------------------------------------------------------------------------------- context ---- */

/* How a context works. */
typedef struct pia_context_options {
    size_t struct_size;
    int threads;         /* 1 to 1024; PIA_AUTO: as many as the machine has, used only where they pay */
    const char *backend; /* a name of the registry "backend"; NULL: the best available */
    void *(*allocate)(void *user, size_t size, size_t align); /* NULL: the C library's. size > 0, align a power of two up to 64 */
    void (*release)(void *user, void *block);                 /* must be given with allocate; block may be NULL */
    void (*log)(void *user, int level, const char *text);     /* level 0 detail, 1 information, 2 warning; NULL: silent */
    void *user;                                               /* handed to the calls of this struct */
    int (*interrupted)(void *user); /* asked at least once an iteration or round of every fit, costs nothing else; non-zero stops
                                       the fit, which keeps its model with PIA_STOP_CANCELLED. NULL: never */
} pia_context_options;

/* The defaults: as many threads as pay, best backend, the C library's memory, silent. Of that memory a context keeps
 * released blocks of 128 kB and more, at most 32 and 512 MB in all, for the next call: what was touched before is several times faster
 * than fresh memory. Those of 4 MB and more are marked free (MADV_FREE), so that the kernel takes them where it needs memory. */
void pia_context_options_init(pia_context_options *options);
/* options NULL: defaults. Errors: PIA_E_ARGUMENT, PIA_E_UNAVAILABLE (backend), PIA_E_MEMORY. */
pia_status pia_context_create(const pia_context_options *options, pia_context **out);
/* After everything created with it. */
void pia_context_destroy(pia_context *context);
/* Detail of the last failure in this context: one line, valid until the next call with it; "" when nothing failed. */
const char *pia_message(const pia_context *context);
/* Threads used for large work (1 to 1024, PIA_AUTO); results do not depend on it, bit for bit. */
pia_status pia_context_set_threads(pia_context *context, int threads);

/* -------------------------------------------------------------------------------------------- registries ---- */

/* One entry of a registry: "method", "parametrization", "placement", "limiter", "format", "backend", "part". */
typedef struct pia_entry {
    const char *name;      /* what options and the command line take */
    const char *title;     /* one line for people */
    const char *reference; /* key in docs/refs.bib, or NULL */
    const char *detail;    /* what it needs or can do, one line; or NULL */
} pia_entry;

/* A parameter of a method's record, given as text by pia_fit_options.method_options or pia_fit_set. */
typedef struct pia_parameter {
    const char *name;
    const char *values;  /* "column|scalar|number" for words; NULL for a plain number */
    const char *initial; /* default as text */
    double minimum, maximum;
    const char *sentence; /* what it does */
} pia_parameter;

/* Entry number `index` of a registry; returns 0 past the end or for an unknown registry, 1 otherwise. */
int pia_list(const char *registry, pia_index index, pia_entry *out);
/* Parameter number `index` of the method or limiter of this name; returns 0 past the end or for an unknown name, 1 otherwise. */
int pia_list_parameters(const char *name, pia_index index, pia_parameter *out);

/* ------------------------------------------------------------------------------------------- data to fit ---- */

/* The points and what is known about them. */
typedef struct pia_data {
    size_t struct_size;
    pia_kind kind;
    const double *points;     /* [count[0] x dim] curve and scattered; [count[0] x count[1] x dim] grid, second index fastest.
                                 A grid point with a NaN component is a hole (least-squares methods only) */
    pia_index count[2];       /* count[1] is 1 unless a grid */
    int dim;                  /* 1 to PIA_MAX_DIM */
    int function_graph;       /* curve: component 0 is the parameter (any order), the others are fitted, dim >= 2 */
    const double *parameters; /* NULL: computed. [count[0]] curve; [count[0]] u then [count[1]] v grid; [count[0] x 2] scattered */
    const double *weights;    /* NULL: 1. One a point, >= 0, not all zero */
    const double *tolerances; /* NULL: the option's. One a point in its place, units of the points, > 0 */
} pia_data;

/* Zeroes, kind PIA_CURVE, count[1] = 1. */
void pia_data_init(pia_data *data);

/* ------------------------------------------------------------------------------------ constraints, options ---- */

/* One linear condition on the model: a value or a derivative, at a data row or at a parameter. */
typedef struct pia_constraint {
    size_t struct_size;
    pia_index at_point;     /* data row; PIA_AUTO: at_parameter is used */
    double at_parameter[2]; /* in the units of the parameters used */
    int derivative[2];      /* order in u and v; {0,0} is the point itself */
    int direction_only;     /* 1: only the direction of `value` counts, the length is free */
    const double *value;    /* [dim]; NULL: the data point (value constraints at a data row only) */
} pia_constraint;

/* Zeroes, at_point = PIA_AUTO. */
void pia_constraint_init(pia_constraint *constraint);

/* An end of a curve (the first two) or an edge of a surface. */
typedef enum pia_edge { PIA_EDGE_U_START, PIA_EDGE_U_END, PIA_EDGE_V_START, PIA_EDGE_V_END } pia_edge;

/* How a model goes on from another: with the same points; also with the direction, or the whole vector, of the derivative across the
 * edge, each in its own parameter. */
typedef enum pia_continuity { PIA_CONTINUITY_C0, PIA_CONTINUITY_G1, PIA_CONTINUITY_C1 } pia_continuity;

/* Continuation of a neighbouring model of the same kind and dimension. Along the edge of a surface the conditions stand at the Greville
 * abscissas of its control points: the edges agree everywhere when the knots along them are alike, at those places otherwise. */
typedef struct pia_join {
    size_t struct_size;
    const pia_model *neighbour;    /* borrowed for the call */
    pia_edge edge, neighbour_edge; /* of what is fitted, and of the neighbour: open directions */
    int reversed;                  /* 1: the parameters along the two edges run against each other */
    pia_continuity continuity;
} pia_join;

/* The start of what is fitted goes on from the end of the neighbour: PIA_EDGE_U_START, PIA_EDGE_U_END, G1; no neighbour. */
void pia_join_init(pia_join *join);

/* State of a fit: cheap to read at any time. Counts and errors are those of the current model. */
typedef struct pia_report {
    size_t struct_size;
    pia_kind kind;
    char method[24]; /* what ran, also when "auto" chose it */
    char parametrization[24], placement[24], limiter[24];
    int degree[2];
    pia_index control[2]; /* control points a direction, of a closed one without the repeated ones; control[1] is 1 for a curve */
    pia_index control_count, point_count, iterations;
    pia_stop stop;
    int reached;                                           /* 1 or 0; PIA_AUTO: no tolerance was asked */
    double max_error;                                      /* largest deviation at the parameters used, units of the points */
    pia_index max_error_index;                             /* row of the data as given */
    double rms_error, constraint_error, relative_gradient; /* constraint_error is NAN without constraints */
    double start_error;                                    /* max_error of the initial model */
    double rate;                 /* observed factor of the error from one iteration to the next; NAN if unknown */
    int measure_distance;        /* 1: errors are true distances (foot points) */
    pia_index repaired_count;    /* rows dropped or merged; pia_model_note and pia_fit_note name them */
    pia_index unsupported_count; /* control points that no data holds */
    pia_index outlier_count;     /* rows the robust loss gave less than half weight */
    pia_index round_count;       /* rounds of knot insertion or parameter correction */
    double seconds;              /* time spent inside this fit */
    int worst_axis;              /* component that takes most of its axis tolerance; PIA_AUTO: there are none, or errors are unknown */
    double axis_error[PIA_MAX_DIM]; /* largest deviation of each component, where there are axis tolerances; else NAN */
    double between_error;           /* of a curve whose knots were found for a tolerance: how far it is from the straight line between
                                       neighbouring           points where these are far apart, at most; NAN: not measured, or still running */
} pia_report;

/* One row of the trace: the model after `iteration` updates. */
typedef struct pia_trace_row {
    pia_index iteration, control_count;
    double max_error, rms_error, adjust_max, constraint_error, seconds;
} pia_trace_row;

/* What to fit, how, and when to stop. */
typedef struct pia_fit_options {
    size_t struct_size;
    int degree[2];                     /* 1 to PIA_MAX_DEGREE; default 3, 3 */
    int closed[2];                     /* 1: periodic in that direction; a repeated last point is accepted; default 0 */
    pia_index control[2];              /* control points; PIA_AUTO: as many as the method or the tolerance needs */
    double tolerance;                  /* largest deviation wanted, units of the points; 0: none asked */
    const double *axis_tolerances;     /* what each component that is fitted may deviate, > 0; each point keeps both, these and its own
                                          (or the option's) tolerance */
    pia_index axis_tolerance_count;    /* as many as components are fitted; 0: none asked */
    int measure_distance;              /* 1: the tolerance and the report measure true distance */
    const char *method;                /* registry "method"; NULL: "auto" */
    const char *const *method_options; /* [method_option_count] texts "name=value" */
    pia_index method_option_count;
    const char *parametrization;        /* registry "parametrization"; NULL: chord, or the method's own */
    const char *placement;              /* registry "placement"; NULL: the method's own */
    const char *limiter;                /* registry "limiter"; NULL: none */
    const char *const *limiter_options; /* [limiter_option_count] texts "name=value" */
    pia_index limiter_option_count;
    const double *knots[2]; /* NULL: placed. Full knot vector, knot_count values */
    pia_index knot_count[2];
    const pia_model *start;       /* NULL: the method's own start; else its knots, degrees and control points are iterate 0 */
    const pia_index *interpolate; /* data rows met exactly */
    pia_index interpolate_count;
    const pia_constraint *constraints;
    pia_index constraint_count;
    const pia_join *joins;
    pia_index join_count;
    double soft;             /* > 0: constraints become least-squares rows of this weight; 0: hard */
    const pia_index *freeze; /* control points that stay, row-major index */
    pia_index freeze_count;
    double fairing;           /* weight of the fairing energy, relative: 1 makes it as strong as the data; 0: none */
    const char *robust;       /* NULL, "huber" or "tukey" */
    double robust_scale;      /* tuning constant; PIA_AUTO: 1.345 and 4.685 */
    pia_index correct;        /* rounds of foot-point parameter correction; 0: none */
    const pia_index *corners; /* data rows that are corners */
    pia_index corner_count;   /* PIA_AUTO: found; 0: none */
    pia_index max_iterations; /* PIA_AUTO: the method's own */
    double stop_change;       /* units of the points; PIA_AUTO: 1e-14 of the extent; 0: never */
    double stop_gradient;     /* relative; PIA_AUTO: 1e-12 where the method has a gradient; 0: never */
    double time_limit;        /* seconds; 0: none */
    pia_index trace_every;    /* rows of the trace: 0 none, k every k-th iteration and the last */
    int (*progress)(void *user,
                    const pia_report *so_far); /* called at least once an iteration or round; non-zero stops and keeps the model */
    void *user;
    double between; /* a curve whose knots are found for a tolerance stays within so many tolerances, and what the bend of the points
                       explains, of the straight line between neighbouring points that are far apart, where more control points can
                       do that, 3 for instance; 0, the default: no matter */
} pia_fit_options;

/* The defaults named at the members; zero, NULL or PIA_AUTO where none is named, as their comments say. */
void pia_fit_options_init(pia_fit_options *options);

/* What a member of pia_fit_options holds. */
typedef enum pia_option_type {
    PIA_OPTION_SWITCH,      /* int, 0 or 1 */
    PIA_OPTION_INTEGER,     /* int */
    PIA_OPTION_COUNT,       /* pia_index */
    PIA_OPTION_NUMBER,      /* double */
    PIA_OPTION_NAME,        /* const char * */
    PIA_OPTION_SETTINGS,    /* texts "name=value", and their count */
    PIA_OPTION_INDICES,     /* const pia_index *, and their count */
    PIA_OPTION_NUMBERS,     /* const double *, and their count */
    PIA_OPTION_CONSTRAINTS, /* const pia_constraint *, and their count */
    PIA_OPTION_MODEL,       /* const pia_model * */
    PIA_OPTION_JOINS        /* const pia_join *, and their count */
} pia_option_type;

/* A member of pia_fit_options, for programs that fill the struct by name: bindings, settings files. */
typedef struct pia_option {
    const char *name; /* of the member */
    pia_option_type type;
    size_t offset;                    /* bytes from the start of pia_fit_options */
    size_t count_offset;              /* of the member with the count of an array; 0: the member is no array */
    int directions;                   /* 2: an array of two, u and v, and so is the count; 1: one value */
    int automatic;                    /* 1: numbers may be PIA_AUTO as well; of an array, its count */
    double minimum, maximum, initial; /* of numbers; initial is the default. Everything else begins as 0 or NULL */
    const char *values;               /* of names: "word|word", or the registry that lists them; NULL for others */
    const char *sentence;             /* what it does, with its unit */
} pia_option;

/* Option number `index` of pia_fit_options, callbacks left out; returns 0 past the end, 1 otherwise. */
int pia_list_options(pia_index index, pia_option *out);

/* ------------------------------------------------------------------------ the one call, the progressive service ---- */

/* Fit from data to model: open, run, model, close, without a copy of the points where the method allows.
 * model, report: either may be NULL. Without a report and a tolerance nobody asks for the errors of a least-squares fit: the pass over
 * the data that measures them is left out, and what the model says of the fit has NAN for them.
 * Errors: PIA_E_ARGUMENT, SHAPE, DATA, CONSTRAINT, MEMORY, SIZE, UNAVAILABLE. */
pia_status pia_fit_data(pia_context *context, const pia_data *data, const pia_fit_options *options, pia_model **model,
                        pia_report *report);

/* A tolerance that the noise in the points of a curve or grid suggests: what the largest of so much normal noise comes to. noise (NULL
 * allowed): its standard deviation a component, from what neighbours in a row say of each other; of noiseless points, what their
 * spacing leaves out. The rows of a function graph are sorted. Errors: PIA_E_ARGUMENT, SHAPE, DATA (fewer than five points),
 * UNAVAILABLE (scattered points), MEMORY. */
pia_status pia_suggest_tolerance(pia_context *context, const pia_data *data, double *tolerance, double *noise);

/* What is known of an order. */
typedef struct pia_order_report {
    size_t struct_size;
    double length;      /* of the polyline through the points in this order */
    double tree_length; /* of their spanning tree: no order is shorter, a random one many times as long */
    int closed;         /* 1: the two ends are neighbours */
    pia_index
        break_count; /* nearest: steps of more than ten times the median one; tree: twigs as long that are not of the longest path */
    pia_index break_row; /* where the longest of them begins; -1: none */
    double break_length;
} pia_order_report;

/* An order for points of a curve that have none: order [count] becomes the rows along the curve. how: "nearest", from a point far off
 * always to the nearest that is left; "tree", along the longest path of the spanning tree; "given" or NULL, the rows as they are.
 * report may be NULL. Errors: PIA_E_ARGUMENT, PIA_E_DATA (not finite, or 1e154 apart), MEMORY, SIZE. O(count log count) for points
 * along a curve. */
pia_status pia_points_order(pia_context *context, const double *points, pia_index count, int dim, const char *how, pia_index *order,
                            pia_order_report *report);

/* A fit that is stepped, read and edited. Copies the data; the options' arrays need not outlive the call. Where memory runs out in the
 * middle of a step or an edit, the fit answers PIA_E_MEMORY from then on, and can only be closed. */
pia_status pia_fit_open(pia_context *context, const pia_data *data, const pia_fit_options *options, pia_fit **out);
/* `iterations` updates, fewer when a stop rule fires. report may be NULL. */
pia_status pia_fit_step(pia_fit *fit, pia_index iterations, pia_report *report);
/* Until a stop rule fires. report may be NULL. */
pia_status pia_fit_run(pia_fit *fit, pia_report *report);
/* State now; never iterates. Cost: one pass over the data if an edit made the errors stale. */
pia_status pia_fit_report(pia_fit *fit, pia_report *report);
/* Components of a row that are fitted, those of residuals and of points moved or added: the data's, of a function graph one less. */
int pia_fit_dim(const pia_fit *fit);
/* A model of the current iterate; the caller destroys it. */
pia_status pia_fit_model(pia_fit *fit, pia_model **out);
/* A parameter of the method's record ("omega", "eta", ...), or "tolerance", "max_iterations", "stop_change", "stop_gradient",
 * "time_limit", "trace_every" of the options, as text; or "axis_tolerances": "T1,T2,...", whose box then is all that is asked until
 * "tolerance" is set, or "none". */
pia_status pia_fit_set(pia_fit *fit, const char *name, const char *value);
/* Residual vectors data - model at the parameters used, shaped like the data used (see pia_fit_parameters for its count). */
pia_status pia_fit_residuals(pia_fit *fit, double *out);
/* Parameters used. `count` receives the number of values, `row` (NULL allowed) the data row of each; arrays borrowed until the next
 * edit. Curve: one a used row; grid: u then v; scattered: u,v pairs. */
pia_status pia_fit_parameters(pia_fit *fit, const double **parameters, pia_index *count, const pia_index **row);
/* Factors in [0, 1] that the robust loss gave the rows used, in their order: 1 is a row fully trusted, below 0.5 an outlier. `row`
 * (NULL allowed) as above; arrays borrowed until the next step or edit. NULL and 0 without a robust loss. */
pia_status pia_fit_weights(pia_fit *fit, const double **weights, const pia_index **row, pia_index *count);
/* Control points that the data do not hold: no parameter of their own (Schoenberg-Whitney), or all basis values below 1e-3. Row-major
 * over the control points that the report counts; borrowed until the next edit. They stay near the start; fairing bridges them instead.
 */
pia_status pia_fit_unsupported(pia_fit *fit, const pia_index **control, pia_index *count);
/* Data rows that are corners of the curve, found or given, rising, without the ends of an open one; borrowed from the fit. NULL and 0
 * where there are none. */
pia_status pia_fit_corners(pia_fit *fit, const pia_index **row, pia_index *count);
/* Row `index` of the trace; returns 0 past the end. */
int pia_fit_trace(const pia_fit *fit, pia_index index, pia_trace_row *out);
/* Note (repair, warning, choice made by the library) number `index`; NULL past the end. */
const char *pia_fit_note(const pia_fit *fit, pia_index index);
/* Moves one data row; parameters stay. Recomputes only what the point touches, of a curve whose first row it is all sums. After method
 * epia has ended, control points near the row go on, others where they must; a note of the result tells how many, and the rows read. */
pia_status pia_fit_move_point(pia_fit *fit, pia_index row, const double *point);
/* Gives one data row another weight (0 drops it). Least-squares methods only. */
pia_status pia_fit_weigh_point(pia_fit *fit, pia_index row, double weight);
/* Appends curve or scattered rows with given parameters inside the domain. Least-squares methods only. */
pia_status pia_fit_add_points(pia_fit *fit, const pia_data *more);
/* Freezes (1) or frees (0) control points, row-major index. Every method respects it, direct solves included. Cost:
 * least squares sums the data again. */
pia_status pia_fit_freeze(pia_fit *fit, const pia_index *control, pia_index count, int frozen);
/* Adds interpolation constraints; ids count up from *first_id (NULL allowed). Methods that know constraints only. */
pia_status pia_fit_constrain(pia_fit *fit, const pia_constraint *constraints, pia_index count, pia_index *first_id);
/* Adds the constraints of a join, of ids *first_id .. *first_id + *count - 1 (NULL allowed). */
pia_status pia_fit_join(pia_fit *fit, const pia_join *join, pia_index *first_id, pia_index *count);
/* Drops the constraint of this id. */
pia_status pia_fit_release(pia_fit *fit, pia_index constraint_id);
/* Inserts a knot; the current model keeps its shape. Least-squares methods only. direction 0 is u. */
pia_status pia_fit_insert_knot(pia_fit *fit, int direction, double knot);
/* Writes everything needed to go on later; the file is written whole or not at all. */
pia_status pia_fit_save(pia_fit *fit, const char *path);
/* A fit continued from a file: the next steps give the same bits as if it had never stopped. Callbacks are not saved. */
pia_status pia_fit_resume(pia_context *context, const char *path, pia_fit **out);
/* The callback of pia_fit_options for the steps to come; NULL: none. */
void pia_fit_set_progress(pia_fit *fit, int (*progress)(void *user, const pia_report *so_far), void *user);
/* Ends a fit and frees it; models taken from it stay. */
void pia_fit_close(pia_fit *fit);

/* ------------------------------------------------------------------------------------------------- models ---- */

/* What a model is. */
typedef struct pia_model_info {
    size_t struct_size;
    int directions; /* 1 curve, 2 surface */
    int dim;        /* components of a point, without the weight */
    int rational;
    int degree[2];
    pia_index control[2];    /* control points a direction; control[1] is 1 for a curve */
    pia_index knot_count[2]; /* control + degree + 1; 0 for a missing direction */
    int periodic[2];         /* 1: start and end join with degree-1 continuous derivatives */
    double domain[2][2];     /* [direction][first, last] */
} pia_model_info;

/* knots[d]: [control[d] + degree[d] + 1], non-decreasing, clamped ends ((degree+1)-fold), multiplicity inside at most degree.
 * points: Cartesian [control[0] x control[1] x dim], second index fastest; weights: [control[0] x control[1]] > 0, or NULL for a
 * polynomial model. Errors: PIA_E_ARGUMENT, SHAPE, DATA (not finite), MEMORY, SIZE. */
pia_status pia_model_create(pia_context *context, int directions, const int *degree, const double *const *knots,
                            const pia_index *control, int dim, const double *points, const double *weights, pia_model **out);
/* Frees a model; all that was borrowed from it is gone. */
void pia_model_destroy(pia_model *model);
/* Fills *out. */
void pia_model_get_info(const pia_model *model, pia_model_info *out);
/* Borrowed, [knot_count[direction]]. */
const double *pia_model_knots(const pia_model *model, int direction);
/* Copies Cartesian control points [control[0] x control[1] x dim] and weights [control[0] x control[1]] (1 for polynomial models);
 * either output may be NULL. */
void pia_model_control(const pia_model *model, double *points, double *weights);
/* The report of the fit that made the model; returns 0 when it was not made by a fit. */
int pia_model_report(const pia_model *model, pia_report *out);
/* Note number `index` of the fit that made the model; NULL past the end. */
const char *pia_model_note(const pia_model *model, pia_index index);
/* Parameters of the data the model was fitted to, where it carries them: as in pia_fit_parameters, but in the order of the data rows,
 * without those dropped; NULL and 0 otherwise. */
const double *pia_model_parameters(const pia_model *model, pia_index *count);
/* Data rows that the fit did not use because they repeat others, increasing; NULL and 0 when there are none. */
const pia_index *pia_model_dropped(const pia_model *model, pia_index *count);

/* The same surface, trimmed: the face that lies inside loop 0 and outside the other loops, closed polylines in the parameter plane.
 * vertex_counts: [loop_count], at least 3 each; uv: [sum of vertex_counts x 2], loop after loop, inside the domain. The last vertex
 * joins the first; repeated vertices are left out, wrong orientations turned around (loop 0 runs counter-clockwise, holes clockwise).
 * Loops may not cross or touch themselves or each other, and holes lie inside loop 0 side by side. loop_count 0: the untrimmed
 * surface. Report, notes and parameters of a fit come along. Errors: PIA_E_ARGUMENT (a curve, a count), PIA_E_DATA (names loop and
 * vertex), MEMORY, SIZE. Cost O(n log n) for n vertices, O(n^2) for wildly folded ones.
 * Evaluation, closest points, length and bounds are those of the whole surface; knot insertion and removal and degree elevation keep
 * the loops; JSON, STEP and IGES files hold them, OBJ meshes and pictures end at them, other formats hold the whole surface. */
pia_status pia_model_trim(pia_context *context, const pia_model *model, pia_index loop_count, const pia_index *vertex_counts,
                          const double *uv, pia_model **out);
/* How to find the outline of points. */
typedef struct pia_outline_options {
    size_t struct_size;
    int hull;      /* 1: the convex hull of the parameters; 0: an alpha shape, which has bays and holes */
    double radius; /* of the alpha shape, units of the points: a region without points is outside, or a hole, where a disc of this
                      radius fits in it; 0: chosen from the spacing of the points */
} pia_outline_options;

/* Zeroes. */
void pia_outline_options_init(pia_outline_options *options);
/* The same surface, trimmed to where its points are: parameters [count x 2], count >= 3. Of several islands the one with the most
 * points is kept. Untrimmed where the points fill the domain. Points left outside and holes with their sizes are noted, where a fit
 * made the model. Errors as pia_model_trim; PIA_E_DATA also when a parameter is not finite. O(count log count). */
pia_status pia_model_trim_to_points(pia_context *context, const pia_model *model, const double *parameters, pia_index count,
                                    const pia_outline_options *options, pia_model **out);
/* 0 for an untrimmed surface and for a curve. */
pia_index pia_model_trim_loop_count(const pia_model *model);
/* Vertices of a loop, borrowed, [*count x 2] without a repeated last one; NULL and 0 when there is no such loop. */
const double *pia_model_trim_loop(const pia_model *model, pia_index loop, pia_index *count);
/* 1 when (u, v) lies in the trimmed face; always for an untrimmed model. On an edge either answer is possible. O(vertices). */
int pia_model_trim_contains(const pia_model *model, double u, double v);

/* Values and derivatives. parameters: [count x directions]; a value outside the domain is taken at its nearest end.
 * derivatives K >= 0: curve out [count x (K+1) x dim], order k at k; surface out [count x (K+1)(K+2)/2 x dim] in the order S, Su, Sv,
 * Suu, Suv, Svv, ... Cost O(degree^2 + dim degree) a curve point. context may be NULL (serial, no message). */
pia_status pia_model_eval(pia_context *context, const pia_model *model, const double *parameters, pia_index count, int derivatives,
                          double *out);
/* Curve: out [count] curvature >= 0 (signed for dim 2: left turns positive). Surface of dim 3: out [count x 2] mean and Gaussian.
 * NAN where the first derivatives vanish (surface: are parallel). */
pia_status pia_model_curvature(pia_context *context, const pia_model *model, const double *parameters, pia_index count, double *out);
/* Closest points, globally: parameters [count x directions], distances [count]; either may be NULL. */
pia_status pia_model_closest(pia_context *context, const pia_model *model, const double *points, pia_index count, double *parameters,
                             double *distances);
/* Same shape, more knots: `values` non-decreasing inside the domain, each inserted once a mention (Oslo). */
pia_status pia_model_insert_knots(pia_context *context, const pia_model *model, int direction, const double *values, pia_index count,
                                  pia_model **out);
/* Fewer knots: removes inside knots whose removal, all together, moves no point by more than `bound`; *error (NULL allowed) is the
 * bound proven for what was done. */
pia_status pia_model_remove_knots(pia_context *context, const pia_model *model, double bound, pia_model **out, double *error);
/* Same shape, degree raised by `raise` in one direction. */
pia_status pia_model_elevate(pia_context *context, const pia_model *model, int direction, int raise, pia_model **out);
/* The two halves at `value` strictly inside the domain. Trimmed surfaces are refused (PIA_E_ARGUMENT). */
pia_status pia_model_split(pia_context *context, const pia_model *model, int direction, double value, pia_model **left,
                           pia_model **right);
/* The same shape with every inside knot degree-fold: consecutive groups of control points are Bezier pieces. */
pia_status pia_model_bezier(pia_context *context, const pia_model *model, pia_model **out);
/* Length of a curve, to a relative accuracy of 1e-10 where the curve is regular. */
pia_status pia_model_length(pia_context *context, const pia_model *model, double *out);
/* Tight bounding box (of the shape, not of its control points): low [dim], high [dim]. */
pia_status pia_model_bounds(pia_context *context, const pia_model *model, double *low, double *high);

/* How far points are from a model. */
typedef struct pia_deviation {
    size_t struct_size;
    pia_index point_count;
    double max_error, rms_error;
    pia_index max_error_index;
    double percentile[3]; /* 50, 90 and 99 % of the points deviate at most this much */
    int foot_points;      /* 1: distances to the closest point; 0: at given parameters */
} pia_deviation;

/* Deviation of points from a model. parameters: [count x directions]; NULL: closest points. distances: [count], NULL allowed. */
pia_status pia_model_deviation(pia_context *context, const pia_model *model, const double *points, pia_index count,
                               const double *parameters, pia_deviation *out, double *distances);

/* -------------------------------------------------------------------------------------------------- files ---- */

/* Models of a file; *out is an array of *count models, released by pia_models_destroy. format: a name of the registry "format", NULL:
 * by extension. path "-" is standard input. Errors: PIA_E_FILE, FORMAT (file:line: ...), UNAVAILABLE, MEMORY. */
pia_status pia_model_read(pia_context *context, const char *path, const char *format, pia_model ***out, pia_index *count);
/* Frees an array of models and the models in it. */
void pia_models_destroy(pia_model **models, pia_index count);
/* Writes models whole or not at all ("-": standard output). Formats that hold samples (csv, npy, obj) take `samples` a direction;
 * PIA_AUTO: enough for a picture. */
pia_status pia_model_write(pia_context *context, const char *path, const char *format, const pia_model *const *models, pia_index count,
                           pia_index samples);
/* What a length of 1 in a model means to a CAD system. */
typedef enum pia_unit { PIA_UNIT_MILLIMETRE, PIA_UNIT_METRE, PIA_UNIT_INCH } pia_unit;
/* Application protocols of STEP. */
typedef enum pia_step_schema { PIA_STEP_AP214, PIA_STEP_AP242 } pia_step_schema;

/* How models are written; formats leave aside what does not concern them. */
typedef struct pia_write_options {
    size_t struct_size;
    const char *format;          /* a name of the registry "format"; NULL: by extension */
    pia_index samples;           /* a direction, in formats that hold samples; default PIA_AUTO: enough for a picture */
    pia_unit unit;               /* STEP, IGES; default millimetres */
    pia_step_schema step_schema; /* default AP214 */
    double tolerance;            /* STEP, IGES: distance below which points are the same, > 0, in that unit; PIA_AUTO: 1e-7, and 1e-7 of
                                    the size where that is below 1 */
    const char *name;            /* STEP, IGES: of the part; NULL: of the file, without folder and extension */
} pia_write_options;

/* The defaults named at the members. */
void pia_write_options_init(pia_write_options *options);
/* pia_model_write with all there is to choose; options NULL: the defaults. Errors: PIA_E_ARGUMENT, FILE, MEMORY, SHAPE. */
pia_status pia_model_write_as(pia_context *context, const char *path, const pia_model *const *models, pia_index count,
                              const pia_write_options *options);
/* Whether pia_model_write knows how to write such a file, so that a wrong name can be refused before the work. Errors: PIA_E_ARGUMENT.
 */
pia_status pia_model_write_check(pia_context *context, const char *path, const char *format);

/* How to read a file of points. */
typedef struct pia_points_options {
    size_t struct_size;
    const char *format;  /* NULL: by extension */
    const char *columns; /* "x,y,z" names or "1,2" numbers from 1; NULL: all numeric columns */
    int skip_invalid;    /* 1: bad rows and rows with values that are not finite are dropped and counted */
    int grid;            /* 1: a text or 2-D NPY matrix is a grid of heights; 0: rows are points */
    int allow_nan;       /* 1: NaN is kept; 0: refused; PIA_AUTO: kept as the holes of what the file says is a grid */
} pia_points_options;

/* Zeroes and NULL. */
void pia_points_options_init(pia_points_options *options);

/* What a point file held; arrays belong to the pia_points. */
typedef struct pia_points_info {
    size_t struct_size;
    pia_kind kind;        /* PIA_CURVE for rows of points, PIA_GRID for grids */
    const double *points; /* [count[0] x count[1] x dim]; heights come as (x, y, z) */
    pia_index count[2];   /* count[1] is 1 for rows */
    int dim;
    pia_index part_count;     /* parts separated by blank lines or a column "contour"; 1 for other formats */
    const pia_index *part;    /* [part_count + 1] first row of each part, and the total */
    pia_index skipped;        /* rows dropped by skip_invalid */
    const pia_index *row;     /* [count[0]] data row in the file of each row kept; NULL when none was dropped */
    const char *const *names; /* [dim] column names; NULL when the file has none */
    const char *format;       /* what it was read as */
} pia_points_info;

/* Points of a file; path "-" is standard input, "FILE.h5:/NAME" an array of an HDF5 file. Errors: PIA_E_ARGUMENT, FILE, FORMAT
 * (file:line: ...), UNAVAILABLE, MEMORY, SIZE. */
pia_status pia_points_read(pia_context *context, const char *path, const pia_points_options *options, pia_points **out);
/* Fills *out; its arrays live as long as `points`. */
void pia_points_get_info(const pia_points *points, pia_points_info *out);
/* Frees points and all that was borrowed from them. */
void pia_points_destroy(pia_points *points);
/* A plain array to .csv, .npy or any text format, whole or not at all. header NULL: none. */
pia_status pia_table_write(pia_context *context, const char *path, const char *format, const char *header, const double *values,
                           pia_index rows, int columns);

/* ----------------------------------------------------------------------------------------------- pictures ---- */

/* What a picture shows. */
typedef struct pia_plot_options {
    size_t struct_size;
    const char *format;         /* svg, png, pdf, html (a report, see pia_page_write); NULL: by extension */
    double width, height;       /* points of 1/72 inch, pixels for png; 0: chosen from the shape */
    const char *title;          /* NULL: none */
    int control, knots, comb;   /* 1: control polygon or net, knot marks, curvature comb. Default 1, 1, 0 */
    int deviation;              /* 1: data coloured by deviation with a colour scale; default 1 when points are given */
    double azimuth, elevation;  /* degrees; viewing direction of surfaces and space curves */
    const pia_trace_row *trace; /* NULL: none; else a panel with the convergence history */
    pia_index trace_count;
    const double *parameters; /* of the points, as in pia_model_deviation; NULL: closest points */
} pia_plot_options;

/* The defaults named at the members. */
void pia_plot_options_init(pia_plot_options *options);
/* Draws models with the points they stand for (points NULL: none; [count x dim] with dim of the first model). Written whole or not at
 * all. Errors: PIA_E_ARGUMENT, FILE, UNAVAILABLE (built without Cairo). */
pia_status pia_plot(pia_context *context, const char *path, const pia_model *const *models, pia_index model_count, const double *points,
                    pia_index count, const pia_plot_options *options);

/* --------------------------------------------------------------------------------------------- the report ---- */

/* One row of a report's table of settings. */
typedef struct pia_page_setting {
    const char *name;    /* as the option is called */
    const char *value;   /* as given or chosen; NULL: the default */
    const char *initial; /* the default */
} pia_page_setting;

/* What a report tells beside models and points. Texts are UTF-8 and may hold anything. */
typedef struct pia_page_options {
    size_t struct_size;
    const char *title;        /* NULL: the source */
    const char *source;       /* where the points are from; NULL: not told */
    const char *command;      /* what makes the model again at a command line; NULL: not told */
    double tolerance;         /* largest deviation that was wanted, units of the points; 0: none */
    const double *parameters; /* of the points, as in pia_model_deviation; NULL: closest points */
    const pia_index *rows;    /* [count] what a reader calls each point, its row in a file; NULL: its index */
    const pia_page_setting *settings;
    pia_index setting_count;
    const pia_trace_row *trace; /* history of the first model; NULL: that of its frames */
    pia_index trace_count;
    const pia_model *const *frames; /* earlier states of the models, those of a model one after the other in their order */
    pia_index frame_count;
    const pia_index *frame_start; /* [model_count + 1] first frame of each model, and frame_count; NULL: all are the first model's */
    const pia_index *corners;     /* rows of points that are corners */
    pia_index corner_count;
    const pia_index *met; /* rows of points that are met exactly */
    pia_index met_count;
    const double *constraint_points; /* [constraint_point_count x dim] other points that are met */
    pia_index constraint_point_count;
    const pia_index *unsupported; /* control points of the first model that no data holds, row-major */
    pia_index unsupported_count;
} pia_page_options;

/* Zeroes and NULL. */
void pia_page_options_init(pia_page_options *options);
/* The interactive report: one HTML file that needs nothing else, no network either. It holds the models, the points (some 16,000 of
 * them where there are more, the farthest among them), what pia_model_report and pia_model_note tell, and a replay of the frames,
 * whose own reports give iteration and errors. points NULL: none, else [count x dim] with dim of the first model; points with a
 * component that is NaN are left out. Written whole or not at all. Errors: PIA_E_ARGUMENT, DATA, FILE, MEMORY, SIZE. Cost: the
 * deviations; the closest point of every point where options->parameters is NULL. */
pia_status pia_page_write(pia_context *context, const char *path, const pia_model *const *models, pia_index model_count,
                          const double *points, pia_index count, const pia_page_options *options);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
