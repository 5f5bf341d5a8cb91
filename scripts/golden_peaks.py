#!/usr/bin/python3
"""Writes tests/golden/lin2004_peaks.json: MATLAB's peaks(11), Table 1 (row Fig. 6) of [2004]."""
import json
import math
import pathlib


def peaks(x, y):
    return (3 * (1 - x) ** 2 * math.exp(-x**2 - (y + 1) ** 2) - 10 * (x / 5 - x**3 - y**5) * math.exp(-x**2 - y**2)
            - math.exp(-(x + 1) ** 2 - y**2) / 3)


axis = [-3 + 6 * i / 10 for i in range(11)]
points = [c for y in axis for x in axis for c in (x, y, peaks(x, y))]
row = lambda k, error, tolerance: {"iteration": k, "max_error": error, "tolerance": tolerance}
case = {
    "source": "Lin, Wang, Dong 2004, Table 1, Fig. 6; the error at iteration 0 is a sum there, and 1.2695e-3 is printed truncated",
    "kind": "grid", "count": [11, 11], "dim": 3, "points": points,
    "options": {"method": "pia", "degree": [3, 3], "iterations": 30, "stop_change": 0},
    "expect": {"start_error_sum": 33.62778, "start_error_sum_tolerance": 5e-6,
               "trace": [row(2, 0.35526, 5e-6), row(3, 0.2422128, 5e-8), row(4, 0.17233, 5e-6), row(15, 1.528187e-2, 5e-9),
                         row(30, 1.2696e-3, 5e-8)]},
}
target = pathlib.Path(__file__).resolve().parent.parent / "tests/golden/lin2004_peaks.json"
target.write_text(json.dumps(case) + "\n")
