/* The type _pia.Fit: a fit that is stepped and edited. */
#include "binding.h"

#include <string.h>

typedef struct fit_object {
    PyObject ob_base;
    py_worker *worker;
    pia_fit *fit; /* NULL: closed */
    PyObject *progress, *report;
    int directions;
    int busy; /* 1: a call works without the lock */
} fit_object;

static fit_object *own(PyObject *self)
{
    return (fit_object *)(void *)self;
}

/* NULL with an exception when the fit is closed, or works in another thread or around this callback. */
static fit_object *ready(PyObject *self)
{
    fit_object *f = own(self);
    if (f->fit != NULL && !f->busy) return f;
    PyErr_SetString(PyExc_RuntimeError, f->fit == NULL ? "the fit is closed"
                                                       : "the fit is at work; one call at a time, and none from its progress callback");
    return NULL;
}

static void begin(fit_object *f)
{
    f->busy = 1;
    worker_begin(f->worker);
}

static void end(fit_object *f)
{
    worker_end(f->worker);
    f->busy = 0;
}

static PyObject *none_or_error(fit_object *f, pia_status status)
{
    return worker_check(f->worker, status) < 0 ? NULL : Py_NewRef(Py_None);
}

static void close_fit(fit_object *f)
{
    pia_fit_close(f->fit);
    worker_give(f->worker);
    f->fit = NULL;
    f->worker = NULL;
    Py_CLEAR(f->progress);
    Py_CLEAR(f->report);
}

static int traverse(PyObject *self, visitproc visit, void *arg)
{
    Py_VISIT((PyObject *)Py_TYPE(self));
    Py_VISIT(own(self)->progress);
    Py_VISIT(own(self)->report);
    return 0;
}

static int clear(PyObject *self)
{
    close_fit(own(self));
    return 0;
}

static void destroy(PyObject *self)
{
    PyTypeObject *type = Py_TYPE(self);
    freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    PyObject_GC_UnTrack(self);
    close_fit(own(self));
    release(self);
    Py_DECREF(type);
}

static PyObject *blank(PyTypeObject *type, PyObject *report, int threads, PyObject *progress)
{
    allocfunc allocate = (allocfunc)PyType_GetSlot(type, Py_tp_alloc);
    PyObject *self = allocate(type, 0);
    if (self == NULL) return NULL;
    fit_object *f = own(self);
    f->worker = worker_take(threads);
    if (f->worker == NULL) {
        Py_DECREF(self);
        return NULL;
    }
    f->report = Py_NewRef(report);
    if (progress != Py_None) f->progress = Py_NewRef(progress);
    f->worker->progress = f->progress;
    f->worker->report = f->report;
    return self;
}

static int open_fit(fit_object *f, const py_request *request)
{
    begin(f);
    pia_status status = pia_fit_open(f->worker->context, &request->data, &request->options, &f->fit);
    end(f);
    f->directions = request->data.kind == PIA_CURVE ? 1 : 2;
    return worker_check(f->worker, status);
}

/* Fit(report type, kind, points, parameters, weights, tolerances, options, threads, progress) */
static PyObject *new_fit(PyTypeObject *type, PyObject *arguments, PyObject *keywords)
{
    (void)keywords;
    PyObject *report, *points, *parameters, *weights, *tolerances, *options, *progress, *self = NULL;
    int kind, threads;
    if (!PyArg_ParseTuple(arguments, "OiOOOOOiO", &report, &kind, &points, &parameters, &weights, &tolerances, &options, &threads,
                          &progress))
        return NULL;
    py_request request;
    if (request_take(kind, points, parameters, weights, tolerances, options, &request) == 0)
        self = blank(type, report, threads, progress);
    if (self != NULL) {
        worker_ask(own(self)->worker, &request.options, progress, report);
        if (open_fit(own(self), &request) < 0) Py_CLEAR(self);
    }
    request_give(&request);
    return self;
}

/* _resume(report type, path, threads, progress) */
static PyObject *resume(PyObject *type, PyObject *arguments)
{
    PyObject *report, *path, *progress;
    int threads;
    if (!PyArg_ParseTuple(arguments, "OO&iO", &report, PyUnicode_FSConverter, &path, &threads, &progress)) return NULL;
    PyObject *self = blank((PyTypeObject *)(void *)type, report, threads, progress);
    if (self != NULL) {
        fit_object *f = own(self);
        begin(f);
        pia_status status = pia_fit_resume(f->worker->context, PyBytes_AsString(path), &f->fit);
        pia_report now = {.struct_size = sizeof now};
        if (status == PIA_OK) status = pia_fit_report(f->fit, &now);
        f->directions = now.kind == PIA_CURVE ? 1 : 2;
        end(f);
        if (worker_check(f->worker, status) < 0)
            Py_CLEAR(self);
        else if (f->progress != NULL)
            pia_fit_set_progress(f->fit, worker_progress, f->worker);
    }
    Py_DECREF(path);
    return self;
}

