"""Interpolation of large data: libpia's direct solve beside SciPy's make_interp_spline and RectBivariateSpline(s=0), on the same points,
parameters and knots, in one run. Usage: interpolation_scipy.py BUILD [most rows of a curve]. Prints peer / pia."""
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import numpy
from scipy.interpolate import RectBivariateSpline, make_interp_spline

program = pathlib.Path(sys.argv[1]) / "bench/bench_interpolation"
most = int(float(sys.argv[2])) if len(sys.argv) > 2 else 10_000_000


def median(times):
    return sorted(times)[len(times) // 2]


def time_peer(call):
    """Median of five after one that makes the memory known to the machine."""
    times = []
    for _ in range(6):
        start = time.perf_counter()
        result = call()
        times.append(time.perf_counter() - start)
    return median(times[1:]), result


def run(kind, folder, arrays):
    paths = []
    for name, array in arrays:
        path = folder / name
        numpy.asarray(array, dtype=float).tofile(path)
        paths.append(str(path))
    out = folder / "out"
    text = subprocess.run([program, kind, *paths, str(out)], capture_output=True, text=True, check=True).stdout
    times = [float(x) for x in re.findall(r"seconds (\S+)", text)]
    return median(times[1:]), float(re.search(r"peak_over_input (\S+)", text)[1]), numpy.fromfile(out)


with tempfile.TemporaryDirectory(dir="/dev/shm") as name:
    folder = pathlib.Path(name)
    for rows in (1_000_000, 10_000_000):
        if rows > most:
            continue
        random = numpy.random.default_rng(1)
        t = numpy.cumsum(0.5 + random.random(rows))
        t = (t - t[0]) / (t[-1] - t[0])
        q = numpy.stack([numpy.cos(40 * t), numpy.sin(60 * t), t], axis=1) + 1e-4 * random.random((rows, 3))
        peer, spline = time_peer(lambda: make_interp_spline(t, q, 3))
        ours, peak, control = run("curve", folder, [("q", q), ("t", t), ("u", spline.t)])
        difference = numpy.abs(control.reshape(-1, 3) - spline.c).max()
        print(f"curve {rows} points in R^3: SciPy {peer:.3f} s, pia {ours:.4f} s, peer / pia {peer / ours:.1f}, "
              f"largest difference {difference:.1e}, peak memory / input {peak:.2f}")
    n = 1000
    x = numpy.linspace(0, 1, n)
    z = numpy.sin(9 * x[:, None]) * numpy.cos(7 * x[None, :] ** 2)
    peer, surface = time_peer(lambda: RectBivariateSpline(x, x, z, s=0))
    u, v = surface.tck[:2]
    ours, peak, control = run("grid", folder, [("q", z), ("t", numpy.r_[x, x]), ("u", u), ("v", v)])
    difference = numpy.abs(control - surface.tck[2]).max()
    print(f"grid {n} x {n}: SciPy {peer:.3f} s, pia {ours:.4f} s, peer / pia {peer / ours:.1f}, largest difference {difference:.1e}")
