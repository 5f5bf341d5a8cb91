"""SciPy's splprep on one case: the largest s, by bisection on its logarithm, whose curve keeps the tolerance at its parameters."""
import sys
import time

import numpy as np
from scipy.interpolate import BPoly, BSpline, PPoly, splev, splprep


def attempt(points, closed, s):
    (tck, u), _, _, _ = splprep(points.T, s=s, k=3, per=closed, quiet=1, full_output=1)
    deviation = np.sqrt(((np.array(splev(u, tck)).T - points) ** 2).sum(axis=1)).max()
    return tck, deviation


def search(points, closed, tolerance):
    best = None
    low, high = 1e-6 * tolerance**2, len(points) * tolerance**2
    for _ in range(18):
        s = np.sqrt(low * high)
        tck, deviation = attempt(points, closed, s)
        if deviation <= tolerance:
            low = s
            if best is None or len(tck[1][0]) <= len(best[1][0]):
                best = tck
        else:
            high = s
        if high < 1.05 * low:
            break
    return best if best is not None else attempt(points, closed, 0)[0]


def clamp(knots, control, degree):
    """The same curve in Bezier pieces, which every reader knows."""
    pieces = PPoly.from_spline(BSpline(knots, control, degree, extrapolate=False))
    inside = np.flatnonzero(np.diff(pieces.x) > 0)
    bezier = BPoly.from_power_basis(PPoly(pieces.c[:, inside], np.append(pieces.x[inside], pieces.x[inside[-1] + 1])))
    first, last = np.searchsorted(bezier.x, (knots[degree], knots[-degree - 1]))
    ends = bezier.x[first : last + 1]
    points = np.concatenate([bezier.c[:-1, i] for i in range(first, last)] + [bezier.c[-1:, last - 1]])
    return np.concatenate([ends[:1], np.repeat(ends, degree), ends[-1:]]), points


def main():
    with open(sys.argv[1]) as file:
        rows, dim, closed, tolerance = file.readline().split()
        points = np.loadtxt(file).reshape(int(rows), int(dim))
    start = time.perf_counter()
    knots, control, degree = search(points, int(closed), float(tolerance))
    seconds = time.perf_counter() - start
    control = np.array(control).T[: len(knots) - degree - 1]
    counted = len(control) - degree * int(closed)
    if int(closed):
        knots, control = clamp(knots, control, degree)
    print(seconds, degree, len(control), counted)
    print("\n".join("%.17g" % v for v in knots))
    print("\n".join("%.17g" % v for v in control.ravel()))


main()
