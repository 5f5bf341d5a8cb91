/* The type _pia.Model: an immutable model of the library. Arrays come flat; the package's Model gives them their shapes. */
#include "binding.h"

#include <string.h>

static const pia_model *own(PyObject *self)
{
    return ((model_object *)(void *)self)->model;
}

static int directions_of(PyObject *self)
{
    pia_model_info info;
    pia_model_get_info(own(self), &info);
    return info.directions;
}

static int dim_of(PyObject *self)
{
    pia_model_info info;
    pia_model_get_info(own(self), &info);
    return info.dim;
}

PyObject *model_wrap(PyTypeObject *type, pia_model *model, PyObject *owner)
{
    allocfunc allocate = (allocfunc)PyType_GetSlot(type, Py_tp_alloc);
    PyObject *self = allocate(type, 0);
    if (self == NULL) {
        if (owner == NULL) pia_model_destroy(model);
        return NULL;
    }
    ((model_object *)(void *)self)->model = model;
    ((model_object *)(void *)self)->owner = owner != NULL ? Py_NewRef(owner) : NULL;
    return self;
}

const pia_model *model_of(PyObject *object)
{
    if (PyObject_TypeCheck(object, binding.model)) return own(object);
    PyErr_Format(PyExc_TypeError, "a pia.Model is needed, not %R", (PyObject *)Py_TYPE(object));
    return NULL;
}

static void destroy(PyObject *self)
{
    PyTypeObject *type = Py_TYPE(self);
    freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    model_object *m = (model_object *)(void *)self;
    if (m->owner == NULL) pia_model_destroy(m->model);
    Py_XDECREF(m->owner);
    release(self);
    Py_DECREF(type);
}

/* The result of a call that makes a model of this one. */
static PyObject *made(PyObject *self, py_worker *worker, pia_status status, pia_model *model)
{
    PyObject *result = worker_check(worker, status) == 0 ? model_wrap(Py_TYPE(self), model, NULL) : NULL;
    worker_give(worker);
    return result;
}

/* ---- making one ---- */

typedef struct pieces {
    py_numbers knots[2], points, weights;
    int degree[2];
    pia_index control[2];
} pieces;

static void parts_give(pieces *parts)
{
    numbers_give(&parts->knots[0]);
    numbers_give(&parts->knots[1]);
    numbers_give(&parts->points);
    numbers_give(&parts->weights);
}

/* points [n, dim] or [n, m, dim]; knots, degrees: tuples with one item a direction; weights None or [n] or [n, m]. */
static int take_parts(PyObject *degree, PyObject *knots, PyObject *points, PyObject *weights, pieces *out)
{
    if (numbers_take(points, "control", &out->points) < 0) return -1;
    int directions = out->points.axes - 1;
    if (directions < 1 || PyTuple_Size(degree) != directions || PyTuple_Size(knots) != directions) {
        if (PyErr_Occurred() == NULL)
            PyErr_SetString(binding.errors[PIA_E_SHAPE],
                            "control is [n, dim] with one degree and one knot vector, or [n, m, dim] with two of each");
        return -1;
    }
    for (int d = 0; d < directions; d++) {
        long value = PyLong_AsLong(PyTuple_GetItem(degree, d));
        if (value == -1 && PyErr_Occurred() != NULL) return -1;
        out->degree[d] = value < 1 || value > PIA_MAX_DEGREE ? 0 : (int)value;
        out->control[d] = out->points.shape[d];
        if (numbers_take(PyTuple_GetItem(knots, d), "knots", &out->knots[d]) < 0) return -1;
        if (out->knots[d].count == out->control[d] + out->degree[d] + 1) continue;
        PyErr_Format(binding.errors[PIA_E_SHAPE], "knots: %zd values; %lld control points of degree %ld need %lld", out->knots[d].count,
                     (long long)out->control[d], value, (long long)out->control[d] + value + 1);
        return -1;
    }
    if (directions == 1) out->control[1] = 1;
    if (weights == Py_None) return 0;
    if (numbers_take(weights, "weights", &out->weights) < 0) return -1;
    if (out->weights.count == out->control[0] * out->control[1]) return 0;
    PyErr_Format(binding.errors[PIA_E_SHAPE], "weights: %zd values for %lld control points", out->weights.count,
                 (long long)(out->control[0] * out->control[1]));
    return -1;
}

