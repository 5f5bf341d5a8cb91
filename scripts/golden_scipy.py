#!/usr/bin/python3
"""Writes tests/golden/scipy_*.json: interpolating and least-squares splines as SciPy makes them on the same parameters and knots."""
import json
import pathlib

import numpy
import scipy
from scipy.interpolate import BSpline, make_interp_spline, make_lsq_spline

target = pathlib.Path(__file__).resolve().parent.parent / "tests/golden"
random = numpy.random.default_rng(20040501)


def flat(array):
    return [float(x) for x in numpy.asarray(array, dtype=float).ravel()]


def curve(count, dim):
    t = numpy.linspace(0, 1, count)
    t[1:-1] += (random.random(count - 2) - 0.5) / count
    a = 2 * numpy.pi * t
    columns = [numpy.cos(a) * (2 + numpy.sin(3 * a)), numpy.sin(a) + 5, 100 * t * t, numpy.sin(5 * a) / 10]
    return t, numpy.stack(columns[:dim], axis=1)


def write(name, t, points, degree, options, spline, tolerance, extra=None):
    at = numpy.linspace(spline.t[degree], spline.t[-degree - 1], 97)
    case = {"source": f"SciPy {scipy.__version__}", "kind": "curve", "count": [len(points), 1], "dim": points.shape[1],
            "points": flat(points), "parameters": flat(t), "options": {"degree": [degree, degree], **options},
            "expect": {"values": {"parameters": flat(at), "points": flat(spline(at)), "tolerance": tolerance}}}
    if extra is not None:
        case.update(extra)
    (target / f"scipy_{name}.json").write_text(json.dumps(case) + "\n")


def averaged(t, degree):
    inside = [t[j:j + degree].mean() for j in range(1, len(t) - degree)]
    return numpy.r_[[t[0]] * (degree + 1), inside, [t[-1]] * (degree + 1)]


for degree in (1, 2, 3, 4, 5, 7):
    t, points = curve(24, 1 + degree % 4)
    knots = averaged(t, degree)
    spline = make_interp_spline(t, points, degree, knots)
    write(f"interpolation_{degree}", t, points, degree, {"method": "direct", "knots_u": flat(knots)}, spline, 1e-10)

for degree in (1, 2, 3, 5):
    t, points = curve(120, 2)
    inside = numpy.linspace(0, 1, 12)[1:-1]
    knots = numpy.r_[[0.0] * (degree + 1), inside, [1.0] * (degree + 1)]
    weights = 0.5 + random.random(120)
    spline = make_lsq_spline(t, points, knots, degree, w=weights)
    # SciPy minimises sum (w r)^2, pia sum w r^2.
    write(f"least_squares_{degree}", t, points, degree, {"method": "direct", "knots_u": flat(knots)}, spline, 1e-10,
          {"weights": flat(weights**2)})

# Cubic periodic interpolation: knots at the data, one period.
t = numpy.sort(random.random(20))
t[0] = 0
a = 2 * numpy.pi * t
points = numpy.stack([numpy.cos(a), numpy.sin(2 * a)], axis=1)
spline = make_interp_spline(numpy.r_[t, 1], numpy.r_[points, points[:1]], 3, bc_type="periodic")
cyclic = numpy.r_[t[-3:] - 1, t, t[:4] + 1]
write("closed_3", t, points, 3, {"method": "direct", "closed": [1, 0], "knots_u": flat(cyclic)}, spline, 1e-10)
