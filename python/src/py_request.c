/* Keyword arguments become members of pia_fit_options by the library's own list of options. */
#include "binding.h"

#include <string.h>

/* Memory that lives as long as the request. */
typedef struct kept {
    struct kept *next;
    py_numbers numbers;
    void *block;
    PyObject *object;
} kept;

static kept *keep(py_request *request)
{
    kept *item = PyMem_Calloc(1, sizeof *item);
    if (item == NULL) {
        PyErr_NoMemory();
        return NULL;
    }
    item->next = request->kept;
    request->kept = item;
    return item;
}

void *request_keep(py_request *request, Py_ssize_t count, size_t size)
{
    kept *item = keep(request);
    if (item == NULL) return NULL;
    item->block = PyMem_Calloc((size_t)count + 1, size);
    if (item->block == NULL) PyErr_NoMemory();
    return item->block;
}

static const py_numbers *keep_numbers(py_request *request, PyObject *object, const char *what)
{
    kept *item = keep(request);
    if (item == NULL || numbers_take(object, what, &item->numbers) < 0) return NULL;
    return &item->numbers;
}

int request_hold(py_request *request, PyObject *object)
{
    kept *item = keep(request);
    if (item != NULL) item->object = Py_NewRef(object);
    return item != NULL ? 0 : -1;
}

void request_give(py_request *request)
{
    numbers_give(&request->points);
    numbers_give(&request->parameters);
    numbers_give(&request->weights);
    numbers_give(&request->tolerances);
    while (request->kept != NULL) {
        kept *next = request->kept->next;
        numbers_give(&request->kept->numbers);
        PyMem_Free(request->kept->block);
        Py_XDECREF(request->kept->object);
        PyMem_Free(request->kept);
        request->kept = next;
    }
}

/* ---- values of options ---- */

int request_indices(py_request *request, PyObject *sequence, const char *what, const pia_index **out, pia_index *count)
{
    PyObject *tuple = PySequence_Tuple(sequence);
    if (tuple == NULL) return -1;
    Py_ssize_t length = PyTuple_Size(tuple);
    pia_index *index = request_keep(request, length, sizeof *index);
    for (Py_ssize_t i = 0; index != NULL && i < length && PyErr_Occurred() == NULL; i++) {
        PyObject *whole = PyNumber_Index(PyTuple_GetItem(tuple, i));
        if (whole != NULL) index[i] = PyLong_AsLongLong(whole);
        Py_XDECREF(whole);
    }
    Py_DECREF(tuple);
    if (PyErr_Occurred() != NULL) {
        if (PyErr_ExceptionMatches(PyExc_TypeError)) PyErr_Format(PyExc_TypeError, "%s: a sequence of whole numbers is needed", what);
        return -1;
    }
    *out = index;
    *count = length;
    return 0;
}

PyObject *copy_dict(PyObject *dict, const char *what, const char *example)
{
    if (PyDict_Check(dict)) return PyDict_Copy(dict);
    PyErr_Format(PyExc_TypeError, "%s: a dict such as %s is needed", what, example);
    return NULL;
}

/* One or two numbers into pair; a single number leaves the second as it is. */
static int read_pair(PyObject *object, const char *what, double pair[2])
{
    py_numbers numbers;
    int code = numbers_take(object, what, &numbers);
    if (code == 0 && numbers.count != 1 && numbers.count != 2) {
        PyErr_Format(PyExc_ValueError, "%s: %zd numbers; one or two are needed", what, numbers.count);
        code = -1;
    }
    for (Py_ssize_t i = 0; code == 0 && i < numbers.count; i++) pair[i] = numbers.value[i];
    numbers_give(&numbers);
    return code;
}

static int read_place(PyObject *at, pia_constraint *out)
{
    if (!PyLong_Check(at) && !(PyIndex_Check(at) && PyObject_CheckBuffer(at)))
        return read_pair(at, "constraint: at", out->at_parameter);
    PyObject *row = PyNumber_Index(at);
    if (row == NULL) return -1;
    out->at_point = PyLong_AsLongLong(row);
    Py_DECREF(row);
    if (out->at_point >= 0 || PyErr_Occurred() != NULL) return PyErr_Occurred() != NULL ? -1 : 0;
    PyErr_Format(PyExc_ValueError, "constraint: row %lld; rows count from 0, a parameter is written with a point",
                 (long long)out->at_point);
    return -1;
}

