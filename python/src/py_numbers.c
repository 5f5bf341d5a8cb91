#include "binding.h"

#include <stdalign.h>
#include <string.h>

/* ---- buffers ---- */

/* How the items of a buffer are to be read: 'f' float, 'i' signed, 'u' unsigned; 0 when they are no numbers that fit a double. */
typedef struct item_format {
    char kind;
    int swapped;
    Py_ssize_t size;
} item_format;

static item_format read_format(const Py_buffer *view)
{
    const char *text = view->format != NULL ? view->format : "B";
    item_format format = {0, 0, view->itemsize};
    if (strchr("<>=@!", *text) != NULL && *text != '\0') {
        int big = *text == '>' || *text == '!', little = *text == '<';
        format.swapped = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? little : big;
        text++;
    }
    if (*text == '\0' || text[1] != '\0') return format;
    if (strchr("fd", *text) != NULL && (format.size == 4 || format.size == 8)) format.kind = 'f';
    if (strchr("bhilqn", *text) != NULL && format.size <= 8) format.kind = 'i';
    if (strchr("?BHILQN", *text) != NULL && format.size <= 8) format.kind = 'u';
    return format;
}

static double read_item(const unsigned char *at, const item_format *format)
{
    unsigned char bytes[8];
    for (Py_ssize_t i = 0; i < format->size; i++) bytes[i] = at[format->swapped ? format->size - 1 - i : i];
    if (format->kind == 'f' && format->size == 8) {
        double value;
        memcpy(&value, bytes, sizeof value);
        return value;
    }
    if (format->kind == 'f') {
        float value;
        memcpy(&value, bytes, sizeof value);
        return (double)value;
    }
    uint8_t one;
    uint16_t two;
    uint32_t four;
    uint64_t eight;
    int is_signed = format->kind == 'i';
    switch (format->size) {
    case 1: memcpy(&one, bytes, sizeof one); return is_signed ? (double)(int8_t)one : (double)one;
    case 2: memcpy(&two, bytes, sizeof two); return is_signed ? (double)(int16_t)two : (double)two;
    case 4: memcpy(&four, bytes, sizeof four); return is_signed ? (double)(int32_t)four : (double)four;
    default: memcpy(&eight, bytes, sizeof eight); return is_signed ? (double)(int64_t)eight : (double)eight;
    }
}

/* Another axis: count is how many numbers there are with it, or too many to have. */
static void add_axis(py_numbers *out, Py_ssize_t length)
{
    out->shape[out->axes++] = length;
    if (__builtin_mul_overflow(out->count, length, &out->count)) out->count = PY_SSIZE_T_MAX;
}

static double *new_block(Py_ssize_t count)
{
    double *block = (size_t)count > PY_SSIZE_T_MAX / sizeof(double) ? NULL : PyMem_Malloc((size_t)count * sizeof(double));
    if (block == NULL) PyErr_NoMemory();
    return block;
}

/* Row-major order over the axes of any strided buffer. */
static void convert(const Py_buffer *view, const item_format *format, Py_ssize_t count, double *out)
{
    Py_ssize_t index[MOST_AXES] = {0};
    for (Py_ssize_t i = 0; i < count; i++) {
        out[i] = read_item(view->ndim > 0 ? PyBuffer_GetPointer(view, index) : view->buf, format);
        for (int axis = view->ndim - 1; axis >= 0 && ++index[axis] == view->shape[axis]; axis--) index[axis] = 0;
    }
}

static int take_view(const char *what, py_numbers *out)
{
    const Py_buffer *view = &out->view;
    item_format format = read_format(view);
    if (view->ndim > MOST_AXES) {
        PyErr_Format(PyExc_ValueError, "%s: %d axes; at most %d make sense here", what, view->ndim, MOST_AXES);
        return -1;
    }
    if (format.kind == 0) {
        PyErr_Format(PyExc_TypeError, "%s: items of format '%s' are no numbers that fit in a double; convert the array to float64",
                     what, view->format);
        return -1;
    }
    for (int axis = 0; axis < view->ndim; axis++) add_axis(out, view->shape[axis]);
    int is_double = format.kind == 'f' && format.size == sizeof(double) && !format.swapped;
    if (is_double && PyBuffer_IsContiguous(view, 'C') && (uintptr_t)view->buf % alignof(double) == 0) {
        out->value = view->buf;
        return 0;
    }
    out->value = out->copied = new_block(out->count);
    if (out->copied == NULL) return -1;
    convert(view, &format, out->count, out->copied);
    return 0;
}

/* ---- nested sequences ---- */

static int is_sequence(PyObject *object)
{
    return PySequence_Check(object) && !PyUnicode_Check(object) && !PyBytes_Check(object);
}