static PyObject *create(PyTypeObject *type, const pieces *parts)
{
    py_worker *worker = worker_take(PIA_AUTO);
    if (worker == NULL) return NULL;
    const double *knots[2] = {parts->knots[0].value, parts->knots[1].value};
    int directions = parts->points.axes - 1;
    Py_ssize_t dim = parts->points.shape[directions];
    pia_model *model = NULL;
    pia_status status =
        pia_model_create(worker->context, directions, parts->degree, knots, parts->control,
                         dim > PIA_MAX_DIM ? PIA_MAX_DIM + 1 : (int)dim, parts->points.value, parts->weights.value, &model);
    PyObject *self = worker_check(worker, status) == 0 ? model_wrap(type, model, NULL) : NULL;
    worker_give(worker);
    return self;
}

/* Model(degrees, knots, control, weights or None) */
static PyObject *new_model(PyTypeObject *type, PyObject *arguments, PyObject *keywords)
{
    (void)keywords;
    PyObject *degree, *knots, *points, *weights;
    if (!PyArg_ParseTuple(arguments, "O!O!OO", &PyTuple_Type, &degree, &PyTuple_Type, &knots, &points, &weights)) return NULL;
    pieces parts = {0};
    PyObject *self = take_parts(degree, knots, points, weights, &parts) == 0 ? create(type, &parts) : NULL;
    parts_give(&parts);
    return self;
}

/* ---- what it is ---- */

static PyObject *info(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    pia_model_info i;
    pia_model_get_info(own(self), &i);
    return Py_BuildValue("(iii(ii)(LL)(ii)((dd)(dd)))", i.directions, i.dim, i.rational, i.degree[0], i.degree[1],
                         (long long)i.control[0], (long long)i.control[1], i.periodic[0], i.periodic[1], i.domain[0][0], i.domain[0][1],
                         i.domain[1][0], i.domain[1][1]);
}

static PyObject *knots(PyObject *self, PyObject *arguments)
{
    int direction;
    pia_model_info i;
    if (!PyArg_ParseTuple(arguments, "i", &direction)) return NULL;
    pia_model_get_info(own(self), &i);
    const double *value = pia_model_knots(own(self), direction);
    return numbers_copy(value, value != NULL ? i.knot_count[direction] : 0);
}

static PyObject *control(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    pia_model_info i;
    pia_model_get_info(own(self), &i);
    pia_index count = i.control[0] * i.control[1];
    double *to_points, *to_weights;
    PyObject *points = numbers_new((Py_ssize_t)count * i.dim, &to_points);
    PyObject *weights = points != NULL ? numbers_new((Py_ssize_t)count, &to_weights) : NULL;
    if (weights != NULL) {
        pia_model_control(own(self), to_points, to_weights);
        return Py_BuildValue("(NN)", points, weights);
    }
    Py_XDECREF(points);
    return NULL;
}

static PyObject *report(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    pia_report r;
    return pia_model_report(own(self), &r) ? report_dict(&r) : Py_NewRef(Py_None);
}

static PyObject *note(PyObject *self, PyObject *arguments)
{
    long long index;
    if (!PyArg_ParseTuple(arguments, "L", &index)) return NULL;
    const char *text = pia_model_note(own(self), index);
    return text != NULL ? PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "replace") : Py_NewRef(Py_None);
}

static PyObject *parameters(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    pia_index count;
    const double *value = pia_model_parameters(own(self), &count);
    return value != NULL ? numbers_copy(value, count) : Py_NewRef(Py_None);
}

/* ---- values ---- */

typedef pia_status value_call(pia_context *context, const pia_model *model, const py_numbers *at, pia_index count, int order,
                              double *out);