static int read_derivative(PyObject *value, pia_constraint *out)
{
    double order[2] = {0, 0};
    int code = read_pair(value, "constraint: derivative", order);
    for (int d = 0; d < 2 && code == 0; d++) {
        out->derivative[d] = (int)(order[d] >= 0 && order[d] <= PIA_MAX_DEGREE ? order[d] : -1);
        if (out->derivative[d] == order[d]) continue;
        PyErr_Format(PyExc_ValueError, "constraint: derivative %R is no order; 0 to %d", value, PIA_MAX_DEGREE);
        code = -1;
    }
    return code;
}

static int read_value(py_request *request, PyObject *value, int dim, pia_constraint *out)
{
    if (value == Py_None) return 0;
    const py_numbers *numbers = keep_numbers(request, value, "constraint: value");
    if (numbers == NULL) return -1;
    out->value = numbers->value;
    if (numbers->count == dim) return 0;
    PyErr_Format(PyExc_ValueError, "constraint: value has %zd numbers; %d are needed, as the points have", numbers->count, dim);
    return -1;
}

static int read_member(py_request *request, PyObject *key, PyObject *value, int dim, pia_constraint *out)
{
    if (PyUnicode_CompareWithASCIIString(key, "at") == 0) return read_place(value, out);
    if (PyUnicode_CompareWithASCIIString(key, "derivative") == 0) return read_derivative(value, out);
    if (PyUnicode_CompareWithASCIIString(key, "value") == 0) return read_value(request, value, dim, out);
    if (PyUnicode_CompareWithASCIIString(key, "direction") == 0) return (out->direction_only = PyObject_IsTrue(value)) < 0 ? -1 : 0;
    PyErr_Format(PyExc_TypeError, "constraint: there is no %R; at, derivative, value, direction", key);
    return -1;
}

static int read_constraint(py_request *request, PyObject *object, int dim, pia_constraint *out)
{
    PyObject *dict = copy_dict(object, "constraint", "{'at': 17} or {'at': 0.5, 'derivative': 1, 'value': [1, 0]}");
    if (dict == NULL) return -1;
    int code = 0, placed = 0;
    pia_constraint_init(out);
    Py_ssize_t position = 0;
    PyObject *key, *value;
    while (code == 0 && PyDict_Next(dict, &position, &key, &value)) {
        if (!PyUnicode_Check(key)) {
            PyErr_SetString(PyExc_TypeError, "constraint: keys are words");
            code = -1;
            break;
        }
        placed |= PyUnicode_CompareWithASCIIString(key, "at") == 0;
        code = read_member(request, key, value, dim, out);
    }
    Py_DECREF(dict);
    if (code < 0 || placed) return code;
    PyErr_SetString(PyExc_ValueError, "constraint: 'at' is missing: a data row, a parameter, or a pair (u, v)");
    return -1;
}

int request_constraints(py_request *request, PyObject *list, int dim, const pia_constraint **out, pia_index *count)
{
    PyObject *tuple = PyDict_Check(list) ? PyTuple_Pack(1, list) : PySequence_Tuple(list);
    if (tuple == NULL) return -1;
    Py_ssize_t length = PyTuple_Size(tuple);
    pia_constraint *constraint = request_keep(request, length, sizeof *constraint);
    int code = constraint != NULL ? 0 : -1;
    for (Py_ssize_t i = 0; code == 0 && i < length; i++)
        code = read_constraint(request, PyTuple_GetItem(tuple, i), dim, &constraint[i]);
    Py_DECREF(tuple);
    *out = constraint;
    *count = length;
    return code;
}

static const char *keep_setting(py_request *request, PyObject *name, PyObject *value)
{
    PyObject *line = PyUnicode_FromFormat("%S=%S", name, value);
    Py_ssize_t size;
    const char *utf8 = line != NULL ? PyUnicode_AsUTF8AndSize(line, &size) : NULL;
    char *copy = utf8 != NULL ? request_keep(request, size, 1) : NULL;
    if (copy != NULL) memcpy(copy, utf8, (size_t)size);
    Py_XDECREF(line);
    return copy;
}

/* {"omega": 1.5} as the texts "omega=1.5". */
static int put_settings(py_request *request, PyObject *value, const char *what, const char *const **out, pia_index *count)
{
    PyObject *settings = copy_dict(value, what, "{'omega': 1.5}");
    const char **text = settings != NULL ? request_keep(request, PyDict_Size(settings), sizeof *text) : NULL;
    Py_ssize_t position = 0;
    PyObject *name, *setting;
    int code = text != NULL ? 0 : -1;
    for (*count = 0; code == 0 && PyDict_Next(settings, &position, &name, &setting);) {
        text[*count] = keep_setting(request, name, setting);
        code = text[(*count)++] != NULL ? 0 : -1;
    }
    Py_XDECREF(settings);
    *out = text;
    return code;
}

