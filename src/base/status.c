#include "pia/pia.h"

const char *pia_strerror(pia_status status)
{
    switch (status) {
    case PIA_OK: return "no error";
    case PIA_E_ARGUMENT: return "an argument is out of its range, unknown, or does not go with another";
    case PIA_E_SHAPE: return "counts or dimensions do not fit together";
    case PIA_E_DATA: return "these points cannot be fitted as asked";
    case PIA_E_CONSTRAINT: return "the constraints cannot be met together";
    case PIA_E_MEMORY: return "out of memory";
    case PIA_E_SIZE: return "a size does not fit in 64 bits";
    case PIA_E_UNAVAILABLE: return "this build or machine lacks the part that was asked for";
    case PIA_E_FORMAT: return "the file does not hold what its format promises";
    case PIA_E_FILE: return "the operating system refused the file";
    case PIA_E_INTERNAL: return "a defect of the library";
    }
    return "an unknown status";
}

const char *pia_stop_name(pia_stop stop)
{
    switch (stop) {
    case PIA_STOP_NONE: return "none";
    case PIA_STOP_TOLERANCE: return "tolerance";
    case PIA_STOP_CHANGE: return "change";
    case PIA_STOP_GRADIENT: return "gradient";
    case PIA_STOP_ITERATIONS: return "iterations";
    case PIA_STOP_TIME: return "time";
    case PIA_STOP_CANCELLED: return "cancelled";
    case PIA_STOP_STALLED: return "stalled";
    case PIA_STOP_FINITE: return "finite";
    case PIA_STOP_NO_KNOT_LEFT: return "no-knot-left";
    case PIA_STOP_INFEASIBLE: return "infeasible";
    }
    return "unknown";
}

const char *pia_version(void)
{
    return PIA_VERSION;
}
