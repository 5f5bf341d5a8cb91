/* Files: models, points, pictures. */
#include "binding.h"

#include <string.h>

/* ---- models ---- */

/* The models of a file live in one array, which its last object releases. */
static void release_models(PyObject *capsule)
{
    pia_models_destroy(PyCapsule_GetPointer(capsule, NULL), (pia_index)(intptr_t)PyCapsule_GetContext(capsule));
}

/* Takes over the models. */
static PyObject *list_models(PyTypeObject *type, pia_model **models, pia_index count)
{
    PyObject *owner = PyCapsule_New(models, NULL, release_models);
    if (owner == NULL || PyCapsule_SetContext(owner, (void *)(intptr_t)count) < 0) {
        pia_models_destroy(models, count);
        return NULL;
    }
    PyObject *list = PyList_New((Py_ssize_t)count);
    for (pia_index i = 0; list != NULL && i < count; i++) {
        PyObject *model = model_wrap(type, models[i], owner);
        if (model == NULL || PyList_SetItem(list, (Py_ssize_t)i, model) < 0) Py_CLEAR(list);
    }
    Py_DECREF(owner);
    return list;
}

/* load(model type, path, format or None) -> list */
static PyObject *load(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *type, *path, *list = NULL;
    const char *format;
    if (!PyArg_ParseTuple(arguments, "O!O&z", &PyType_Type, &type, PyUnicode_FSConverter, &path, &format)) return NULL;
    py_worker *worker = worker_take(PIA_AUTO);
    if (worker != NULL) {
        pia_model **models = NULL;
        pia_index count = 0;
        worker_begin(worker);
        pia_status status = pia_model_read(worker->context, PyBytes_AsString(path), format, &models, &count);
        worker_end(worker);
        if (worker_check(worker, status) == 0) list = list_models((PyTypeObject *)(void *)type, models, count);
    }
    worker_give(worker);
    Py_DECREF(path);
    return list;
}

/* The models of a tuple; NULL with an exception. Released with PyMem_Free. */
static const pia_model **take_models(PyObject *tuple)
{
    Py_ssize_t count = PyTuple_Size(tuple);
    const pia_model **model = PyMem_Calloc((size_t)count + 1, sizeof *model);
    if (model == NULL) PyErr_NoMemory();
    for (Py_ssize_t i = 0; model != NULL && i < count; i++) {
        model[i] = model_of(PyTuple_GetItem(tuple, i));
        if (model[i] != NULL) continue;
        PyMem_Free(model);
        model = NULL;
    }
    return model;
}

/* save(path, tuple of models, format or None, samples, unit, schema, tolerance, name or None): unit and schema as numbers of their
 * enums */
static PyObject *save(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *path, *tuple;
    long long samples;
    int unit, schema, failed = 1;
    pia_write_options options;
    pia_write_options_init(&options);
    if (!PyArg_ParseTuple(arguments, "O&O!zLiidz", PyUnicode_FSConverter, &path, &PyTuple_Type, &tuple, &options.format, &samples,
                          &unit, &schema, &options.tolerance, &options.name))
        return NULL;
    options.samples = samples;
    options.unit = (pia_unit)unit;
    options.step_schema = (pia_step_schema)schema;
    const pia_model **model = take_models(tuple);
    py_worker *worker = model != NULL ? worker_take(PIA_AUTO) : NULL;
    if (worker != NULL) {
        worker_begin(worker);
        pia_status status = pia_model_write_as(worker->context, PyBytes_AsString(path), model, PyTuple_Size(tuple), &options);
        worker_end(worker);
        failed = worker_check(worker, status) < 0;
    }
    worker_give(worker);
    PyMem_Free(model);
    Py_DECREF(path);
    return failed ? NULL : Py_NewRef(Py_None);
}

/* ---- points ---- */

/* Points of a file, seen through the buffer protocol without a copy. */
typedef struct points_object {
    PyObject ob_base;
    pia_points *points;
    pia_points_info info;
    Py_ssize_t shape[3], strides[3];
    int axes;
} points_object;

static points_object *own(PyObject *self)
{
    return (points_object *)(void *)self;
}

static void destroy_points(PyObject *self)
{
    PyTypeObject *type = Py_TYPE(self);
    freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    pia_points_destroy(own(self)->points);
    release(self);
    Py_DECREF(type);
}

static int view_points(PyObject *self, Py_buffer *view, int flags)
{
    static char doubles[] = "d";
    points_object *p = own(self);
    Py_ssize_t size = p->shape[0] * p->strides[0];
    if (PyBuffer_FillInfo(view, self, (void *)(uintptr_t)p->info.points, size, 1, flags) < 0) return -1;
    view->itemsize = sizeof(double);
    view->ndim = p->axes;
    view->format = (flags & PyBUF_FORMAT) != 0 ? doubles : NULL;
    view->shape = (flags & PyBUF_ND) != 0 ? p->shape : NULL;
    view->strides = (flags & PyBUF_STRIDES) == PyBUF_STRIDES ? p->strides : NULL;
    return 0;
}

