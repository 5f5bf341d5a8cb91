/* Contexts are kept in a list and used again: models may live longer than the call that made them, and so may their context. */
#include "binding.h"

#include <time.h>

static py_worker *idle; /* as many as worked at the same time; they live as long as the process */

/* Signals are looked for this often, so that a short fit never waits for the lock. */
static const double SECONDS_BETWEEN_LOOKS = 0.05;

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

void worker_begin(py_worker *worker)
{
    worker->asked = now();
    worker->python = PyEval_SaveThread();
}

void worker_end(py_worker *worker)
{
    PyEval_RestoreThread(worker->python);
    worker->python = NULL;
}

/* Python's turn in the middle of the work; `call` is NULL where only signals are looked for. Returns 1 when the work is to stop. */
static int let_python(py_worker *worker, const pia_report *so_far)
{
    worker_end(worker);
    int stop = PyErr_CheckSignals() < 0;
    if (!stop && so_far != NULL) {
        PyObject *members = report_dict(so_far);
        PyObject *report = members != NULL ? PyObject_CallFunctionObjArgs(worker->report, members, NULL) : NULL;
        PyObject *answer = report != NULL ? PyObject_CallFunctionObjArgs(worker->progress, report, NULL) : NULL;
        stop = answer == NULL || PyObject_IsTrue(answer) != 0;
        Py_XDECREF(members);
        Py_XDECREF(report);
        Py_XDECREF(answer);
    }
    if (PyErr_Occurred() != NULL) PyErr_Fetch(&worker->type, &worker->value, &worker->traced);
    worker_begin(worker);
    return stop;
}

static int look_for_signals(void *user)
{
    py_worker *worker = user;
    if (worker->python == NULL) return 0;
    if (worker->type != NULL) return 1;
    return now() - worker->asked >= SECONDS_BETWEEN_LOOKS && let_python(worker, NULL);
}

int worker_progress(void *user, const pia_report *so_far)
{
    py_worker *worker = user;
    return worker->type != NULL || let_python(worker, so_far);
}

void worker_ask(py_worker *worker, pia_fit_options *options, PyObject *progress, PyObject *report)
{
    if (progress == Py_None) return;
    worker->progress = progress;
    worker->report = report;
    options->progress = worker_progress;
    options->user = worker;
}

static py_worker *hire(void)
{
    py_worker *worker = PyMem_Calloc(1, sizeof *worker);
    if (worker == NULL) {
        PyErr_NoMemory();
        return NULL;
    }
    pia_context_options options;
    pia_context_options_init(&options);
    options.interrupted = look_for_signals;
    options.user = worker;
    pia_status status = pia_context_create(&options, &worker->context);
    worker->threads = PIA_AUTO;
    if (status == PIA_OK) return worker;
    PyErr_SetString(binding.errors[status], pia_strerror(status));
    PyMem_Free(worker);
    return NULL;
}

py_worker *worker_take(int threads)
{
    py_worker *worker = idle != NULL ? idle : hire();
    if (worker == NULL) return NULL;
    if (worker == idle) idle = worker->next;
    worker->next = NULL;
    pia_status status = worker->threads != threads ? pia_context_set_threads(worker->context, threads) : PIA_OK;
    if (status == PIA_OK) {
        worker->threads = threads;
        return worker;
    }
    worker_check(worker, status);
    worker_give(worker);
    return NULL;
}

void worker_give(py_worker *worker)
{
    if (worker == NULL) return;
    Py_CLEAR(worker->type);
    Py_CLEAR(worker->value);
    Py_CLEAR(worker->traced);
    worker->progress = worker->report = NULL;
    worker->next = idle;
    idle = worker;
}

int worker_raise(py_worker *worker, PyObject *model)
{
    if (worker->type == NULL) return 0;
    PyErr_NormalizeException(&worker->type, &worker->value, &worker->traced);
    if (model != NULL && PyObject_SetAttr(worker->value, binding.model_name, model) < 0) PyErr_Clear(); /* the exception matters more */
    PyErr_Restore(worker->type, worker->value, worker->traced);
    worker->type = worker->value = worker->traced = NULL;
    return -1;
}

int worker_check(py_worker *worker, pia_status status)
{
    if (status == PIA_OK) return worker_raise(worker, NULL);
    if (worker->type != NULL) return worker_raise(worker, NULL);
    const char *message = pia_message(worker->context);
    PyErr_SetString(binding.errors[status], *message != '\0' ? message : pia_strerror(status));
    return -1;
}