/* Numbers of one or two directions; one stands for both. */
static int put_number(const pia_option *option, int d, PyObject *value, char *member)
{
    if (option->type == PIA_OPTION_SWITCH) {
        ((int *)(void *)member)[d] = PyObject_IsTrue(value);
    } else if (option->type == PIA_OPTION_NUMBER) {
        ((double *)(void *)member)[d] = PyFloat_AsDouble(value);
    } else {
        PyObject *whole = PyNumber_Index(value);
        long long count = whole != NULL ? PyLong_AsLongLong(whole) : -1;
        Py_XDECREF(whole);
        if (option->type == PIA_OPTION_COUNT)
            ((pia_index *)(void *)member)[d] = count;
        else
            ((int *)(void *)member)[d] = count < INT32_MIN || count > INT32_MAX ? INT32_MAX : (int)count;
    }
    return PyErr_Occurred() != NULL ? -1 : 0;
}

/* Item d of a pair, or the one value for all directions; a new reference. */
static PyObject *choose_direction(const pia_option *option, PyObject *value, int d, int directions)
{
    int paired = option->directions == 2 && PySequence_Check(value) && !PyUnicode_Check(value);
    if (!paired) return Py_NewRef(value);
    Py_ssize_t length = PySequence_Size(value);
    if (length == directions) return PySequence_GetItem(value, d);
    if (length >= 0) PyErr_Format(PyExc_ValueError, "%s: %zd values; give %d, one a direction", option->name, length, directions);
    return NULL;
}

static int put_array(py_request *request, const pia_option *option, PyObject *value, int d)
{
    char *member = (char *)&request->options + option->offset, *count = (char *)&request->options + option->count_offset;
    if (option->automatic && PyUnicode_Check(value) && PyUnicode_CompareWithASCIIString(value, "auto") == 0) {
        *(pia_index *)(void *)count = PIA_AUTO;
        return 0;
    }
    if (option->type == PIA_OPTION_INDICES)
        return request_indices(request, value, option->name, (const pia_index **)(void *)member, (pia_index *)(void *)count);
    if (option->type == PIA_OPTION_SETTINGS)
        return put_settings(request, value, option->name, (const char *const **)(void *)member, (pia_index *)(void *)count);
    if (option->type == PIA_OPTION_CONSTRAINTS)
        return request_constraints(request, value, request->data.dim - request->data.function_graph,
                                   (const pia_constraint **)(void *)member, (pia_index *)(void *)count);
    if (option->type == PIA_OPTION_JOINS)
        return request_joins(request, value, (const pia_join **)(void *)member, (pia_index *)(void *)count);
    const py_numbers *numbers = keep_numbers(request, value, option->name);
    if (numbers == NULL) return -1;
    ((const double **)(void *)member)[d] = numbers->value;
    ((pia_index *)(void *)count)[d] = numbers->count;
    return 0;
}

static int put_value(py_request *request, const pia_option *option, PyObject *value, int d)
{
    char *member = (char *)&request->options + option->offset;
    if (option->type <= PIA_OPTION_NUMBER) return put_number(option, d, value, member);
    if (option->type == PIA_OPTION_NAME) {
        if (!PyUnicode_Check(value)) PyErr_SetString(PyExc_TypeError, "a name is needed");
        *(const char **)(void *)member = PyErr_Occurred() == NULL ? PyUnicode_AsUTF8AndSize(value, NULL) : NULL;
        return PyErr_Occurred() == NULL ? 0 : -1;
    }
    if (option->type == PIA_OPTION_MODEL) return (*(const pia_model **)(void *)member = model_of(value)) != NULL ? 0 : -1;
    return put_array(request, option, value, d);
}

/* Puts the option's name before the message of a TypeError or ValueError. */
static void name_option(const char *name)
{
    if (!PyErr_ExceptionMatches(PyExc_TypeError) && !PyErr_ExceptionMatches(PyExc_ValueError)) return;
    PyObject *type, *value, *traced;
    PyErr_Fetch(&type, &value, &traced);
    PyErr_NormalizeException(&type, &value, &traced);
    PyErr_Format(type, "%s: %S", name, value);
    Py_XDECREF(type);
    Py_XDECREF(value);
    Py_XDECREF(traced);
}

