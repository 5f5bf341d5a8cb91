"""Fits: in one call, and step by step."""

from . import _pia
from ._arrays import joined, listed, numpy, shape_of, shaped
from ._model import Model
from ._options import Arguments, documented
from ._report import Report, TraceRow, all_of

_kinds = {"curve": 0, "grid": 1, "surface": 2, "function": 3}


def _points(points, kind):
    """(points, rows) with heights turned into a grid of points."""
    points = listed(points)
    shape = shape_of(points)
    return points, (shape[0] * shape[1] if kind == "grid" and len(shape) > 1 else shape[0] if shape else 0)


def _fit(kind, points, options):
    points, rows = _points(points, kind)
    return _pia.fit(Model, Report, _kinds[kind], points, *Arguments(options, rows, kind == "grid").listed())


@documented
def fit_curve(points, **options):
    """Fits a curve to ordered points [count, dim]; returns a Model, whose report tells how.

    fit_curve(points)                    through every point
    fit_curve(points, tolerance=0.01)    as few control points as keep every point within 0.01
    fit_curve(points, control=40)        least squares with 40 control points

    points: an array of doubles is read in place; anything else is converted. It is not to be changed while the fit runs.

    Options, all by keyword:
    OPTIONS

    interpolate takes rows, also negative ones from the end, or 'ends'; corners rows or 'auto'. constraints is a list of dicts
    {'at': row or parameter, 'derivative': order, 'value': [dim], 'direction': True for a direction of any length}: a whole number is a
    row, a number with a point a parameter. joins is a list of dicts {'join': model, 'end': 'start' or 'end' (of a surface 'u0', 'u1',
    'v0' or 'v1'), 'to': that of the neighbour, by default the opposite one, 'continuity': 'C0', 'G1' or 'C1', 'reversed': True where
    the parameters along the edges run against each other}. method_options and limiter_options are dicts, see pia.settings.

    Ctrl-C stops the fit: KeyboardInterrupt is raised with the best model so far as its attribute `model`. So is an exception of the
    progress callback. A callback that answers True stops too, and the model is returned with report.stop 'cancelled'.
    Raises pia.Error.
    """
    return _fit("curve", points, options)


@documented
def fit_function(x, y=None, **options):
    """Fits a function graph: y over x, in any order. Returns a curve Model with points (x, y) at parameter x.

    x  [count] abscissas, or [count, 1 + k] with the values beside them
    y  [count] or [count, k] values

    Options as in fit_curve, all by keyword:
    OPTIONS
    """
    return _fit("function", x if y is None else joined((listed(x), listed(y))), options)


@documented
def fit_grid(points, *, x=None, y=None, **options):
    """Fits a surface to a grid of points [rows, columns, dim]; nan marks a hole (least squares). u runs over the rows.

    A matrix of heights [rows, columns] becomes points (x, y, z): x [columns] and y [rows] are its axes, by default 0, 1, 2, ...

    Options as in fit_curve, all by keyword; pairs (u, v) where a surface has two:
    OPTIONS
    """
    points = listed(points)
    if len(shape_of(points)) == 2:
        points = _raised(points, x, y)
    elif x is not None or y is not None:
        raise TypeError("x and y are the axes of a matrix of heights; these points have their own coordinates")
    return _fit("grid", points, options)


def _raised(heights, x, y):
    rows, columns = shape_of(heights)
    x = range(columns) if x is None else listed(x)
    y = range(rows) if y is None else listed(y)
    if len(x) != columns or len(y) != rows:
        raise ValueError(f"axes of {len(x)} and {len(y)} values do not fit heights of {rows} rows and {columns} columns")
    np = numpy()
    if np is not None:
        return np.stack([*np.meshgrid(np.asarray(x, float), np.asarray(y, float)), np.asarray(heights, float)], axis=-1)
    values = heights.tolist() if hasattr(heights, "tolist") else heights
    return [[(x[j], y[i], values[i][j]) for j in range(columns)] for i in range(rows)]


@documented
def fit_surface(points, **options):
    """Fits a surface to scattered points [count, dim]. parameters: [count, 2], or one of the names 'xy', 'plane', 'cylinder', 'sphere'.

    Options as in fit_curve, all by keyword; pairs (u, v) where a surface has two:
    OPTIONS
    """
    return _fit("surface", points, options)


def suggest_tolerance(points, kind="curve"):
    """(tolerance, noise): a tolerance that the noise in the points of a curve, grid or function graph suggests, and the standard
    deviation of that noise a component."""
    return _pia.suggest_tolerance(_kinds[kind], listed(points))