static void set_shape(points_object *p)
{
    pia_points_get_info(p->points, &p->info);
    int grid = p->info.kind == PIA_GRID;
    p->axes = grid ? 3 : 2;
    p->shape[0] = (Py_ssize_t)p->info.count[0];
    p->shape[1] = grid ? (Py_ssize_t)p->info.count[1] : p->info.dim;
    p->shape[2] = p->info.dim;
    p->strides[p->axes - 1] = sizeof(double);
    for (int axis = p->axes - 2; axis >= 0; axis--) p->strides[axis] = p->strides[axis + 1] * p->shape[axis + 1];
}

static PyObject *wrap_points(pia_points *points)
{
    allocfunc allocate = (allocfunc)PyType_GetSlot(binding.points, Py_tp_alloc);
    PyObject *self = allocate(binding.points, 0);
    if (self == NULL) {
        pia_points_destroy(points);
        return NULL;
    }
    own(self)->points = points;
    set_shape(own(self));
    return self;
}

/* First row of each part, and the total. */
static PyObject *parts(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    const pia_points_info *info = &own(self)->info;
    PyObject *tuple = PyTuple_New((Py_ssize_t)info->part_count + 1);
    for (pia_index i = 0; tuple != NULL && i <= info->part_count; i++) {
        PyObject *row = PyLong_FromLongLong(info->part[i]);
        if (row == NULL || PyTuple_SetItem(tuple, (Py_ssize_t)i, row) < 0) Py_CLEAR(tuple);
    }
    return tuple;
}

/* read_points(path, format, columns, skip_invalid, grid, allow_nan) */
static PyObject *read_points(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *path, *result = NULL;
    pia_points_options options;
    pia_points_options_init(&options);
    if (!PyArg_ParseTuple(arguments, "O&zzppp", PyUnicode_FSConverter, &path, &options.format, &options.columns, &options.skip_invalid,
                          &options.grid, &options.allow_nan))
        return NULL;
    py_worker *worker = worker_take(PIA_AUTO);
    if (worker != NULL) {
        pia_points *points = NULL;
        worker_begin(worker);
        pia_status status = pia_points_read(worker->context, PyBytes_AsString(path), &options, &points);
        worker_end(worker);
        if (worker_check(worker, status) == 0) result = wrap_points(points);
    }
    worker_give(worker);
    Py_DECREF(path);
    return result;
}

/* ---- pictures ---- */

static pia_status draw(py_worker *worker, const char *path, const pia_model **model, pia_index count, const py_numbers *points,
                       const pia_plot_options *options)
{
    pia_model_info info;
    pia_model_get_info(model[0], &info);
    pia_index rows = points->count / info.dim;
    worker_begin(worker);
    pia_status status = pia_plot(worker->context, path, model, count, rows > 0 ? points->value : NULL, rows, options);
    worker_end(worker);
    return status;
}

/* None leaves the default. */
static int put_angle(PyObject *object, double *out)
{
    if (object == Py_None) return 0;
    *out = PyFloat_AsDouble(object);
    return PyErr_Occurred() != NULL ? -1 : 0;
}

/* plot(path, tuple of models, points or None, title or None, width, height, control, knots, comb, azimuth or None, elevation or None)
 */
static PyObject *plot(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *path, *tuple, *object, *azimuth, *elevation;
    pia_plot_options options;
    pia_plot_options_init(&options);
    if (!PyArg_ParseTuple(arguments, "O&O!OzddpppOO", PyUnicode_FSConverter, &path, &PyTuple_Type, &tuple, &object, &options.title,
                          &options.width, &options.height, &options.control, &options.knots, &options.comb, &azimuth, &elevation))
        return NULL;
    py_numbers points = {0};
    int failed = put_angle(azimuth, &options.azimuth) < 0 || put_angle(elevation, &options.elevation) < 0 ||
                 (object != Py_None && numbers_take(object, "points", &points) < 0);
    const pia_model **model = failed ? NULL : take_models(tuple);
    py_worker *worker = model != NULL ? worker_take(PIA_AUTO) : NULL;
    failed =
        worker == NULL || worker_check(worker, draw(worker, PyBytes_AsString(path), model, PyTuple_Size(tuple), &points, &options)) < 0;
    worker_give(worker);
    PyMem_Free(model);
    numbers_give(&points);
    Py_DECREF(path);
    return failed ? NULL : Py_NewRef(Py_None);
}

PyMethodDef file_functions[] = {
    {"load", load, METH_VARARGS, NULL},
    {"save", save, METH_VARARGS, NULL},
    {"read_points", read_points, METH_VARARGS, NULL},
    {"plot", plot, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyMethodDef methods[] = {
    {"_parts", parts, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static char doc[] = "Points of a file, a buffer of doubles.";

static PyType_Slot slots[] = {
    {Py_tp_dealloc, destroy_points}, {Py_bf_getbuffer, view_points}, {Py_tp_methods, methods}, {Py_tp_doc, doc}, {0, NULL},
};

PyType_Spec points_spec = {"pia._pia.Points", sizeof(points_object), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};