/* ---- looking ---- */

/* step(iterations): a count, -1 runs until a rule stops it. */
static PyObject *step(PyObject *self, PyObject *arguments)
{
    long long iterations;
    if (!PyArg_ParseTuple(arguments, "L", &iterations)) return NULL;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    pia_report report = {.struct_size = sizeof report};
    begin(f);
    pia_status status = pia_fit_step(f->fit, iterations == -1 ? INT64_MAX : iterations, &report);
    end(f);
    return worker_check(f->worker, status) == 0 ? report_dict(&report) : NULL;
}

static PyObject *report(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    pia_report report = {.struct_size = sizeof report};
    begin(f);
    pia_status status = pia_fit_report(f->fit, &report);
    end(f);
    return worker_check(f->worker, status) == 0 ? report_dict(&report) : NULL;
}

static PyObject *model(PyObject *self, PyObject *arguments)
{
    PyObject *type;
    if (!PyArg_ParseTuple(arguments, "O!", &PyType_Type, &type)) return NULL;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    pia_model *model = NULL;
    begin(f);
    pia_status status = pia_fit_model(f->fit, &model);
    end(f);
    return worker_check(f->worker, status) == 0 ? model_wrap((PyTypeObject *)(void *)type, model, NULL) : NULL;
}

static PyObject *note(PyObject *self, PyObject *arguments)
{
    long long index;
    if (!PyArg_ParseTuple(arguments, "L", &index)) return NULL;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    const char *text = pia_fit_note(f->fit, index);
    return text != NULL ? PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "replace") : Py_NewRef(Py_None);
}

static PyObject *trace(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    fit_object *f = ready(self);
    PyObject *list = f != NULL ? PyList_New(0) : NULL;
    pia_trace_row r;
    for (pia_index i = 0; list != NULL && pia_fit_trace(f->fit, i, &r); i++) {
        PyObject *row = Py_BuildValue("(LLddddd)", (long long)r.iteration, (long long)r.control_count, r.max_error, r.rms_error,
                                      r.adjust_max, r.constraint_error, r.seconds);
        if (row == NULL || PyList_Append(list, row) < 0) Py_CLEAR(list);
        Py_XDECREF(row);
    }
    return list;
}

/* Data rows of the values, None where they are all rows in order. */
static PyObject *rows_list(const pia_index *row, pia_index count)
{
    if (row == NULL) return Py_NewRef(Py_None);
    PyObject *list = PyList_New((Py_ssize_t)count);
    for (pia_index i = 0; list != NULL && i < count; i++) {
        PyObject *number = PyLong_FromLongLong(row[i]);
        if (number == NULL || PyList_SetItem(list, (Py_ssize_t)i, number) < 0) Py_CLEAR(list);
    }
    return list;
}

/* (parameters, rows or None) */
static PyObject *parameters(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    const double *value;
    const pia_index *row;
    pia_index count;
    pia_report report = {.struct_size = sizeof report};
    pia_status status = pia_fit_parameters(f->fit, &value, &count, &row);
    if (status == PIA_OK) status = pia_fit_report(f->fit, &report);
    if (worker_check(f->worker, status) < 0) return NULL;
    PyObject *values = numbers_copy(value, count);
    PyObject *rows = values != NULL ? rows_list(row, report.point_count) : NULL;
    if (rows != NULL) return Py_BuildValue("(NN)", values, rows);
    Py_XDECREF(values);
    return NULL;
}

static PyObject *weights(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    const double *value;
    pia_index count;
    if (worker_check(f->worker, pia_fit_weights(f->fit, &value, NULL, &count)) < 0) return NULL;
    return value != NULL ? numbers_copy(value, count) : Py_NewRef(Py_None);
}

static PyObject *unsupported(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    const pia_index *control;
    pia_index count;
    if (worker_check(f->worker, pia_fit_unsupported(f->fit, &control, &count)) < 0) return NULL;
    return count > 0 ? rows_list(control, count) : PyList_New(0);
}

