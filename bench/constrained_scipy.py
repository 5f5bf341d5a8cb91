"""Constrained least squares on a curve: pia's direct solve beside SciPy's sparse solve of the KKT system on the same points and knots."""
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.interpolate import BSpline
from scipy.sparse import bmat, csc_matrix
from scipy.sparse.linalg import spsolve

DEGREE, COUNT, CONTROL, MET = 3, 10001, 300, 40


def curve():
    s = np.linspace(0, 2 * np.pi, COUNT)
    points = np.column_stack([np.cos(s) * (1 + 0.2 * np.sin(9 * s)), np.sin(s) * (1 + 0.2 * np.cos(7 * s)),
                              0.3 * np.sin(5 * s) + 1e-3 * np.sin(1e4 * s * s)])
    chord = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return points, chord / chord[-1]


def scipy_fit(points, parameters, knots, rows):
    start = time.perf_counter()
    a = BSpline.design_matrix(parameters, knots, DEGREE)
    b = a[rows]
    kkt = csc_matrix(bmat([[a.T @ a, b.T], [b, None]]))
    x = spsolve(kkt, np.vstack([a.T @ points, points[rows]]))[:CONTROL]
    squares = np.sum((a @ x - points) ** 2, axis=1)
    largest, rms = np.sqrt(squares.max()), np.sqrt(squares.mean())  # the report that pia gives as well
    return time.perf_counter() - start, largest, rms


def main():
    program = sys.argv[1] + "/bench/bench_constrained"
    points, parameters = curve()
    rows = np.arange(MET) * 250 + 125
    knots = np.concatenate([np.zeros(DEGREE), np.linspace(0, 1, CONTROL - DEGREE + 1), np.ones(DEGREE)])
    best = min(scipy_fit(points, parameters, knots, rows) for _ in range(20))
    with tempfile.NamedTemporaryFile() as file:
        numbers = [[COUNT, CONTROL, MET], parameters, knots, points.ravel(), rows]
        file.write(np.concatenate(numbers).astype(float).tobytes())
        file.flush()
        output = subprocess.run([program, file.name], check=True, capture_output=True, text=True)
    seconds, rms, violation = (float(word) for word in output.stdout.split())
    print(f"{COUNT} points, {CONTROL} controls, {MET} met: pia {1e3 * seconds:.3f} ms, SciPy KKT {1e3 * best[0]:.3f} ms, ratio "
          f"{best[0] / seconds:.1f}; RMS differs by {abs(rms / best[2] - 1):.1e} of itself, constraints met to {violation:.1e}")


main()
