#include "binding.h"

#include <math.h>

static const char *kind_name(pia_kind kind)
{
    return kind == PIA_CURVE ? "curve" : kind == PIA_GRID ? "grid" : "surface";
}

/* Takes over the reference. */
static int put(PyObject *dict, const char *name, PyObject *value)
{
    int code = value != NULL ? PyDict_SetItemString(dict, name, value) : -1;
    Py_XDECREF(value);
    return code;
}

static PyObject *number_or_none(double value)
{
    return isnan(value) ? Py_NewRef(Py_None) : PyFloat_FromDouble(value);
}

/* One value for a curve, a pair for a surface. */
static PyObject *each_way(const pia_report *report, pia_index u, pia_index v)
{
    return report->kind == PIA_CURVE ? PyLong_FromLongLong(u) : Py_BuildValue("(LL)", (long long)u, (long long)v);
}

static int put_words(PyObject *dict, const pia_report *r)
{
    const struct {
        const char *name, *text;
    } word[] = {
        {"kind", kind_name(r->kind)},
        {"method", r->method},
        {"parametrization", r->parametrization},
        {"placement", r->placement},
        {"limiter", r->limiter},
        {"stop", pia_stop_name(r->stop)},
        {"measure", r->measure_distance ? "distance" : "parametric"},
    };
    for (size_t i = 0; i < sizeof word / sizeof *word; i++)
        if (put(dict, word[i].name, PyUnicode_FromString(word[i].text)) < 0) return -1;
    return 0;
}

static int put_counts(PyObject *dict, const pia_report *r)
{
    const struct {
        const char *name;
        pia_index count;
    } item[] = {
        {"control_count", r->control_count},     {"point_count", r->point_count},       {"iterations", r->iterations},
        {"max_error_index", r->max_error_index}, {"repaired_count", r->repaired_count}, {"unsupported_count", r->unsupported_count},
        {"outlier_count", r->outlier_count},     {"round_count", r->round_count},
    };
    for (size_t i = 0; i < sizeof item / sizeof *item; i++)
        if (put(dict, item[i].name, PyLong_FromLongLong(item[i].count)) < 0) return -1;
    return 0;
}

static int put_numbers(PyObject *dict, const pia_report *r)
{
    const struct {
        const char *name;
        double value;
    } item[] = {
        {"max_error", r->max_error},
        {"rms_error", r->rms_error},
        {"start_error", r->start_error},
        {"constraint_error", r->constraint_error},
        {"relative_gradient", r->relative_gradient},
        {"rate", r->rate},
        {"between_error", r->between_error},
        {"seconds", r->seconds},
    };
    for (size_t i = 0; i < sizeof item / sizeof *item; i++)
        if (put(dict, item[i].name, number_or_none(item[i].value)) < 0) return -1;
    return 0;
}

static PyObject *axis_errors(const pia_report *r, Py_ssize_t count)
{
    PyObject *errors = PyTuple_New(count);
    for (Py_ssize_t d = 0; errors != NULL && d < count; d++) {
        PyObject *error = PyFloat_FromDouble(r->axis_error[d]);
        if (error == NULL || PyTuple_SetItem(errors, d, error) < 0) Py_CLEAR(errors);
    }
    return errors;
}

static int put_axes(PyObject *dict, const pia_report *r)
{
    Py_ssize_t count = 0;
    while (r->worst_axis != PIA_AUTO && count < PIA_MAX_DIM && !isnan(r->axis_error[count])) count++;
    if (put(dict, "axis_error", count > 0 ? axis_errors(r, count) : Py_NewRef(Py_None)) < 0) return -1;
    return put(dict, "worst_axis", count > 0 ? PyLong_FromLong(r->worst_axis) : Py_NewRef(Py_None));
}

PyObject *report_dict(const pia_report *r)
{
    PyObject *dict = PyDict_New();
    if (dict == NULL) return NULL;
    PyObject *reached = r->reached == PIA_AUTO ? Py_NewRef(Py_None) : PyBool_FromLong(r->reached);
    if (put(dict, "reached", reached) == 0 && put(dict, "degree", each_way(r, r->degree[0], r->degree[1])) == 0 &&
        put(dict, "control", each_way(r, r->control[0], r->control[1])) == 0 && put_words(dict, r) == 0 && put_counts(dict, r) == 0 &&
        put_numbers(dict, r) == 0 && put_axes(dict, r) == 0)
        return dict;
    Py_DECREF(dict);
    return NULL;
}
