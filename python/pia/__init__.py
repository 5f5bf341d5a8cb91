"""B-spline and NURBS curves and surfaces fitted to points by progressive-iterative approximation.

    import pia
    model = pia.fit_curve(points, tolerance=0.01)
    model.report.max_error, model.control, model(0.5)
    model.save('curve.step')

Fits: fit_curve, fit_function, fit_grid, fit_surface; Fit goes step by step. Models: Model, load, load_all, save, plot. Points: read_points,
read_parts, suggest_tolerance. What there is: options, registry, settings. Failures are pia.Error.

Arrays come back as NumPy arrays where NumPy is installed, else as nested lists; NumPy is not needed.
"""

from . import _errors, _pia
from ._errors import *  # noqa: F403
from ._errors import Error
from ._files import load, load_all, plot, read_parts, read_points, save
from ._fit import Fit, fit_curve, fit_function, fit_grid, fit_surface, suggest_tolerance
from ._model import Model
from ._options import Entry, Option, Setting, options, registry, settings
from ._report import Deviation, Report, TraceRow

__version__ = _pia.version

__all__ = [
    "Deviation",
    "Entry",
    "Error",
    "Fit",
    "Model",
    "Option",
    "Report",
    "Setting",
    "TraceRow",
    "fit_curve",
    "fit_function",
    "fit_grid",
    "fit_surface",
    "load",
    "load_all",
    "options",
    "plot",
    "read_parts",
    "read_points",
    "registry",
    "save",
    "settings",
    "suggest_tolerance",
    *(name for name, value in vars(_errors).items() if isinstance(value, type)),
]
