/* The extension module pia._pia: the C API of the library as Python types. Shapes, names and documentation for people are made of it
 * in the package's Python files; here are buffers, reference counts, threads and exceptions.
 *
 * Functions that can fail return NULL or -1 with a Python exception set. The global interpreter lock is held everywhere but between
 * worker_begin and worker_end. */
#ifndef PIA_PYTHON_BINDING_H
#define PIA_PYTHON_BINDING_H

#define PY_SSIZE_T_CLEAN
#define Py_LIMITED_API 0x030B0000
#include <Python.h>

#include "pia/pia.h"

/* ---- py_numbers.c: arrays of doubles ---- */

enum { MOST_AXES = 3 };

/* Doubles borrowed from a Python object, or converted into a block of its own where it holds something else. */
typedef struct py_numbers {
    const double *value; /* [count], row-major */
    Py_ssize_t count, shape[MOST_AXES];
    int axes; /* 0: a single number */
    Py_buffer view;
    int viewed;     /* 1: view is to be released */
    double *copied; /* NULL: value lies in view */
} py_numbers;

/* From a buffer (no copy when it holds aligned C-contiguous doubles), an object with __array__, a number, or sequences nested to
 * MOST_AXES. `what` names it in messages. Afterwards numbers_give, also after a failure. */
int numbers_take(PyObject *object, const char *what, py_numbers *out);
void numbers_give(py_numbers *numbers);
/* A writable memoryview of `count` doubles, which *out points at. */
PyObject *numbers_new(Py_ssize_t count, double **out);
/* The same, copied from `value`. */
PyObject *numbers_copy(const double *value, pia_index count);

/* ---- py_worker.c: contexts, threads, exceptions ---- */

/* A context of the library, and what is to happen in Python while it works. One call uses it at a time. */
typedef struct py_worker {
    pia_context *context;
    int threads;
    PyThreadState *python;           /* kept while the library works */
    PyObject *progress, *report;     /* callable or NULL, and what makes its argument of a dict; borrowed */
    double asked;                    /* when signals were last looked for, seconds */
    PyObject *type, *value, *traced; /* the exception that stopped the work, NULL: none */
    struct py_worker *next;          /* in the list of idle workers */
} py_worker;

/* threads: PIA_AUTO or a count. */
py_worker *worker_take(int threads);
void worker_give(py_worker *worker);
/* Between the two no Python object is touched, and other Python threads run. */
void worker_begin(py_worker *worker);
void worker_end(py_worker *worker);
/* For pia_fit_options.progress, with the worker as user. */
int worker_progress(void *user, const pia_report *so_far);
/* The options report to `progress`, a callable or None, on reports made by `report`; both are borrowed until worker_give. */
void worker_ask(py_worker *worker, pia_fit_options *options, PyObject *progress, PyObject *report);
/* -1 with the library's failure as an exception, or the exception that stopped the work; 0 when there is neither. */
int worker_check(py_worker *worker, pia_status status);
/* The exception that stopped the work is raised, with `model` (NULL: none) as its attribute; -1. 0 when nothing stopped it. */
int worker_raise(py_worker *worker, PyObject *model);
/* ---- py_report.c ---- */

/* A dict of the members of a report, without notes. */
PyObject *report_dict(const pia_report *report);

/* ---- py_request.c: what to fit ---- */

/* The arguments of a fit as the library takes them; arrays live until request_give, and as long as the Python objects do. */
typedef struct py_request {
    pia_data data;
    pia_fit_options options;
    py_numbers points, parameters, weights, tolerances;
    struct kept *kept;
} py_request;

/* kind: pia_kind, or FUNCTION_GRAPH; parameters, weights, tolerances, options may be None. Afterwards request_give, also after a
 * failure. */
enum { FUNCTION_GRAPH = 3 };
int request_take(int kind, PyObject *points, PyObject *parameters, PyObject *weights, PyObject *tolerances, PyObject *options,
                 py_request *out);
void request_give(py_request *request);
/* Zeroes, and an object, that live as long as the request. */
void *request_keep(py_request *request, Py_ssize_t count, size_t size);
int request_hold(py_request *request, PyObject *object);
/* A copy of a dict: whatever runs while its values are read cannot change it. TypeError with an example for other objects. */
PyObject *copy_dict(PyObject *dict, const char *what, const char *example);
/* A list of dicts {"at": row or parameter or (u, v), "derivative": order, "value": numbers, "direction": bool}; dim: components of a
 * value. */
int request_constraints(py_request *request, PyObject *list, int dim, const pia_constraint **out, pia_index *count);
/* py_join.c. A list of dicts {"join": model, "end": edge, "to": edge, "continuity": word, "reversed": bool}. */
int request_joins(py_request *request, PyObject *list, const pia_join **out, pia_index *count);
/* A sequence of whole numbers. */
int request_indices(py_request *request, PyObject *sequence, const char *what, const pia_index **out, pia_index *count);

/* ---- py_model.c ---- */

typedef struct model_object {
    PyObject ob_base;
    pia_model *model;
    PyObject *owner; /* what the model belongs to; NULL: to this object */
} model_object;

/* A new object of `type`, _pia.Model or a subclass. owner NULL: it owns `model` from now on, also after a failure. */
PyObject *model_wrap(PyTypeObject *type, pia_model *model, PyObject *owner);
/* The model of a _pia.Model; NULL with TypeError for other objects. */
const pia_model *model_of(PyObject *object);

/* ---- the module's types, exception classes by status, and names that are looked up often ---- */

extern struct binding {
    PyTypeObject *model, *fit, *points;
    PyObject *errors[PIA_E_INTERNAL + 1];
    PyObject *cast, *doubles, *array, *model_name; /* "cast", "d", "__array__", "model": interned, so that Python's caches know them */
} binding;

extern PyType_Spec model_spec, fit_spec, points_spec;
extern PyMethodDef fit_functions[], file_functions[], list_functions[];

#endif