/* `width` numbers for each group of `group` in `object`. */
static PyObject *values(PyObject *self, PyObject *object, const char *what, int group, pia_index width, int order, value_call *call)
{
    py_numbers at;
    double *out;
    PyObject *result = NULL;
    py_worker *worker = NULL;
    if (numbers_take(object, what, &at) == 0 && at.count % group != 0)
        PyErr_Format(binding.errors[PIA_E_SHAPE], "%s: %zd numbers; this model needs %d for each", what, at.count, group);
    Py_ssize_t count = at.count / group;
    if (PyErr_Occurred() == NULL && count > 0 && width > PY_SSIZE_T_MAX / count) PyErr_NoMemory();
    if (PyErr_Occurred() == NULL) worker = worker_take(PIA_AUTO);
    if (worker != NULL) result = numbers_new(count * (Py_ssize_t)width, &out);
    if (result != NULL) {
        worker_begin(worker);
        pia_status status = call(worker->context, own(self), &at, count, order, out);
        worker_end(worker);
        if (worker_check(worker, status) < 0) Py_CLEAR(result);
    }
    worker_give(worker);
    numbers_give(&at);
    return result;
}

static pia_status call_eval(pia_context *context, const pia_model *model, const py_numbers *at, pia_index count, int order, double *out)
{
    return count > 0 ? pia_model_eval(context, model, at->value, count, order, out) : PIA_OK;
}

static PyObject *eval(PyObject *self, PyObject *arguments)
{
    PyObject *at;
    int order;
    if (!PyArg_ParseTuple(arguments, "Oi", &at, &order)) return NULL;
    if (order < 0 || order > 1000) {
        PyErr_Format(binding.errors[PIA_E_ARGUMENT], "derivative of order %d; 0 to 1000 are possible", order);
        return NULL;
    }
    pia_index each = directions_of(self) == 1 ? order + 1 : (pia_index)(order + 1) * (order + 2) / 2;
    return values(self, at, "parameters", directions_of(self), each * dim_of(self), order, call_eval);
}

static pia_status call_curvature(pia_context *context, const pia_model *model, const py_numbers *at, pia_index count, int order,
                                 double *out)
{
    (void)order;
    return count > 0 ? pia_model_curvature(context, model, at->value, count, out) : PIA_OK;
}

static PyObject *curvature(PyObject *self, PyObject *arguments)
{
    PyObject *at;
    if (!PyArg_ParseTuple(arguments, "O", &at)) return NULL;
    return values(self, at, "parameters", directions_of(self), directions_of(self), 0, call_curvature);
}

/* Parameters first, then distances. */
static pia_status call_closest(pia_context *context, const pia_model *model, const py_numbers *at, pia_index count, int order,
                               double *out)
{
    return count > 0 ? pia_model_closest(context, model, at->value, count, out, out + count * order) : PIA_OK;
}

static PyObject *closest(PyObject *self, PyObject *arguments)
{
    PyObject *points;
    int directions = directions_of(self);
    if (!PyArg_ParseTuple(arguments, "O", &points)) return NULL;
    return values(self, points, "points", dim_of(self), directions + 1, directions, call_closest);
}

static PyObject *measure(PyObject *self, const py_numbers *points, const py_numbers *given)
{
    Py_ssize_t count = points->count / dim_of(self);
    double *out;
    PyObject *distances = numbers_new(count, &out);
    py_worker *worker = distances != NULL ? worker_take(PIA_AUTO) : NULL;
    if (worker == NULL) {
        Py_XDECREF(distances);
        return NULL;
    }
    pia_deviation d = {.struct_size = sizeof d};
    worker_begin(worker);
    pia_status status = pia_model_deviation(worker->context, own(self), points->value, count, given->value, &d, out);
    worker_end(worker);
    int failed = worker_check(worker, status) < 0;
    worker_give(worker);
    if (!failed)
        return Py_BuildValue("(LddL(ddd)iN)", (long long)d.point_count, d.max_error, d.rms_error, (long long)d.max_error_index,
                             d.percentile[0], d.percentile[1], d.percentile[2], d.foot_points, distances);
    Py_DECREF(distances);
    return NULL;
}