class Fit(_pia.Fit):
    """A fit in progress, to be stepped, looked at and edited.

        with pia.Fit(points, control=40, method='lspia') as fit:
            while not fit.step(10).max_error < 0.01: ...
            model = fit.model

    Fit(points, kind=None, **options). kind: 'curve', 'grid', 'surface' (scattered) or 'function'; None: by the axes of the points, two
    for a curve and three for a grid. Options are those of fit_curve. The points are copied. One thread at a time may use it.
    """

    def __new__(cls, points, kind=None, **options):
        points = listed(points)
        if kind is None:
            kind = "grid" if len(shape_of(points)) == 3 else "curve"
        if kind not in _kinds:
            raise ValueError(f"kind: {kind!r} is unknown; {', '.join(_kinds)}")
        points, rows = _points(points, kind)
        return super().__new__(cls, Report, _kinds[kind], points, *Arguments(options, rows, kind == "grid").listed())

    def __init__(self, points, kind=None, **options):
        pass

    @classmethod
    def resume(cls, path, *, threads=None, progress=None):
        """A fit continued from the file that `save` wrote: the next steps give the same bits as if it had never stopped."""
        return cls._resume(Report, path, -1 if threads is None else threads, progress)

    # ---- going on

    def step(self, iterations=1):
        """That many updates, fewer when a stop rule fires; returns the Report."""
        if iterations < 0:
            raise ValueError(f"{iterations} iterations are not a count")
        return Report(self._step(iterations), self.warnings)

    def run(self):
        """Until a stop rule fires; returns the Report."""
        return Report(self._step(-1), self.warnings)

    # ---- looking

    @property
    def report(self):
        """The state now, a Report; never iterates."""
        return Report(self._report(), self.warnings)

    @property
    def model(self):
        """A Model of the current iterate."""
        return self._model(Model)

    @property
    def warnings(self):
        """Choices, repairs and warnings, one line each."""
        return all_of(self._note)

    @property
    def trace(self):
        """The history so far, a list of TraceRow; needs the option trace_every."""
        return [TraceRow(*row) for row in self._trace()]

    @property
    def parameters(self):
        """Parameters of the rows used, a copy: curve [count]; grid: u then v; scattered [count, 2]."""
        values, _ = self._parameters()
        scattered = self._report()["kind"] == "surface"
        return shaped(values, (len(values) // 2, 2) if scattered else (len(values),))

    @property
    def rows(self):
        """The row of the points for each row used; None: all, in their order."""
        return self._parameters()[1]

    @property
    def residuals(self):
        """Data minus model at the parameters used, [rows used, dim], a copy."""
        values = self._residuals()
        count = self._report()["point_count"]
        return shaped(values, (count, len(values) // count))

    @property
    def robust_weights(self):
        """Factors in [0, 1] that the robust loss gave the rows used, a copy; None without one."""
        values = self._weights()
        return None if values is None else shaped(values, (len(values),))

    @property
    def unsupported(self):
        """Control points that the data do not hold, a list of row-major indices."""
        return self._unsupported()

    @property
    def corners(self):
        """Rows of the points that are corners, found or given, a list."""
        return self._corners()

    # ---- editing

    def set(self, name, value):
        """A parameter of the method, or 'tolerance', 'max_iterations', 'stop_change', 'stop_gradient', 'time_limit', 'trace_every',
        'axis_tolerances' (as 'T1,T2,...' or 'none')."""
        self._set(name, str(value))

    def move_point(self, row, point):
        """Moves one row of the points; its parameter stays."""
        self._move_point(row, point)

    def weigh_point(self, row, weight):
        """Gives one row another weight; 0 drops it. Least squares only."""
        self._weigh_point(row, weight)

    def add_points(self, points, parameters, weights=None):
        """Appends points [count, dim] with parameters [count] (scattered: [count, 2]) inside the domain. Least squares only."""
        self._add_points(points, parameters, weights)

    def add_point(self, point, parameter, weight=1.0):
        """Appends one point [dim] at a parameter."""
        self._add_points([list(point)], [parameter], [weight])

    def freeze(self, control):
        """Control points that stay from now on, row-major indices."""
        self._freeze(control, True)

    def free(self, control):
        """Control points that may move again."""
        self._freeze(control, False)

    def constrain(self, constraints):
        """Adds constraints, a list of dicts as in fit_curve; returns their ids for `release`."""
        first, count = self._constrain(constraints)
        return range(first, first + count)

    def join(self, joins):
        """Goes on from neighbouring models, a list of dicts as in fit_curve; returns the ids of their constraints for `release`."""
        first, count = self._join(joins)
        return range(first, first + count)

    def release(self, id):
        """Drops the constraint of this id."""
        self._release(id)

    def insert_knot(self, knot, direction=0):
        """Inserts a knot; the current model keeps its shape. Least squares only. direction 0 is u."""
        self._insert_knot(direction, knot)

    # ---- ending

    def save(self, path):
        """Writes everything needed to go on later, whole or not at all."""
        self._save(path)

    def close(self):
        """Gives the memory back; models taken from it stay."""
        self._close()

    def __enter__(self):
        return self

    def __exit__(self, *failure):
        self.close()

    def __repr__(self):
        try:
            return repr(self.report).replace("<pia.Report", "<pia.Fit")
        except RuntimeError as failure:
            return f"<pia.Fit: {failure}>"