static PyObject *corners(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    const pia_index *row;
    pia_index count;
    if (worker_check(f->worker, pia_fit_corners(f->fit, &row, &count)) < 0) return NULL;
    return count > 0 ? rows_list(row, count) : PyList_New(0);
}

static PyObject *residuals(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    pia_report report = {.struct_size = sizeof report};
    if (worker_check(f->worker, pia_fit_report(f->fit, &report)) < 0) return NULL;
    double *out;
    PyObject *result = numbers_new((Py_ssize_t)report.point_count * pia_fit_dim(f->fit), &out);
    if (result == NULL) return NULL;
    begin(f);
    pia_status status = pia_fit_residuals(f->fit, out);
    end(f);
    if (worker_check(f->worker, status) == 0) return result;
    Py_DECREF(result);
    return NULL;
}

/* ---- editing ---- */

static PyObject *set(PyObject *self, PyObject *arguments)
{
    const char *name, *value;
    if (!PyArg_ParseTuple(arguments, "ss", &name, &value)) return NULL;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    return none_or_error(f, pia_fit_set(f->fit, name, value));
}

static PyObject *move_point(PyObject *self, PyObject *arguments)
{
    long long row;
    PyObject *point, *result = NULL;
    py_numbers value;
    if (!PyArg_ParseTuple(arguments, "LO", &row, &point)) return NULL;
    int code = numbers_take(point, "point", &value);
    fit_object *f = code == 0 ? ready(self) : NULL;
    if (f != NULL && value.count != pia_fit_dim(f->fit))
        PyErr_Format(binding.errors[PIA_E_SHAPE], "point: %zd numbers; the fit has %d components", value.count, pia_fit_dim(f->fit));
    else if (f != NULL) {
        begin(f);
        pia_status status = pia_fit_move_point(f->fit, row, value.value);
        end(f);
        result = none_or_error(f, status);
    }
    numbers_give(&value);
    return result;
}

static PyObject *weigh_point(PyObject *self, PyObject *arguments)
{
    long long row;
    double weight;
    if (!PyArg_ParseTuple(arguments, "Ld", &row, &weight)) return NULL;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    begin(f);
    pia_status status = pia_fit_weigh_point(f->fit, row, weight);
    end(f);
    return none_or_error(f, status);
}

/* add_points(points, parameters, weights) */
static PyObject *add_points(PyObject *self, PyObject *arguments)
{
    PyObject *points, *parameters, *weights, *result = NULL;
    if (!PyArg_ParseTuple(arguments, "OOO", &points, &parameters, &weights)) return NULL;
    py_request request;
    int kind = own(self)->directions == 1 ? PIA_CURVE : PIA_SCATTERED;
    int code = request_take(kind, points, parameters, weights, Py_None, Py_None, &request);
    fit_object *f = code == 0 ? ready(self) : NULL;
    if (f != NULL) {
        begin(f);
        pia_status status = pia_fit_add_points(f->fit, &request.data);
        end(f);
        result = none_or_error(f, status);
    }
    request_give(&request);
    return result;
}

static PyObject *freeze(PyObject *self, PyObject *arguments)
{
    PyObject *control, *result = NULL;
    int frozen;
    if (!PyArg_ParseTuple(arguments, "Oi", &control, &frozen)) return NULL;
    py_request request = {0};
    const pia_index *index;
    pia_index count;
    int code = request_indices(&request, control, "freeze", &index, &count);
    fit_object *f = code == 0 ? ready(self) : NULL;
    if (f != NULL) {
        begin(f);
        pia_status status = pia_fit_freeze(f->fit, index, count, frozen);
        end(f);
        result = none_or_error(f, status);
    }
    request_give(&request);
    return result;
}

/* constrain(list of dicts) -> (the first id, how many) */
static PyObject *constrain(PyObject *self, PyObject *arguments)
{
    PyObject *list, *result = NULL;
    if (!PyArg_ParseTuple(arguments, "O", &list)) return NULL;
    py_request request = {0};
    const pia_constraint *constraint;
    pia_index count, first = 0;
    fit_object *f = ready(self);
    int code = f != NULL ? request_constraints(&request, list, pia_fit_dim(f->fit), &constraint, &count) : -1;
    f = code == 0 ? ready(self) : NULL; /* reading the list may have run anything */
    if (f != NULL) {
        begin(f);
        pia_status status = pia_fit_constrain(f->fit, constraint, count, &first);
        end(f);
        if (worker_check(f->worker, status) == 0) result = Py_BuildValue("(LL)", (long long)first, (long long)count);
    }
    request_give(&request);
    return result;
}