static PyObject *deviation(PyObject *self, PyObject *arguments)
{
    PyObject *points, *at, *result = NULL;
    py_numbers taken, given = {0};
    if (!PyArg_ParseTuple(arguments, "OO", &points, &at)) return NULL;
    int code = numbers_take(points, "points", &taken);
    if (code == 0 && at != Py_None) code = numbers_take(at, "parameters", &given);
    Py_ssize_t count = taken.count / dim_of(self);
    if (code == 0 && (taken.count % dim_of(self) != 0 || (given.value != NULL && given.count != count * directions_of(self))))
        PyErr_Format(binding.errors[PIA_E_SHAPE], "%zd coordinates and %zd parameters do not fit a model of %d components", taken.count,
                     given.count, dim_of(self));
    else if (code == 0)
        result = measure(self, &taken, &given);
    numbers_give(&taken);
    numbers_give(&given);
    return result;
}

/* ---- other models of the same shape ---- */

static PyObject *insert_knots(PyObject *self, PyObject *arguments)
{
    int direction;
    PyObject *object, *result = NULL;
    py_numbers value;
    if (!PyArg_ParseTuple(arguments, "iO", &direction, &object)) return NULL;
    py_worker *worker = numbers_take(object, "knots", &value) == 0 ? worker_take(PIA_AUTO) : NULL;
    if (worker != NULL) {
        pia_model *model = NULL;
        pia_status status = pia_model_insert_knots(worker->context, own(self), direction, value.value, value.count, &model);
        result = made(self, worker, status, model);
    }
    numbers_give(&value);
    return result;
}

static PyObject *remove_knots(PyObject *self, PyObject *arguments)
{
    double bound, error = 0;
    if (!PyArg_ParseTuple(arguments, "d", &bound)) return NULL;
    py_worker *worker = worker_take(PIA_AUTO);
    if (worker == NULL) return NULL;
    pia_model *model = NULL;
    pia_status status = pia_model_remove_knots(worker->context, own(self), bound, &model, &error);
    PyObject *result = made(self, worker, status, model);
    return result != NULL ? Py_BuildValue("(Nd)", result, error) : NULL;
}

static PyObject *elevate(PyObject *self, PyObject *arguments)
{
    int direction, raise;
    if (!PyArg_ParseTuple(arguments, "ii", &direction, &raise)) return NULL;
    py_worker *worker = worker_take(PIA_AUTO);
    if (worker == NULL) return NULL;
    pia_model *model = NULL;
    pia_status status = pia_model_elevate(worker->context, own(self), direction, raise, &model);
    return made(self, worker, status, model);
}

static PyObject *split(PyObject *self, PyObject *arguments)
{
    int direction;
    double value;
    if (!PyArg_ParseTuple(arguments, "id", &direction, &value)) return NULL;
    py_worker *worker = worker_take(PIA_AUTO);
    if (worker == NULL) return NULL;
    pia_model *half[2] = {NULL, NULL};
    pia_status status = pia_model_split(worker->context, own(self), direction, value, &half[0], &half[1]);
    PyObject *left = made(self, worker, status, half[0]);
    PyObject *right = left != NULL ? model_wrap(Py_TYPE(self), half[1], NULL) : NULL;
    if (right != NULL) return Py_BuildValue("(NN)", left, right);
    if (left == NULL) pia_model_destroy(half[1]);
    Py_XDECREF(left);
    return NULL;
}

static PyObject *bezier(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    py_worker *worker = worker_take(PIA_AUTO);
    if (worker == NULL) return NULL;
    pia_model *model = NULL;
    pia_status status = pia_model_bezier(worker->context, own(self), &model);
    return made(self, worker, status, model);
}

/* ---- trimming ---- */

