"""Least squares of large data: libpia beside SciPy's make_lsq_spline, same points, parameters and knots, in the same run.

usage: lsq_scipy.py BUILD [CASE...]

One line a case: wall seconds of both and their ratio; processor seconds of both, which other programs on the machine disturb less; the RMS
error of both. The fit of libpia includes the check of its input and the errors of its report, for which SciPy needs another call.
"""
import subprocess
import sys
import time

import numpy as np
from scipy.interpolate import make_lsq_spline

CASES = {  # kind, points and control points a direction, components, ratio asked
    "curve-1e7-1000": ("curve", 10_000_000, 1000, 3, 40),
    "curve-1e6-1e5": ("curve", 1_000_000, 100_000, 3, 5),
    "grid-1000-100": ("grid", 1000, 100, 3, 10),
    "grid-4000-500": ("grid", 4000, 500, 1, 15),
}


def noise(count):
    """As in bench_lsq.c."""
    i = np.arange(count, dtype=np.uint64)
    return (i * np.uint64(2654435761) % np.uint64(4294967296)).astype(float) / 4294967296.0 - 0.5


def points(kind, count, dim):
    t = np.arange(count) / (count - 1)
    u, v = (t, np.zeros(1)) if kind == "curve" else (t[:, None], t[None, :])
    q = np.stack([np.sin((5 + 7 * d) * u) * np.cos(3 * v + d) for d in range(dim)], axis=-1)
    return t, q + 0.01 * noise(q.size).reshape(q.shape)


def knots(control):
    return np.concatenate([[0] * 4, np.arange(1, control - 3) / (control - 3), [1] * 4])


def fit(kind, t, q, u):
    """Control points' spline; a grid is fitted along one direction, then along the other."""
    s = make_lsq_spline(t, q, u, 3)
    if kind == "grid":
        s = make_lsq_spline(t, np.swapaxes(s.c, 0, 1), u, 3)
    return s


def rms(kind, t, q, u, s):
    if kind == "curve":
        r = q - s(t)
    else:
        across = type(s)(u, np.swapaxes(s(t), 0, 1), 3)
        r = q - across(t)
    return np.sqrt(np.sum(r * r) / (r.size / q.shape[-1]))


def main():
    build, wanted = sys.argv[1], sys.argv[2:] or CASES
    print(f"{'case':16} {'SciPy':>9} {'libpia':>9} {'ratio':>7} {'asked':>6} {'CPU':>9} {'CPU':>9}   RMS of both")
    for name in wanted:
        kind, count, control, dim, asked = CASES[name]
        output = subprocess.run([f"{build}/bench/bench_lsq", name], check=True, capture_output=True, text=True).stdout.split()
        seconds, work, error = (float(word) for word in output[1:4])
        t, q = points(kind, count, dim)
        u = knots(control)
        start, begun = time.perf_counter(), time.process_time()
        s = fit(kind, t, q, u)
        peer, peer_work = time.perf_counter() - start, time.process_time() - begun
        print(
            f"{name:16} {peer:9.4f} {seconds:9.5f} {peer / seconds:7.1f} {asked:6} {peer_work:9.4f} {work:9.5f}"
            f"   {rms(kind, t, q, u, s):.10g}, {error:.10g}",
            flush=True,
        )


if __name__ == "__main__":
    main()
