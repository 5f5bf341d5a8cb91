"""binding_python.py BUILD [COUNT]: the same fit from C and from Python on a NumPy array, in turns; the median of the ratios.
Then what a short call costs, and resident memory over many fits."""

import resource
import statistics
import subprocess
import sys
import time

build, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10_000_000
sys.path.insert(0, f"{build}/python")

import numpy as np

import pia

CONTROL = 1000
i = np.arange(count, dtype=float)
points = np.column_stack([i, 1000 * np.sin(1e-4 * i)])
del i


def best_of_three():
    times = []
    for _ in range(3):
        began = time.perf_counter()
        pia.fit_curve(points, control=CONTROL)
        times.append(time.perf_counter() - began)
    return min(times)


c, python = [], []
for _ in range(9):
    line = subprocess.run([f"{build}/bench/bench_binding", str(count), str(CONTROL)], capture_output=True, text=True, check=True).stdout
    c.append(float(line.split()[0]))
    python.append(best_of_three())
ratio = statistics.median(p / q for p, q in zip(python, c))
print(f"{count} points: C {statistics.median(c):.4f} s, Python {statistics.median(python):.4f} s, ratio {ratio:.3f}")

few = points[:20].copy()
model = pia.fit_curve(few, control=8)
for name, call in (("fit_curve of 20 points", lambda: pia.fit_curve(few, control=8)), ("model(t)", lambda: model(0.5))):
    runs = 20_000
    began = time.perf_counter()
    for _ in range(runs):
        call()
    print(f"{name}: {(time.perf_counter() - began) / runs * 1e6:.1f} us")

before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
for _ in range(10_000):
    pia.fit_curve(few, control=8, method="lspia", max_iterations=3, progress=lambda report: False)
print(f"10000 fits with a callback: peak memory grew by {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before} KiB")