/* Ids are given in order, so those of several joins follow each other. */
static pia_status add_joins(pia_fit *fit, const pia_join *join, pia_index joins, pia_index *first, pia_index *count)
{
    pia_status status = PIA_OK;
    for (pia_index i = 0; i < joins && status == PIA_OK; i++) {
        pia_index id, added;
        status = pia_fit_join(fit, &join[i], &id, &added);
        if (status != PIA_OK) break;
        if (i == 0) *first = id;
        *count += added;
    }
    return status;
}

/* join(list of dicts) -> (the first id, how many) */
static PyObject *join(PyObject *self, PyObject *arguments)
{
    PyObject *list, *result = NULL;
    if (!PyArg_ParseTuple(arguments, "O", &list)) return NULL;
    py_request request = {0};
    const pia_join *joins;
    pia_index length, first = 0, count = 0;
    int code = request_joins(&request, list, &joins, &length);
    fit_object *f = code == 0 ? ready(self) : NULL; /* reading the list may have run anything */
    if (f != NULL) {
        begin(f);
        pia_status status = add_joins(f->fit, joins, length, &first, &count);
        end(f);
        if (worker_check(f->worker, status) == 0) result = Py_BuildValue("(LL)", (long long)first, (long long)count);
    }
    request_give(&request);
    return result;
}

static PyObject *release(PyObject *self, PyObject *arguments)
{
    long long id;
    if (!PyArg_ParseTuple(arguments, "L", &id)) return NULL;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    begin(f);
    pia_status status = pia_fit_release(f->fit, id);
    end(f);
    return none_or_error(f, status);
}

static PyObject *insert_knot(PyObject *self, PyObject *arguments)
{
    int direction;
    double knot;
    if (!PyArg_ParseTuple(arguments, "id", &direction, &knot)) return NULL;
    fit_object *f = ready(self);
    if (f == NULL) return NULL;
    begin(f);
    pia_status status = pia_fit_insert_knot(f->fit, direction, knot);
    end(f);
    return none_or_error(f, status);
}

static PyObject *save(PyObject *self, PyObject *arguments)
{
    PyObject *path, *result = NULL;
    if (!PyArg_ParseTuple(arguments, "O&", PyUnicode_FSConverter, &path)) return NULL;
    fit_object *f = ready(self);
    if (f != NULL) {
        begin(f);
        pia_status status = pia_fit_save(f->fit, PyBytes_AsString(path));
        end(f);
        result = none_or_error(f, status);
    }
    Py_DECREF(path);
    return result;
}

static PyObject *close_method(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    if (own(self)->fit != NULL && ready(self) == NULL) return NULL;
    close_fit(own(self));
    return Py_NewRef(Py_None);
}

static PyMethodDef methods[] = {
    {"_resume", resume, METH_VARARGS | METH_CLASS, NULL},
    {"_step", step, METH_VARARGS, NULL},
    {"_report", report, METH_NOARGS, NULL},
    {"_model", model, METH_VARARGS, NULL},
    {"_note", note, METH_VARARGS, NULL},
    {"_trace", trace, METH_NOARGS, NULL},
    {"_parameters", parameters, METH_NOARGS, NULL},
    {"_weights", weights, METH_NOARGS, NULL},
    {"_corners", corners, METH_NOARGS, NULL},
    {"_unsupported", unsupported, METH_NOARGS, NULL},
    {"_residuals", residuals, METH_NOARGS, NULL},
    {"_set", set, METH_VARARGS, NULL},
    {"_move_point", move_point, METH_VARARGS, NULL},
    {"_weigh_point", weigh_point, METH_VARARGS, NULL},
    {"_add_points", add_points, METH_VARARGS, NULL},
    {"_freeze", freeze, METH_VARARGS, NULL},
    {"_constrain", constrain, METH_VARARGS, NULL},
    {"_join", join, METH_VARARGS, NULL},
    {"_release", release, METH_VARARGS, NULL},
    {"_insert_knot", insert_knot, METH_VARARGS, NULL},
    {"_save", save, METH_VARARGS, NULL},
    {"_close", close_method, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static char doc[] = "A fit in progress, as the library holds it.";

static PyType_Slot slots[] = {
    {Py_tp_new, new_fit},
    {Py_tp_dealloc, destroy},
    {Py_tp_traverse, traverse},
    {Py_tp_clear, clear},
    {Py_tp_methods, methods},
    {Py_tp_doc, doc},
    {0, NULL},
};

PyType_Spec fit_spec = {"pia._pia.Fit", sizeof(fit_object), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC, slots};
