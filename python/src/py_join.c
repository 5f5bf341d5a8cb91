/* Neighbours that a fit goes on from. */
#include "binding.h"

static const char *const edges[] = {"u0", "u1", "v0", "v1", "start", "end", NULL}; /* the last two are the first two */
static const char *const continuities[] = {"C0", "G1", "C1", NULL};

/* The place of a word in a list; -1 with ValueError. */
static int find_word(PyObject *value, const char *key, const char *const *words, const char *all)
{
    for (int i = 0; PyUnicode_Check(value) && words[i] != NULL; i++)
        if (PyUnicode_CompareWithASCIIString(value, words[i]) == 0) return i;
    PyErr_Format(PyExc_ValueError, "join: %s is %R; %s", key, value, all);
    return -1;
}

static int read_edge(PyObject *value, const char *key, pia_edge *out)
{
    int edge = find_word(value, key, edges, "'start' or 'end', of a surface 'u0', 'u1', 'v0' or 'v1'");
    *out = (pia_edge)(edge % 4);
    return edge < 0 ? -1 : 0;
}

static int read_continuity(PyObject *value, pia_continuity *out)
{
    int continuity = find_word(value, "continuity", continuities, "'C0', 'G1' or 'C1'");
    *out = (pia_continuity)continuity;
    return continuity < 0 ? -1 : 0;
}

static int read_neighbour(py_request *request, PyObject *value, pia_join *out)
{
    out->neighbour = model_of(value);
    return out->neighbour != NULL ? request_hold(request, value) : -1;
}

static int read_member(py_request *request, PyObject *key, PyObject *value, pia_join *out)
{
    if (PyUnicode_CompareWithASCIIString(key, "join") == 0) return read_neighbour(request, value, out);
    if (PyUnicode_CompareWithASCIIString(key, "end") == 0) return read_edge(value, "end", &out->edge);
    if (PyUnicode_CompareWithASCIIString(key, "to") == 0) return read_edge(value, "to", &out->neighbour_edge);
    if (PyUnicode_CompareWithASCIIString(key, "continuity") == 0) return read_continuity(value, &out->continuity);
    if (PyUnicode_CompareWithASCIIString(key, "reversed") == 0) return (out->reversed = PyObject_IsTrue(value)) < 0 ? -1 : 0;
    PyErr_Format(PyExc_TypeError, "join: there is no %R; join, end, to, continuity, reversed", key);
    return -1;
}

static int read_join(py_request *request, PyObject *object, pia_join *out)
{
    PyObject *dict = copy_dict(object, "join", "{'join': model, 'end': 'start', 'continuity': 'G1'}");
    PyObject *to = dict != NULL ? PyDict_GetItemString(dict, "to") : NULL,
             *end = dict != NULL ? PyDict_GetItemString(dict, "end") : NULL;
    Py_ssize_t position = 0;
    PyObject *key, *value;
    int code = dict != NULL ? 0 : -1;
    pia_join_init(out);
    while (code == 0 && PyDict_Next(dict, &position, &key, &value)) {
        if (!PyUnicode_Check(key)) {
            PyErr_SetString(PyExc_TypeError, "join: keys are words");
            code = -1;
        } else {
            code = read_member(request, key, value, out);
        }
    }
    if (code == 0 && (out->neighbour == NULL || end == NULL)) {
        PyErr_SetString(PyExc_ValueError, "join: 'join', the neighbouring model, and 'end', the edge that goes on from it, are needed");
        code = -1;
    }
    if (to == NULL) out->neighbour_edge = (pia_edge)(out->edge ^ 1); /* the start of one goes on from the end of the other */
    Py_XDECREF(dict);
    return code;
}

int request_joins(py_request *request, PyObject *list, const pia_join **out, pia_index *count)
{
    PyObject *tuple = PyDict_Check(list) ? PyTuple_Pack(1, list) : PySequence_Tuple(list);
    if (tuple == NULL) return -1;
    Py_ssize_t length = PyTuple_Size(tuple);
    pia_join *join = request_keep(request, length, sizeof *join);
    int code = join != NULL ? 0 : -1;
    for (Py_ssize_t i = 0; code == 0 && i < length; i++) code = read_join(request, PyTuple_GetItem(tuple, i), &join[i]);
    Py_DECREF(tuple);
    *out = join;
    *count = length;
    return code;
}
