"""Least squares of large data: libpia beside SciPy's make_lsq_spline, same points, parameters and knots, in the same run.

usage: lsq_scipy.py BUILD [CASE...]

One line a case: wall seconds of SciPy, of libpia's fit alone, which is what make_lsq_spline does, and of the fit with a report, which
measures the errors of all points as well; the ratio of SciPy to either, and what is asked of the first; peak memory of libpia over its
input; the RMS error of both. Both check their input. The best of some runs on either side. curve-1e8-1000 wants 12 GB of memory and is
run where it is named.
"""
import subprocess
import sys
import time

import numpy as np
from scipy.interpolate import make_lsq_spline

CASES = {  # kind, points and control points a direction, components, ratio asked, runs of SciPy
    "curve-1e7-1000": ("curve", 10_000_000, 1000, 3, 40, 3),
    "curve-1e8-1000": ("curve", 100_000_000, 1000, 3, 50, 1),
    "curve-1e6-1e5": ("curve", 1_000_000, 100_000, 3, 5, 10),
    "grid-1000-100": ("grid", 1000, 100, 3, 10, 10),
    "grid-4000-500": ("grid", 4000, 500, 1, 15, 5),
}
PIECE = 10_000_000  # numbers that are made or looked at together


def noise(begin, count):
    """As in bench_lsq.c."""
    i = np.arange(begin, begin + count, dtype=np.uint64)
    return (i * np.uint64(2654435761) % np.uint64(4294967296)).astype(float) / 4294967296.0 - 0.5


def fill(out, begin, u, v):
    """Numbers of rows u, v, the first of them number `begin`, of all numbers."""
    for d in range(out.shape[-1]):
        out[..., d] = np.sin((5 + 7 * d) * u) * np.cos(3 * v + d)
    out += 0.01 * noise(begin, out.size).reshape(out.shape)


def points(kind, count, dim):
    t = np.arange(count) / (count - 1)
    if kind == "grid":
        q = np.empty((count, count, dim))
        fill(q, 0, t[:, None], t[None, :])
        return t, q
    q = np.empty((count, dim))
    for begin in range(0, count, PIECE):
        fill(q[begin : begin + PIECE], begin * dim, t[begin : begin + PIECE], 0)
    return t, q


def knots(control):
    return np.concatenate([[0] * 4, np.arange(1, control - 3) / (control - 3), [1] * 4])


def fit(kind, t, q, u):
    """Control points' spline; a grid is fitted along one direction, then along the other."""
    s = make_lsq_spline(t, q, u, 3)
    if kind == "grid":
        s = make_lsq_spline(t, np.swapaxes(s.c, 0, 1), u, 3)
    return s


def rms(kind, t, q, u, s):
    if kind == "grid":
        r = q - type(s)(u, np.swapaxes(s(t), 0, 1), 3)(t)
        return np.sqrt(np.sum(r * r) / (r.size / q.shape[-1]))
    squares = sum(np.sum((q[b : b + PIECE] - s(t[b : b + PIECE])) ** 2) for b in range(0, len(t), PIECE))
    return np.sqrt(squares / len(t))


def timed_fit(runs, *problem):
    best = np.inf
    for _ in range(runs):
        start = time.perf_counter()
        s = fit(*problem)
        best = min(best, time.perf_counter() - start)
    return best, s


def main():
    build, wanted = sys.argv[1], sys.argv[2:] or [name for name in CASES if name != "curve-1e8-1000"]
    print(f"{'case':16} {'SciPy':>9} {'fit':>9} {'+report':>9} {'ratio':>7} {'asked':>6} {'+report':>8} {'memory':>7}   RMS of both")
    for name in wanted:
        kind, count, control, dim, asked, runs = CASES[name]
        output = subprocess.run([f"{build}/bench/bench_lsq", name], check=True, capture_output=True, text=True).stdout.split()
        alone, told, _, error, _, memory = (float(word) for word in output[1:7])
        t, q = points(kind, count, dim)
        u = knots(control)
        peer, s = timed_fit(runs, kind, t, q, u)
        print(
            f"{name:16} {peer:9.4f} {alone:9.5f} {told:9.5f} {peer / alone:7.1f} {asked:6} {peer / told:8.1f} {memory:7.3f}"
            f"   {rms(kind, t, q, u, s):.10g}, {error:.10g}",
            flush=True,
        )
        del t, q, s


if __name__ == "__main__":
    main()
