"""evaluate_with_scipy.py PIA ROOT: fits to a tolerance, each judged by SciPy's evaluation of the exported model at parameters that are
computed here. Exit status 77 where SciPy is missing."""
import json
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from scipy.interpolate import BSpline
except ImportError as missing:
    print(f"skipped: {missing}; python3-scipy has it")
    sys.exit(77)

pia, root = sys.argv[1:3]
folder = tempfile.mkdtemp()
faults = 0


def fit(points, options):
    """Status, report and model of `pia fit` for points [.., d]."""
    rows = points.reshape(-1, points.shape[-1])
    source, target = os.path.join(folder, "points.csv"), os.path.join(folder, "model.json")
    np.savetxt(source, rows, delimiter=",", fmt="%.17g")
    done = subprocess.run([pia, "fit", source, *options, "--json", "-o", target], capture_output=True, text=True, timeout=300)
    if not done.stdout:
        sys.exit(f"{options}: {done.stderr}")
    with open(target) as file:
        return done.returncode, json.loads(done.stdout), json.load(file)["shape"]["data"][0]


def lengths(points, closed):
    """Accumulated chords over the whole length; of lines [n, m, d] the mean over those that have a length."""
    ends = np.concatenate([points, points[:1]]) if closed else points
    steps = np.linalg.norm(np.diff(ends, axis=0), axis=-1).reshape(len(ends) - 1, -1)
    steps = steps[:, steps.sum(axis=0) > 0]
    t = np.concatenate([[0], (np.cumsum(steps, axis=0) / steps.sum(axis=0)).mean(axis=1)])
    t[-1] = 1
    return t[: len(points)]


def values(model, axis, control, t):
    knots, degree = np.array(model["knotvector" + axis]), model["degree" + axis]
    low = knots[degree]
    return BSpline(knots, control, degree)(np.where(t < low, t + 1, np.where(t > knots[-1 - degree], t - 1, t)))


def deviations(model, points, closed):
    control = np.array(model["control_points"]["points"], float)
    if points.ndim == 2:
        return np.linalg.norm(values(model, "", control, lengths(points, closed)) - points, axis=1)
    control = control.reshape(model["size_u"], model["size_v"], -1)
    lines = values(model, "_u", control, lengths(points, False))
    surface = values(model, "_v", lines.swapaxes(0, 1), lengths(points.swapaxes(0, 1), closed))
    return np.linalg.norm(surface.swapaxes(0, 1) - points, axis=2).ravel()


def judge(name, points, share, options=(), closed=False, met=()):
    global faults
    extent = np.linalg.norm(np.ptp(points.reshape(-1, points.shape[-1]), axis=0))
    tolerance = share * extent
    status, report, model = fit(points, [*options, "--tolerance", repr(tolerance)])
    off = deviations(model, points, closed)
    complaints = []
    if status != (0 if report["reached"] else 1):
        complaints.append(f"exit status {status}, reached {report['reached']}")
    if abs(off.max() - report["max_error"]) > 1e-11 * extent:
        complaints.append(f"reported {report['max_error']}, found {off.max()}")
    if report["reached"] != (off.max() <= tolerance * (1 + 1e-9)):
        complaints.append(f"reached {report['reached']}, tolerance {tolerance}, found {off.max()}")
    if len(met) and off[list(met)].max() > 1e-12 * np.abs(points).max():
        complaints.append(f"points to be met are off by {off[list(met)].max()}")
    print(f"{name} {share:g}: {report['control_count']} control points, {off.max() / tolerance:.4f} of the tolerance", *complaints)
    faults += bool(complaints)


def judge_axes(name, points, shares, options=()):
    """The same for a curve with a tolerance for each axis."""
    global faults
    tolerances = np.array(shares) * np.linalg.norm(np.ptp(points, axis=0))
    status, report, model = fit(points, [*options, "--tolerance", ",".join(map(repr, tolerances.tolist()))])
    control = np.array(model["control_points"]["points"], float)
    off = np.abs(values(model, "", control, lengths(points, False)) - points).max(axis=0)
    wrong = status != 0 or not report["reached"] or (off > tolerances * (1 + 1e-9)).any() or not np.allclose(off, report["axis_errors"])
    print(f"{name} by axis: {report['control_count']} control points, {off / tolerances} of the tolerances", "WRONG" * wrong)
    faults += bool(wrong)


def columns(name, count):
    with open(os.path.join(root, "data", name)) as file:
        rows = [line.replace(",", " ").split() for line in file]
    numbers = []
    for row in rows:
        try:
            numbers.append([float(x) for x in row[:count]])
        except ValueError:
            continue
    points = np.array([row for row in numbers if len(row) == count])
    return points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 0])]


random = np.random.default_rng(4)
for share in (1e-1, 1e-2, 1e-3, 1e-4, 1e-5):
    judge("airfoil", columns("airfoil/rae2822.dat", 2), share)
    judge("airfoil met", columns("airfoil/rae2822.dat", 2), share, ["--interpolate", "ends,30,77"], met=(0, 30, 77, 128))
    judge_axes("airfoil", columns("airfoil/rae2822.dat", 2), (share, share / 7))
for degree in range(1, 6):
    t = np.sort(random.uniform(0, 1, 200))
    wave = np.stack([np.cos(6.283 * t * (k + 1) + k) + k for k in range(1 + degree % 4)] + [t], axis=1)
    judge(f"wave of degree {degree}", wave + 1e-4 * random.standard_normal(wave.shape), 1e-3, ["--degree", str(degree)])
    turn = np.linspace(0, 2 * np.pi, 150, endpoint=False)
    ring = np.stack([np.cos(turn) + 0.1 * np.cos(5 * turn), np.sin(turn)], axis=1)
    judge(f"ring of degree {degree}", ring, 1e-3, ["--degree", str(degree), "--closed", "--interpolate", "0,70"], True, (0, 70))
u, v = np.meshgrid(np.linspace(0, 3, 25), np.linspace(0, 4, 30), indexing="ij")
sheet = np.stack([u, v, np.sin(2 * u) * np.cos(1.5 * v) + 1e-3 * random.standard_normal(u.shape)], axis=2)
for share in (1e-1, 1e-2, 1e-3, 1e-6):
    judge("sheet", sheet, share, ["--grid", "25x30"])
judge("sheet met", sheet, 1e-2, ["--grid", "25x30", "--interpolate", "every:31"], met=range(0, 750, 31))
tube = np.stack([np.cos(2 * np.pi * v / 4) * (2 + np.sin(u)), np.sin(2 * np.pi * v / 4) * (2 + np.sin(u)), 3 * u], axis=2)[:, :-1]
judge("tube", tube, 1e-3, ["--grid", "25x29", "--closed", "v"], True)
sys.exit(f"{faults} of these are wrong" if faults else 0)