/* A curve has one direction, but single values may still be given as one. */
static int put_option(py_request *request, const pia_option *option, PyObject *value)
{
    int directions = request->data.kind == PIA_CURVE || option->directions == 1 ? 1 : 2;
    /* The knots of a curve are one vector, those of a surface a pair of them. */
    int whole = option->type == PIA_OPTION_NUMBERS && directions == 1;
    for (int d = 0; d < directions; d++) {
        PyObject *item = whole ? Py_NewRef(value) : choose_direction(option, value, d, directions);
        int code = item != NULL ? put_value(request, option, item, d) : -1;
        if (code < 0 && item != NULL && option->count_offset == 0) name_option(option->name);
        Py_XDECREF(item); /* what was borrowed of it, `value` or a buffer keeps */
        if (code < 0) return -1;
    }
    return 0;
}

static int find_option(PyObject *name, pia_option *out)
{
    for (pia_index i = 0; pia_list_options(i, out); i++)
        if (PyUnicode_CompareWithASCIIString(name, out->name) == 0) return 0;
    PyErr_Format(PyExc_TypeError, "a fit has no option %R", name);
    return -1;
}

static int put_options(py_request *request, PyObject *options)
{
    PyObject *name, *value;
    Py_ssize_t position = 0;
    pia_option option;
    while (PyDict_Next(options, &position, &name, &value)) {
        if (value == Py_None) continue;
        if (find_option(name, &option) < 0 || put_option(request, &option, value) < 0) return -1;
    }
    return 0;
}

/* ---- data ---- */

static int refuse_shape(const char *what, const py_numbers *numbers, const char *needed)
{
    PyErr_Format(binding.errors[PIA_E_SHAPE], "%s: %d axes, %zd numbers; %s", what, numbers->axes, numbers->count, needed);
    return -1;
}

static int put_points(py_request *request, int kind, PyObject *points)
{
    pia_data *data = &request->data;
    const py_numbers *numbers = &request->points;
    if (numbers_take(points, "points", &request->points) < 0) return -1;
    if (numbers->axes != (kind == PIA_GRID ? 3 : 2))
        return refuse_shape("points", numbers,
                            kind == PIA_GRID ? "a grid is [rows, columns, components]" : "points are [count, components]");
    data->kind = kind == FUNCTION_GRAPH ? PIA_CURVE : (pia_kind)kind;
    data->function_graph = kind == FUNCTION_GRAPH;
    data->points = numbers->value;
    data->count[0] = numbers->shape[0];
    if (kind == PIA_GRID) data->count[1] = numbers->shape[1];
    Py_ssize_t dim = numbers->shape[numbers->axes - 1];
    data->dim = dim > PIA_MAX_DIM ? PIA_MAX_DIM + 1 : (int)dim;
    return 0;
}

/* One of the arrays beside the points. */
static int put_beside(PyObject *object, const char *what, pia_index wanted, py_numbers *numbers, const double **out)
{
    if (object == Py_None) return 0;
    if (numbers_take(object, what, numbers) < 0) return -1;
    if (numbers->count != wanted) {
        PyErr_Format(binding.errors[PIA_E_SHAPE], "%s: %zd numbers, but these points need %lld", what, numbers->count,
                     (long long)wanted);
        return -1;
    }
    *out = numbers->value;
    return 0;
}

int request_take(int kind, PyObject *points, PyObject *parameters, PyObject *weights, PyObject *tolerances, PyObject *options,
                 py_request *out)
{
    memset(out, 0, sizeof *out);
    pia_data_init(&out->data);
    pia_fit_options_init(&out->options);
    pia_data *data = &out->data;
    if (put_points(out, kind, points) < 0) return -1;
    pia_index rows = data->count[0] * data->count[1];
    pia_index given = kind == PIA_GRID ? data->count[0] + data->count[1] : kind == PIA_SCATTERED ? 2 * rows : rows;
    if (put_beside(parameters, "parameters", given, &out->parameters, &data->parameters) < 0) return -1;
    if (put_beside(weights, "weights", rows, &out->weights, &data->weights) < 0) return -1;
    if (put_beside(tolerances, "tolerances", rows, &out->tolerances, &data->tolerances) < 0) return -1;
    return options != Py_None ? put_options(out, options) : 0;
}
