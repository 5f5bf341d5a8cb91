"""Models: B-spline and NURBS curves and surfaces."""

from . import _convert, _pia
from ._arrays import listed, paired, shape_of, shaped
from ._report import Deviation, Report, all_of


class Model(_pia.Model):
    """An immutable B-spline or NURBS curve or surface.

    Model(degree, knots, control, weights=None)

    degree   a number for a curve, a pair (u, v) for a surface; 1 to 25
    knots    the full clamped knot vector of control + degree + 1 values, a pair of them for a surface
    control  control points [n, dim], of a surface [n, m, dim]
    weights  positive, [n] or [n, m]; None: a polynomial model

    Calling it evaluates: curve(t), surface(u, v). A number gives a point [dim], an array of parameters of any shape gives an array of
    that shape with one more axis. Parameters outside the domain are taken at its nearest end. Models may be shared between threads.
    """

    __slots__ = ("_remembered",)

    def __new__(cls, degree, knots, control, weights=None):
        if not hasattr(degree, "__len__"):
            degree, knots = (degree,), (knots,)
        return super().__new__(cls, tuple(degree), tuple(knots), control, weights)

    # ---- what it is

    @property
    def directions(self):
        """1 for a curve, 2 for a surface."""
        return self._info()[0]

    @property
    def dim(self):
        """Components of a point."""
        return self._info()[1]

    @property
    def rational(self):
        """Whether it has weights."""
        return bool(self._info()[2])

    def _each(self, pair):
        return pair[0] if self.directions == 1 else pair

    @property
    def degree(self):
        """The degree of a curve, a pair for a surface."""
        return self._each(self._info()[3])

    @property
    def control_count(self):
        """Control points of a curve, a pair for a surface."""
        return self._each(self._info()[4])

    @property
    def closed(self):
        """Whether start and end join smoothly; a pair for a surface."""
        return self._each(tuple(map(bool, self._info()[5])))

    @property
    def domain(self):
        """(first, last) parameter; a pair of those for a surface."""
        return self._each(self._info()[6])

    @property
    def knots(self):
        """The full knot vector [control + degree + 1], a copy; a pair of them for a surface."""
        vectors = [self._knots(direction) for direction in range(self.directions)]
        return self._each(tuple(shaped(vector, (len(vector),)) for vector in vectors))

    @property
    def _net(self):
        count = self.control_count
        return count if isinstance(count, tuple) else (count,)

    @property
    def control(self):
        """Control points [n, dim] or [n, m, dim], Cartesian, a copy."""
        return shaped(self._control()[0], (*self._net, self.dim))

    @property
    def weights(self):
        """Weights [n] or [n, m], 1 for a polynomial model, a copy."""
        return shaped(self._control()[1], self._net)

    @property
    def report(self):
        """The Report of the fit that made the model, None when no fit did."""
        remembered = getattr(self, "_remembered", None)
        if remembered is not None:
            return remembered
        members = self._report()
        return Report(members, all_of(self._note)) if members is not None else None

    @property
    def parameters(self):
        """Parameters of the points it was fitted to, where it carries them (given or corrected ones): curve [count]; grid: u then v;
        scattered [count, 2]. None otherwise."""
        values = self._parameters()
        if values is None:
            return None
        scattered = self.report.kind == "surface"
        return shaped(values, (len(values) // 2, 2) if scattered else (len(values),))

    # ---- values

    def _place(self, parameters):
        if len(parameters) != self.directions:
            raise TypeError(f"a {'curve' if self.directions == 1 else 'surface'} takes {'t' if self.directions == 1 else 'u, v'}")
        if self.directions == 2:
            return paired(*parameters)
        at = listed(parameters[0])
        return at, shape_of(at)

    def __call__(self, *parameters):
        at, shape = self._place(parameters)
        return shaped(self._eval(at, 0), (*shape, self.dim))

    def derivative(self, *parameters, order=1):
        """Derivative of the given order at parameters: curve.derivative(t, order=2), surface.derivative(u, v, order=(1, 0)).

        order  a number for a curve, a pair (in u, in v) for a surface; order 1 of a surface gives both first derivatives, on an axis
               before the last one: [..., 2, dim]
        """
        at, shape = self._place(parameters)
        if self.directions == 1:
            values = shaped(self._eval(at, order), (*shape, order + 1, self.dim))
            return _pick(values, len(shape), order)
        highest = sum(order) if isinstance(order, tuple) else order
        each = (highest + 1) * (highest + 2) // 2
        values = shaped(self._eval(at, highest), (*shape, each, self.dim))
        if isinstance(order, tuple):
            return _pick(values, len(shape), each - highest - 1 + order[1])
        if order != 1:
            raise ValueError("order: of a surface it is a pair (in u, in v), or 1 for both first derivatives")
        return _pick(values, len(shape), slice(1, 3))

    def curvature(self, *parameters):
        """Curvature of a curve [...], signed in the plane (left turns positive); mean and Gaussian of a surface in space [..., 2]."""
        at, shape = self._place(parameters)
        return shaped(self._curvature(at), shape if self.directions == 1 else (*shape, 2))

    def closest(self, points):
        """(parameters, distances) of the closest points of the model, found globally, to points [..., dim].

        parameters  [...], of a surface [..., 2]
        distances   [...], units of the points
        """
        points = listed(points)
        shape = shape_of(points)
        if not shape or shape[-1] != self.dim:
            raise ValueError(f"points are [..., {self.dim}], not {list(shape)}")
        values = self._closest(points)
        split = len(values) * self.directions // (self.directions + 1)
        where = shape[:-1] if self.directions == 1 else (*shape[:-1], 2)
        return shaped(values[:split], where), shaped(values[split:], shape[:-1])

    def deviation(self, points, parameters=None):
        """How far points [count, dim] are from the model, a Deviation. parameters [count] or [count, 2]; None: closest points."""
        points = listed(points)
        *members, foot_points, distances = self._deviation(points, parameters)
        return Deviation(*members, bool(foot_points), shaped(distances, (len(distances),)))

    def length(self):
        """Length of a curve, to a relative accuracy of 1e-10 where it is regular."""
        return self._length()

    def bounds(self):
        """Tight bounding box of the shape: (low [dim], high [dim])."""
        values, dim = self._bounds(), self.dim
        return shaped(values[:dim], (dim,)), shaped(values[dim:], (dim,))

    # ---- other models of the same shape

    def insert_knots(self, values, direction=0):
        """A model of the same shape with these knots more. direction 0 is u, 1 is v."""
        return self._insert_knots(direction, values)

    def remove_knots(self, bound):
        """(model, error): a model with fewer knots that moves no point by more than `bound`, and the bound proven for it."""
        return self._remove_knots(bound)

    def elevate(self, by=1, direction=0):
        """A model of the same shape with its degree raised."""
        return self._elevate(direction, by)

    def split(self, value, direction=0):
        """The two halves at a parameter strictly inside the domain."""
        return self._split(direction, value)

    def bezier(self):
        """A model of the same shape whose inside knots are degree-fold: groups of control points are Bezier pieces."""
        return self._bezier()

    def trim(self, loops):
        """The same surface as the face inside the first loop and outside the others, closed polylines [vertices, 2] in the parameter
        plane; no loops: the whole surface. JSON, STEP and IGES hold the loops; values and closest points are those of the whole."""
        loops = [listed(loop) for loop in loops]
        uv = [float(x) for loop in loops for vertex in loop for x in vertex]
        return self._trim([len(loop) for loop in loops], uv)

    @property
    def trim_loops(self):
        """The loops of a trimmed surface, a list of [vertices, 2]; empty for others."""
        return [shaped(loop, (len(loop) // 2, 2)) for loop in all_of(self._trim_loop)]

    def contains(self, u, v):
        """Whether (u, v) lies in the face of a trimmed surface; True for other models."""
        return self._contains(u, v)

    # ---- files, pictures, other libraries

    def save(self, path, format=None, samples=None, **options):
        """Writes the model, whole or not at all; see pia.save."""
        from ._files import save

        save(path, self, format, samples, **options)

    def plot(self, path, points=None, **options):
        """Draws it into an svg, png, pdf or html file; see pia.plot."""
        from ._files import plot

        plot(path, self, points, **options)

    def to_scipy(self):
        """A scipy.interpolate.BSpline; of a surface an NdBSpline (SciPy 1.11 or newer). Rational models are refused."""
        return _convert.to_scipy(self)

    @classmethod
    def from_scipy(cls, spline):
        """From a scipy.interpolate.BSpline (clamped, or periodic) or NdBSpline of two variables, or a (t, c, k) of splprep."""
        return _convert.from_scipy(cls, spline)

    def to_dict(self):
        """Plain numbers in lists, under the names that geomdl uses: degree, knotvector, control_points, weights; degree_u, ... of a
        surface."""
        return _convert.to_dict(self)

    @classmethod
    def from_dict(cls, shape):
        """The way back of to_dict."""
        return _convert.from_dict(cls, shape)

    # ---- Python

    def __repr__(self):
        info = self._info()
        shape = "curve" if info[0] == 1 else "surface"
        degree = " x ".join(map(str, info[3][: info[0]]))
        count = " x ".join(map(str, info[4][: info[0]]))
        kind = ("rational " if self.rational else "") + ("closed " if any(info[5]) else "")
        report = self.report
        error = f", max error {report.max_error:.6g}" if report is not None else ""
        kind += "trimmed " if self._trim_loop(0) is not None else ""
        return f"<pia.Model {kind}{shape} of degree {degree}, {count} control points in {self.dim} dimensions{error}>"

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        return self

    def __reduce__(self):
        weights = self.weights if self.rational else None
        return _restore, (type(self), self.degree, self.knots, self.control, weights, self.report, self.trim_loops)


def _restore(cls, degree, knots, control, weights, report, loops):
    model = cls(degree, knots, control, weights)
    if loops:
        model = model.trim(loops)
    model._remembered = report
    return model


def _pick(values, axis, which):
    """Entry `which` of an axis, of an array or of nested lists."""
    if not isinstance(values, list):
        return values[(slice(None),) * axis + (which,)]
    return [_pick(row, axis - 1, which) for row in values] if axis else values[which]
