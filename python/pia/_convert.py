"""Models as other Python libraries hold them."""

from ._errors import ArgumentError


def _numpy():
    import numpy

    return numpy


def to_scipy(model):
    if model.rational:
        raise ArgumentError("SciPy has no rational splines; take model.to_dict(), or fit without weights of control points")
    if model.directions == 1:
        from scipy.interpolate import BSpline

        return BSpline(model.knots, model.control, model.degree)
    try:
        from scipy.interpolate import NdBSpline
    except ImportError:
        raise ImportError("surfaces need scipy.interpolate.NdBSpline, of SciPy 1.11 or newer") from None
    return NdBSpline(model.knots, model.control, model.degree)


def _clamped(np, knots, control, degree):
    """A spline restricted to its domain, with clamped ends: what SciPy evaluates there is what the model is."""
    first, last = knots[degree], knots[len(control)]
    for end in (first, last):
        while np.count_nonzero(knots == end) < degree:
            knots, control = _insert(np, knots, control, degree, end)
    low = np.searchsorted(knots, first, "right") - degree
    high = np.searchsorted(knots, last, "left") + degree
    knots = np.concatenate(([first], knots[low:high], [last]))
    return knots, control[low - 1 : high - degree]


def _insert(np, t, c, k, x):
    """Boehm's knot insertion at x, an end of the domain: blends only where the support holds x."""
    span = np.searchsorted(t, x, "right") - 1
    q = np.empty((len(c) + 1, *c.shape[1:]))
    for i in range(len(q)):
        if i <= span - k:
            q[i] = c[i]
        elif i > span:
            q[i] = c[i - 1]
        else:
            a = (x - t[i]) / (t[i + k] - t[i])
            q[i] = a * c[i] + (1 - a) * c[i - 1] if i < len(c) else c[i - 1]
    return np.insert(t, span + 1, x), q


def from_scipy(cls, spline):
    np = _numpy()
    if isinstance(spline, tuple) and len(spline) == 2:
        spline = spline[0]  # splprep returns (t, c, k) and the parameters
    t, c, k = spline if isinstance(spline, (tuple, list)) else (spline.t, spline.c, spline.k)
    if isinstance(t, tuple):
        degree = (k, k) if np.ndim(k) == 0 else tuple(int(d) for d in k)
        if len(t) != 2:
            raise ArgumentError(f"a spline of {len(t)} variables is no surface; 2 are possible")
        count = [len(t[d]) - degree[d] - 1 for d in range(2)]
        control = np.asarray(c, dtype=float)[: count[0], : count[1]]
        if control.ndim == 2:
            control = control[:, :, None]
        knots = [np.asarray(vector, dtype=float) for vector in t]
        knots[0], control = _clamped(np, knots[0], control, degree[0])
        knots[1], control = _clamped(np, knots[1], np.swapaxes(control, 0, 1), degree[1])
        return cls(degree, knots, np.ascontiguousarray(np.swapaxes(control, 0, 1)))
    t, k = np.asarray(t, dtype=float), int(k)
    control = np.stack(c, axis=-1) if isinstance(c, list) else np.asarray(c, dtype=float)
    control = control.reshape(len(control), -1)[: len(t) - k - 1]
    t, control = _clamped(np, t, control, k)
    return cls(k, t, np.ascontiguousarray(control))


def _list(values):
    return values if isinstance(values, list) else values.tolist()


def to_dict(model):
    weights = {"weights": [w for row in _list(model.weights) for w in (row if isinstance(row, list) else [row])]} if model.rational else {}
    if model.directions == 1:
        return {"degree": model.degree, "knotvector": _list(model.knots), "control_points": _list(model.control), **weights}
    (p, q), (u, v), (n, m) = model.degree, model.knots, model.control_count
    rows = [point for line in _list(model.control) for point in line]
    return {
        "degree_u": p,
        "degree_v": q,
        "knotvector_u": _list(u),
        "knotvector_v": _list(v),
        "size_u": n,
        "size_v": m,
        "control_points": rows,
        **weights,
    }


def _lines(values, count):
    return [values[i : i + count] for i in range(0, len(values), count)]


def from_dict(cls, shape):
    weights = shape.get("weights")
    if "degree" in shape:
        return cls(shape["degree"], shape["knotvector"], shape["control_points"], weights)
    m = shape["size_v"]
    return cls(
        (shape["degree_u"], shape["degree_v"]),
        (shape["knotvector_u"], shape["knotvector_v"]),
        _lines(shape["control_points"], m),
        _lines(weights, m) if weights is not None else None,
    )
