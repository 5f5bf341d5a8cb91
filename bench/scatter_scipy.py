"""Scattered points: pia beside SciPy's sparse matrices and conjugate gradients (diagonal preconditioner) on the same points and knots."""
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.interpolate import BSpline
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import cg

DEGREE = 3


def sheet(count):
    random = np.random.default_rng(7)
    u, v = random.random(count), random.random(count)
    z = u * (1 - u) * v * (1 + 2 * v * v) + 0.01 * random.random(count)
    return np.column_stack([u, v]), np.column_stack([u + 0.1 * v, v, z])


def product_rows(parameters, knots, control):
    """Rows kron(N(u), N(v)) as one sparse matrix."""
    u, v = (BSpline.design_matrix(parameters[:, d], knots, DEGREE) for d in range(2))
    count, width = len(parameters), DEGREE + 1
    columns = u.indices.reshape(count, width)[:, :, None] * control + v.indices.reshape(count, width)[:, None, :]
    values = u.data.reshape(count, width)[:, :, None] * v.data.reshape(count, width)[:, None, :]
    return csr_matrix((values.ravel(), columns.ravel(), np.arange(0, count * width * width + 1, width * width)),
                      shape=(count, control * control))


def scipy_fit(parameters, points, knots, control):
    start = time.perf_counter()
    a = product_rows(parameters, knots, control)
    gram = (a.T @ a).tocsr()
    right = a.T @ points
    precondition = diags(1 / gram.diagonal())
    solution = np.column_stack([cg(gram, right[:, d], tol=1e-10, atol=0, M=precondition)[0] for d in range(points.shape[1])])
    seconds = time.perf_counter() - start
    return seconds, np.sqrt(np.mean(np.sum((a @ solution - points) ** 2, axis=1)))


def main():
    program = sys.argv[1] + "/bench/bench_scatter"
    count, control = (int(sys.argv[2]), int(sys.argv[3])) if len(sys.argv) > 3 else (1000000, 200)
    parameters, points = sheet(count)
    knots = np.concatenate([np.zeros(DEGREE), np.linspace(0, 1, control - DEGREE + 1), np.ones(DEGREE)])
    seconds, rms = scipy_fit(parameters, points, knots, control)
    with tempfile.NamedTemporaryFile() as file:
        file.write(parameters.tobytes() + points.tobytes())
        file.flush()
        output = subprocess.run([program, str(count), str(control), file.name, "cg-kron"], check=True, capture_output=True, text=True)
    ours, our_rms, iterations = output.stdout.split()
    print(f"{count} points, {control} x {control} controls: cg-kron {float(ours):.3f} s ({iterations} iterations), SciPy sparse CG "
          f"{seconds:.3f} s, ratio {seconds / float(ours):.1f}; RMS differs by {abs(float(our_rms) / rms - 1):.1e} of itself")


main()
