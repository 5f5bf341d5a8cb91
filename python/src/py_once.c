/* Fits in one call. */
#include "binding.h"

static PyObject *run_once(PyTypeObject *type, py_worker *worker, const py_request *request)
{
    pia_model *model = NULL;
    pia_report report = {.struct_size = sizeof report}; /* asked for, so that the model knows its errors */
    worker_begin(worker);
    pia_status status = pia_fit_data(worker->context, &request->data, &request->options, &model, &report);
    worker_end(worker);
    if (status != PIA_OK) {
        worker_check(worker, status);
        return NULL;
    }
    PyObject *result = model_wrap(type, model, NULL);
    if (result == NULL || worker_raise(worker, result) == 0) return result;
    Py_DECREF(result);
    return NULL;
}

/* fit(model type, report type, kind, points, parameters, weights, tolerances, options, threads, progress) */
static PyObject *fit_once(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *type, *report, *points, *parameters, *weights, *tolerances, *options, *progress, *result = NULL;
    int kind, threads;
    if (!PyArg_ParseTuple(arguments, "O!OiOOOOOiO", &PyType_Type, &type, &report, &kind, &points, &parameters, &weights, &tolerances,
                          &options, &threads, &progress))
        return NULL;
    py_request request;
    py_worker *worker = NULL;
    if (request_take(kind, points, parameters, weights, tolerances, options, &request) == 0) worker = worker_take(threads);
    if (worker != NULL) {
        worker_ask(worker, &request.options, progress, report);
        result = run_once((PyTypeObject *)(void *)type, worker, &request);
    }
    worker_give(worker);
    request_give(&request);
    return result;
}

/* suggest_tolerance(kind, points) -> (tolerance, noise) */
static PyObject *suggest_tolerance(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *points, *result = NULL;
    int kind;
    double tolerance = 0, noise = 0;
    if (!PyArg_ParseTuple(arguments, "iO", &kind, &points)) return NULL;
    py_request request;
    py_worker *worker = NULL;
    if (request_take(kind, points, Py_None, Py_None, Py_None, Py_None, &request) == 0) worker = worker_take(PIA_AUTO);
    if (worker != NULL) {
        worker_begin(worker);
        pia_status status = pia_suggest_tolerance(worker->context, &request.data, &tolerance, &noise);
        worker_end(worker);
        if (worker_check(worker, status) == 0) result = Py_BuildValue("(dd)", tolerance, noise);
    }
    worker_give(worker);
    request_give(&request);
    return result;
}

PyMethodDef fit_functions[] = {
    {"fit", fit_once, METH_VARARGS, NULL},
    {"suggest_tolerance", suggest_tolerance, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};