/* _trim(vertices of each loop, uv) */
static PyObject *trim(PyObject *self, PyObject *arguments)
{
    PyObject *counts, *object, *result = NULL;
    if (!PyArg_ParseTuple(arguments, "OO", &counts, &object)) return NULL;
    py_request request = {0};
    py_numbers uv = {0};
    const pia_index *vertices;
    pia_index loops, total = 0;
    int code = request_indices(&request, counts, "loops", &vertices, &loops);
    if (code == 0) code = numbers_take(object, "loops", &uv);
    for (pia_index i = 0; code == 0 && i < loops; i++) total += vertices[i];
    if (code == 0 && uv.count != 2 * total)
        PyErr_SetString(binding.errors[PIA_E_SHAPE], "loops: each is [vertices, 2], u and v");
    else if (code == 0) {
        py_worker *worker = worker_take(PIA_AUTO);
        pia_model *model = NULL;
        if (worker != NULL) {
            pia_status status = pia_model_trim(worker->context, own(self), loops, vertices, uv.value, &model);
            result = made(self, worker, status, model);
        }
    }
    numbers_give(&uv);
    request_give(&request);
    return result;
}

/* _trim_loop(index) -> uv, None past the last */
static PyObject *trim_loop(PyObject *self, PyObject *arguments)
{
    long long index;
    pia_index count;
    if (!PyArg_ParseTuple(arguments, "L", &index)) return NULL;
    const double *uv = pia_model_trim_loop(own(self), index, &count);
    return uv != NULL ? numbers_copy(uv, 2 * count) : Py_NewRef(Py_None);
}

static PyObject *contains(PyObject *self, PyObject *arguments)
{
    double u, v;
    if (!PyArg_ParseTuple(arguments, "dd", &u, &v)) return NULL;
    return PyBool_FromLong(pia_model_trim_contains(own(self), u, v));
}

/* ---- measures ---- */

static PyObject *length(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    double value = 0;
    py_worker *worker = worker_take(PIA_AUTO);
    if (worker == NULL) return NULL;
    int failed = worker_check(worker, pia_model_length(worker->context, own(self), &value)) < 0;
    worker_give(worker);
    return failed ? NULL : PyFloat_FromDouble(value);
}

static PyObject *bounds(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    double *out;
    PyObject *result = numbers_new(2 * dim_of(self), &out);
    py_worker *worker = result != NULL ? worker_take(PIA_AUTO) : NULL;
    if (worker == NULL) {
        Py_XDECREF(result);
        return NULL;
    }
    if (worker_check(worker, pia_model_bounds(worker->context, own(self), out, out + dim_of(self))) < 0) Py_CLEAR(result);
    worker_give(worker);
    return result;
}

static PyMethodDef methods[] = {
    {"_info", info, METH_NOARGS, NULL},
    {"_knots", knots, METH_VARARGS, NULL},
    {"_control", control, METH_NOARGS, NULL},
    {"_report", report, METH_NOARGS, NULL},
    {"_note", note, METH_VARARGS, NULL},
    {"_parameters", parameters, METH_NOARGS, NULL},
    {"_eval", eval, METH_VARARGS, NULL},
    {"_curvature", curvature, METH_VARARGS, NULL},
    {"_closest", closest, METH_VARARGS, NULL},
    {"_deviation", deviation, METH_VARARGS, NULL},
    {"_insert_knots", insert_knots, METH_VARARGS, NULL},
    {"_remove_knots", remove_knots, METH_VARARGS, NULL},
    {"_elevate", elevate, METH_VARARGS, NULL},
    {"_split", split, METH_VARARGS, NULL},
    {"_bezier", bezier, METH_NOARGS, NULL},
    {"_trim", trim, METH_VARARGS, NULL},
    {"_trim_loop", trim_loop, METH_VARARGS, NULL},
    {"_contains", contains, METH_VARARGS, NULL},
    {"_length", length, METH_NOARGS, NULL},
    {"_bounds", bounds, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static char doc[] = "A B-spline or NURBS curve or surface, as the library holds it.";

static PyType_Slot slots[] = {
    {Py_tp_new, new_model}, {Py_tp_dealloc, destroy}, {Py_tp_methods, methods}, {Py_tp_doc, doc}, {0, NULL},
};

PyType_Spec model_spec = {"pia._pia.Model", sizeof(model_object), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE, slots};
