"""SciPy's RectBivariateSpline on one patch: the largest s, by bisection on its logarithm, that keeps the tolerance at the points.

Heights over a lattice are one spline; of other patches every component is one, over mean chords, which then go to common knots. Such a
patch counts a third of the numbers of its components as control points."""
import sys
import time

import numpy as np
from scipy.interpolate import BSpline, RectBivariateSpline

DEGREE = 3


def chords(points):
    """Mean normalised chords along the first axis."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=2)
    lengths = np.vstack([np.zeros(steps.shape[1]), np.cumsum(steps, axis=0)])
    return (lengths / lengths[-1]).mean(axis=1)


def search(u, v, values, keeps):
    """The splines of all components [component][row, column] with the largest common s that keeps the tolerance, and 0 where none does."""
    fit = lambda s: [RectBivariateSpline(u, v, z, kx=DEGREE, ky=DEGREE, s=s) for z in values]
    best, low, high = None, 1e-6 * keeps.tolerance**2, values[0].size * keeps.tolerance**2
    for _ in range(18):
        s = np.sqrt(low * high)
        try:
            splines = fit(s)
        except ValueError:  # what it says of a smoothing that it cannot reach
            low = s
            continue
        if keeps(splines):
            low = s
            if best is None or size(splines) <= size(best):
                best = splines
        else:
            high = s
        if high < 1.05 * low:
            break
    return best if best is not None else fit(0)


def size(splines):
    return sum(len(s.tck[2]) for s in splines)


class Keeps:
    def __init__(self, u, v, values, tolerance):
        self.u, self.v, self.values, self.tolerance = u, v, values, tolerance

    def __call__(self, splines):
        away = [s(self.u, self.v) - z for s, z in zip(splines, self.values)]
        return np.sqrt(sum(a**2 for a in away)).max() <= self.tolerance


def union(knots):
    inside = np.unique(np.concatenate([k[DEGREE + 1 : -DEGREE - 1] for k in knots]))
    return np.concatenate([knots[0][: DEGREE + 1], inside, knots[0][-DEGREE - 1 :]])


def greville(knots):
    return np.array([knots[i + 1 : i + DEGREE + 1].mean() for i in range(len(knots) - DEGREE - 1)])


def on_common_knots(functions, knots_u, knots_v):
    """Control points of functions (u, v) that are splines on these knots."""
    a, b = greville(knots_u), greville(knots_v)
    au = BSpline.design_matrix(a, knots_u, DEGREE).toarray()
    bv = BSpline.design_matrix(b, knots_v, DEGREE).toarray()
    return np.dstack([np.linalg.solve(bv, np.linalg.solve(au, f(a, b)).T).T for f in functions])


def main():
    with open(sys.argv[1]) as file:
        rows, columns, heights, tolerance = file.readline().split()
        points = np.loadtxt(file).reshape(int(rows), int(columns), 3)
    heights = int(heights)
    u, v = chords(points), chords(points.transpose(1, 0, 2))
    if heights:
        ends = points[0, 0, :2], points[-1, 0, :2], points[0, -1, :2]
        line = points[:, 0, :2], points[0, :, :2]
        u, v = (np.linalg.norm(line[d] - ends[0], axis=1) / np.linalg.norm(ends[1 + d] - ends[0]) for d in range(2))
    values = [points[:, :, d] for d in ([2] if heights else [0, 1, 2])]
    start = time.perf_counter()
    splines = search(u, v, values, Keeps(u, v, values, float(tolerance)))
    seconds = time.perf_counter() - start
    functions = list(splines)
    if heights:
        flat = [lambda a, b, d=d: ends[0][d] + np.add.outer(a * (ends[1] - ends[0])[d], b * (ends[2] - ends[0])[d]) for d in range(2)]
        functions = flat + functions
    knots = [union([s.tck[d] for s in splines]) for d in range(2)]
    control = on_common_knots(functions, *knots)
    print(seconds, DEGREE, DEGREE, control.shape[0], control.shape[1], size(splines) // len(splines))
    for numbers in (*knots, control.ravel()):
        print("\n".join("%.17g" % x for x in numbers))


main()
