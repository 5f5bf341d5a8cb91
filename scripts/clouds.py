#!/usr/bin/env python3
"""Real clouds with their rows shuffled, each from file to trimmed STEP by one command, to one hundredth of the extent (true distance).

    scripts/clouds.py PIA DATA [OUT]      DATA holds scan/ and curve3d/ (data/README.md); OUT takes the files, a temporary folder by default

Prints the table of docs/clouds.md. The largest distance is measured by `pia check --foot-points` on the written model, not by the fit. The
peer is SciPy's LSQBivariateSpline: a bicubic fit with fixed, uniform knots and at least as many control points, as heights over the best
plane; its deviation is the height left over. Clouds that are no graph over a plane are not given to it."""
import json, os, random, subprocess, sys, tempfile, time

import numpy

CLOUDS = [
    ("scan/face_fran_45x49", []), ("scan/owl_face_101x101", []), ("scan/blackvase_61x205", []),
    ("curve3d/gcode_3d_chips", ["--param", "xy"]), ("scan/milk_carton_kinect", []),
]
NO_GRAPH = ("scan/blackvase_61x205",)


def shuffled(source, target):
    header, *rows = open(source).read().splitlines()
    random.Random(1).shuffle(rows)
    open(target, "w").write("\n".join([header] + rows) + "\n")


def run(command):
    """Output, processor seconds, and the peak memory of the command, in megabytes."""
    done = subprocess.run(["/usr/bin/time", "-f", "%U %S %M", *command], capture_output=True, text=True)
    user, system, kilobytes = done.stderr.split("\n")[-2].split()
    return json.loads(done.stdout), float(user) + float(system), float(kilobytes) / 1024


def peer(points, controls):
    from scipy.interpolate import LSQBivariateSpline
    centred = points - points.mean(0)
    axes = numpy.linalg.svd(centred, full_matrices=False)[2]
    x, y, height = (centred @ axes.T).T
    inner = max(int(numpy.ceil(numpy.sqrt(controls))) - 4, 1)
    start = time.process_time()
    knots = [numpy.linspace(t.min(), t.max(), inner + 2)[1:-1] for t in (x, y)]
    spline = LSQBivariateSpline(x, y, height, *knots)
    left = numpy.abs(spline.ev(x, y) - height)
    return (inner + 4) ** 2, left.max(), time.process_time() - start


def main():
    pia, data = sys.argv[1], sys.argv[2]
    out = sys.argv[3] if len(sys.argv) > 3 else tempfile.mkdtemp()
    os.makedirs(out, exist_ok=True)
    print("| cloud | points | base | tolerance | reached | control points | largest distance | rms | processor seconds | MB | SciPy: control points, "
          "largest height left, seconds |")
    print("| --- | ---: | --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | --- |")
    for name, more in CLOUDS:
        stem = os.path.join(out, os.path.basename(name))
        shuffled(os.path.join(data, name + ".csv"), stem + ".csv")
        points = numpy.loadtxt(stem + ".csv", delimiter=",", skiprows=1)
        tolerance = 1e-2 * numpy.linalg.norm(points.max(0) - points.min(0))
        fit, seconds, megabytes = run([pia, "fit", stem + ".csv", "--surface", "--tolerance", repr(tolerance), "--measure", "distance",
                                       "-o", stem + ".step", "-o", stem + ".json", "--json", *more])
        true, _, _ = run([pia, "check", stem + ".json", stem + ".csv", "--foot-points", "--json"])
        base = next((w.split()[2].rstrip(",") for w in fit["warnings"] if w.startswith("method: parameters")), more[1] if more else "")
        theirs = "no graph over a plane"
        if name not in NO_GRAPH:
            controls, worst, taken = peer(points, fit["control_count"])
            theirs = f"{controls}, {worst:.3g}, {taken:.2f}"
        print(f"| `{name}` | {len(points)} | {base} | {tolerance:.3g} | {'yes' if fit['reached'] else 'no'} | {fit['control_count']} | "
              f"{true['max_error']:.3g} | {true['rms_error']:.3g} | {seconds:.2f} | {megabytes:.0f} | {theirs} |")


main()