/* Shape of nested sequences by their first members. */
static int measure(PyObject *object, const char *what, py_numbers *out)
{
    PyObject *item = Py_NewRef(object);
    while (item != NULL && is_sequence(item)) {
        Py_ssize_t length = PySequence_Size(item);
        if (length < 0) break;
        if (out->axes == MOST_AXES) {
            PyErr_Format(PyExc_ValueError, "%s: sequences nested deeper than %d make no sense here", what, MOST_AXES);
            break;
        }
        add_axis(out, length);
        PyObject *first = length > 0 ? PySequence_GetItem(item, 0) : Py_NewRef(Py_None);
        Py_DECREF(item);
        item = first;
    }
    Py_XDECREF(item);
    return PyErr_Occurred() != NULL ? -1 : 0;
}

static int fill(PyObject *object, const char *what, const py_numbers *shape, int axis, double **at)
{
    if (axis == shape->axes) {
        *(*at)++ = PyFloat_AsDouble(object);
        return PyErr_Occurred() != NULL ? -1 : 0;
    }
    PyObject *sequence = is_sequence(object) ? PySequence_Tuple(object) : NULL;
    Py_ssize_t length = sequence != NULL ? PyTuple_Size(sequence) : -1;
    if (length != shape->shape[axis]) {
        if (PyErr_Occurred() == NULL)
            PyErr_Format(PyExc_ValueError, "%s: rows differ in length; the first holds %zd, another %zd", what, shape->shape[axis],
                         length > 0 ? length : 0);
        Py_XDECREF(sequence);
        return -1;
    }
    int code = 0;
    for (Py_ssize_t i = 0; code == 0 && i < length; i++) code = fill(PyTuple_GetItem(sequence, i), what, shape, axis + 1, at);
    Py_DECREF(sequence);
    return code;
}

static int take_sequence(PyObject *object, const char *what, py_numbers *out)
{
    if (measure(object, what, out) < 0) return -1;
    out->value = out->copied = new_block(out->count);
    if (out->copied == NULL) return -1;
    double *at = out->copied;
    return out->count > 0 ? fill(object, what, out, 0, &at) : 0;
}

/* ---- both ---- */

int numbers_take(PyObject *object, const char *what, py_numbers *out)
{
    memset(out, 0, sizeof *out);
    out->count = 1;
    if (PyObject_CheckBuffer(object)) {
        if (PyObject_GetBuffer(object, &out->view, PyBUF_FULL_RO) < 0) return -1;
        out->viewed = 1;
        return take_view(what, out);
    }
    if (PyObject_HasAttr(object, binding.array)) {
        PyObject *array = PyObject_CallMethodObjArgs(object, binding.array, NULL);
        int code = array == NULL ? -1 : 0;
        if (code == 0 && !PyObject_CheckBuffer(array)) {
            PyErr_Format(PyExc_TypeError, "%s: __array__ gave no buffer", what);
            code = -1;
        }
        if (code == 0) code = numbers_take(array, what, out); /* its view keeps the array alive */
        Py_XDECREF(array);
        return code;
    }
    if (is_sequence(object) || PyNumber_Check(object)) return take_sequence(object, what, out);
    PyObject *tuple = PySequence_Tuple(object); /* any iterable */
    if (tuple == NULL) {
        if (PyErr_ExceptionMatches(PyExc_TypeError))
            PyErr_Format(PyExc_TypeError, "%s: an array or nested sequences of numbers are needed", what);
        return -1;
    }
    int code = take_sequence(tuple, what, out);
    Py_DECREF(tuple);
    return code;
}

void numbers_give(py_numbers *numbers)
{
    if (numbers->viewed) PyBuffer_Release(&numbers->view);
    PyMem_Free(numbers->copied);
    memset(numbers, 0, sizeof *numbers);
}

PyObject *numbers_new(Py_ssize_t count, double **out)
{
    if (count < 0 || (size_t)count > PY_SSIZE_T_MAX / sizeof(double)) return PyErr_NoMemory();
    PyObject *bytes = PyByteArray_FromStringAndSize(NULL, count * (Py_ssize_t)sizeof(double));
    if (bytes == NULL) return NULL;
    PyObject *view = PyMemoryView_FromObject(bytes);
    *out = (double *)(void *)PyByteArray_AsString(bytes);
    Py_DECREF(bytes);
    PyObject *doubles = view != NULL ? PyObject_CallMethodObjArgs(view, binding.cast, binding.doubles, NULL) : NULL;
    Py_XDECREF(view);
    return doubles;
}

PyObject *numbers_copy(const double *value, pia_index count)
{
    double *to;
    PyObject *view = numbers_new((Py_ssize_t)count, &to);
    if (view != NULL && count > 0) memcpy(to, value, (size_t)count * sizeof *to);
    return view;
}
