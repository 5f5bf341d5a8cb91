/* The module: types, exceptions, registries. One per process: the state below is not shared out to interpreters. */
#include "binding.h"

struct binding binding;

/* ---- registries ---- */

/* entries(registry) -> [(name, title, reference, detail)] */
static PyObject *entries(PyObject *module, PyObject *arguments)
{
    (void)module;
    const char *registry;
    pia_entry entry;
    if (!PyArg_ParseTuple(arguments, "s", &registry)) return NULL;
    PyObject *list = PyList_New(0);
    for (pia_index i = 0; list != NULL && pia_list(registry, i, &entry); i++) {
        PyObject *item = Py_BuildValue("(zzzz)", entry.name, entry.title, entry.reference, entry.detail);
        if (item == NULL || PyList_Append(list, item) < 0) Py_CLEAR(list);
        Py_XDECREF(item);
    }
    return list;
}

/* settings(method or limiter) -> [(name, values, initial, minimum, maximum, sentence)] */
static PyObject *settings(PyObject *module, PyObject *arguments)
{
    (void)module;
    const char *name;
    pia_parameter p;
    if (!PyArg_ParseTuple(arguments, "s", &name)) return NULL;
    PyObject *list = PyList_New(0);
    for (pia_index i = 0; list != NULL && pia_list_parameters(name, i, &p); i++) {
        PyObject *item = Py_BuildValue("(zzzddz)", p.name, p.values, p.initial, p.minimum, p.maximum, p.sentence);
        if (item == NULL || PyList_Append(list, item) < 0) Py_CLEAR(list);
        Py_XDECREF(item);
    }
    return list;
}

/* options() -> [(name, type, directions, automatic, minimum, maximum, initial, values, sentence)] */
static PyObject *options(PyObject *module, PyObject *nothing)
{
    (void)module, (void)nothing;
    static const char *const type[] = {"switch",  "integer", "count",       "number", "name", "dict",
                                       "indices", "numbers", "constraints", "model",  "joins"};
    pia_option o;
    PyObject *list = PyList_New(0);
    for (pia_index i = 0; list != NULL && pia_list_options(i, &o); i++) {
        PyObject *item = Py_BuildValue("(ssiidddzs)", o.name, type[o.type], o.directions, o.automatic, o.minimum, o.maximum, o.initial,
                                       o.values, o.sentence);
        if (item == NULL || PyList_Append(list, item) < 0) Py_CLEAR(list);
        Py_XDECREF(item);
    }
    return list;
}

PyMethodDef list_functions[] = {
    {"entries", entries, METH_VARARGS, NULL},
    {"settings", settings, METH_VARARGS, NULL},
    {"options", options, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

/* ---- the module ---- */

/* Exception classes by status, from the package's Python part. */
static int find_errors(void)
{
    static const char *const name[] = {
        [PIA_OK] = "Error",         [PIA_E_ARGUMENT] = "ArgumentError",       [PIA_E_SHAPE] = "ShapeError",
        [PIA_E_DATA] = "DataError", [PIA_E_CONSTRAINT] = "ConstraintError",   [PIA_E_MEMORY] = "OutOfMemory",
        [PIA_E_SIZE] = "SizeError", [PIA_E_UNAVAILABLE] = "UnavailableError", [PIA_E_FORMAT] = "FormatError",
        [PIA_E_FILE] = "FileError", [PIA_E_INTERNAL] = "InternalError",
    };
    PyObject *errors = PyImport_ImportModule("pia._errors");
    if (errors == NULL) return -1;
    for (int status = 0; status <= PIA_E_INTERNAL; status++) {
        binding.errors[status] = PyObject_GetAttrString(errors, name[status]);
        if (binding.errors[status] == NULL) break;
    }
    Py_DECREF(errors);
    return binding.errors[PIA_E_INTERNAL] != NULL ? 0 : -1;
}

static int intern_names(void)
{
    binding.cast = PyUnicode_InternFromString("cast");
    binding.doubles = PyUnicode_InternFromString("d");
    binding.array = PyUnicode_InternFromString("__array__");
    binding.model_name = PyUnicode_InternFromString("model");
    return binding.cast != NULL && binding.doubles != NULL && binding.array != NULL && binding.model_name != NULL ? 0 : -1;
}

static int add_type(PyObject *module, PyType_Spec *spec, PyTypeObject **out)
{
    *out = (PyTypeObject *)(void *)PyType_FromSpec(spec);
    return *out != NULL ? PyModule_AddType(module, *out) : -1;
}

static int fill(PyObject *module)
{
    if (intern_names() < 0 || find_errors() < 0 || add_type(module, &model_spec, &binding.model) < 0 ||
        add_type(module, &fit_spec, &binding.fit) < 0 || add_type(module, &points_spec, &binding.points) < 0)
        return -1;
    if (PyModule_AddFunctions(module, fit_functions) < 0 || PyModule_AddFunctions(module, file_functions) < 0 ||
        PyModule_AddFunctions(module, list_functions) < 0)
        return -1;
    return PyModule_AddStringConstant(module, "version", pia_version());
}

PyMODINIT_FUNC PyInit__pia(void);

PyMODINIT_FUNC PyInit__pia(void)
{
    static PyModuleDef definition = {.m_base = PyModuleDef_HEAD_INIT, .m_name = "pia._pia", .m_size = -1};
    PyObject *module = PyModule_Create(&definition);
    if (module != NULL && fill(module) < 0) Py_CLEAR(module);
    return module;
}
