"""Fits in one call: the result is the library's own, options go through, failures say what is wrong."""

import math
import unittest

import pia
from common import DATA, Case, wave


class Curves(Case):
    def test_without_options_the_curve_goes_through_every_point(self):
        points = wave(40)
        model = pia.fit_curve(points)
        self.near(model(model.report and 0.0), points[0], 1e-12)
        self.assertLess(model.deviation(points).max_error, 1e-10)
        self.assertEqual(model.report.stop, "finite")
        self.assertIsNone(model.report.reached)

    def test_a_tolerance_is_reached_and_proven(self):
        points = wave(300)
        model = pia.fit_curve(points, tolerance=1e-4)
        self.assertIs(model.report.reached, True)
        self.assertLessEqual(model.report.max_error, 1e-4)
        self.assertLessEqual(model.deviation(points).max_error, 1e-4)
        self.assertLess(model.control_count, 100)

    def test_least_squares_agrees_with_the_normal_equations_on_a_line(self):
        points = [[i / 10, 2 * i / 10 + 1] for i in range(11)]
        model = pia.fit_curve(points, degree=1, control=2)
        self.near(model.control, [[0, 1], [1, 3]], 1e-12)

    def test_every_keyword_form_reaches_the_library(self):
        points = wave(60)
        report = pia.fit_curve(points, control=20, method="lspia", parameters="centripetal", knots="uniform", degree=4).report
        self.assertEqual((report.method, report.parametrization, report.placement), ("lspia", "centripetal", "uniform"))
        self.assertEqual((report.degree, report.control), (4, 20))
        report = pia.fit_curve(points, method="wpia", method_options={"omega": 1.25}, max_iterations=3, stop_change=0).report
        self.assertEqual((report.method, report.iterations), ("wpia", 3))
        report = pia.fit_curve(points, method="pia", limiter="convex-local", limiter_options={}, max_iterations=2).report
        self.assertEqual(report.limiter, "convex-local")
        self.assertEqual(pia.fit_curve(points, tolerance=1e-3, measure="distance").report.measure, "distance")
        self.assertEqual(pia.fit_curve(points, control=20, robust="huber", robust_scale=2.0).report.stop, "finite")

    def test_given_parameters_knots_and_start_are_used(self):
        points = wave(50)
        at = [i / 49 for i in range(50)]
        knots = [0, 0, 0, 0, 0.2, 0.5, 0.8, 1, 1, 1, 1]
        model = pia.fit_curve(points, parameters=at, knots=knots)
        self.same(model.knots, knots)
        self.same(model.parameters, at)
        again = pia.fit_curve(points, parameters=at, start=model, method="lspia", max_iterations=0)
        self.near(again.control, model.control, 1e-13)

    def test_interpolated_rows_are_met_and_count_from_the_end(self):
        points = wave(80)
        model = pia.fit_curve(points, control=12, interpolate=[0, 40, -1])
        self.assertLess(model.report.constraint_error, 1e-12)
        self.near(model(0.0), points[0], 1e-12)
        self.near(model(1.0), points[-1], 1e-12)
        ends = pia.fit_curve(points, control=12, interpolate="ends")
        self.near(ends(1.0), points[-1], 1e-12)

    def test_constraints_are_points_derivatives_and_directions(self):
        points = wave(80)
        model = pia.fit_curve(
            points,
            control=14,
            constraints=[
                {"at": 0},
                {"at": 1.0, "derivative": 1, "value": [1, 0], "direction": True},
                {"at": 0.5, "value": [0.5, 1.25]},
            ],
        )
        self.near(model(0.0), points[0], 1e-11)
        self.near(model(0.5), [0.5, 1.25], 1e-11)
        dx, dy = model.derivative(1.0)
        self.assertLess(abs(dy), 1e-9 * abs(dx))

    def test_a_curve_goes_on_from_another(self):
        points = wave(80)
        first = pia.fit_curve(points[:45], control=10)
        model = pia.fit_curve(points[44:], control=10, joins=[{"join": first, "end": "start", "continuity": "C1"}])
        self.near(model(0.0), first(1.0), 1e-12)
        self.near(model.derivative(0.0), first.derivative(1.0), 1e-10)
        before = pia.fit_curve(points[:45], control=10, joins=[{"join": model, "end": "end", "to": "start", "continuity": "G1"}])
        self.near(before(1.0), model(0.0), 1e-12)
        (ax, ay), (bx, by) = before.derivative(1.0), model.derivative(0.0)
        self.assertLess(abs(ax * by - ay * bx), 1e-9 * math.hypot(ax, ay) * math.hypot(bx, by))

    def test_a_surface_goes_on_from_another(self):
        def sheet(columns):
            return [[(0.1 * i, 0.1 * j, math.sin(0.2 * i) * math.cos(0.3 * j)) for j in columns] for i in range(20)]

        left = pia.fit_grid(sheet(range(0, 16)), control=8)
        right = pia.fit_grid(sheet(range(15, 31)), control=8, joins=[{"join": left, "end": "v0", "continuity": "G1"}])
        for i in range(11):
            self.near(right(i / 10, 0.0), left(i / 10, 1.0), 1e-3)

    def test_closed_curves_join_and_corners_stay_sharp(self):
        circle = [[math.cos(a), math.sin(a)] for a in (2 * math.pi * i / 60 for i in range(60))]
        model = pia.fit_curve(circle, closed=True, tolerance=1e-3)
        self.assertTrue(model.closed)
        self.near(model(model.domain[0]), model(model.domain[1]), 1e-12)
        corner = [[i, abs(i - 20)] for i in range(41)]
        model = pia.fit_curve(corner, tolerance=1e-6, corners=[20])
        self.assertLess(model.deviation([[20.0, 0.0]]).max_error, 1e-6)

    def test_frozen_control_points_stay(self):
        points = wave(80)
        start = pia.fit_curve(points, control=10, method="lspia", max_iterations=0)
        model = pia.fit_curve(points, start=start, method="lspia", freeze=[3], max_iterations=5)
        self.near(model.control[3], start.control[3], 1e-15)
        self.assertGreater(abs(model.control[4][1] - start.control[4][1]), 1e-9)

    def test_weights_and_tolerances_belong_to_points(self):
        points = [[i, 0] for i in range(20)]
        points[10][1] = 1
        heavy = pia.fit_curve(points, control=6, weights=[1000 if i == 10 else 1 for i in range(20)])
        light = pia.fit_curve(points, control=6, weights=[0 if i == 10 else 1 for i in range(20)])
        parameter = 10 / 19
        self.assertGreater(heavy(parameter)[1], 0.5)
        self.assertLess(abs(light(parameter)[1]), 0.1)
        model = pia.fit_curve(wave(200), tolerances=[1e-2] * 100 + [1e-4] * 100)
        self.assertIs(model.report.reached, True)

    def test_tolerances_belong_to_axes(self):
        report = pia.fit_curve(wave(200), axis_tolerances=[1e-2, 1e-4]).report
        self.assertIs(report.reached, True)
        self.assertTrue(report.axis_error[0] <= 1e-2 and report.axis_error[1] <= 1e-4)
        report = pia.fit_curve(wave(200), axis_tolerances=[1, 1e-9], control=8).report
        self.assertIs(report.reached, False)
        self.assertEqual(report.worst_axis, 1)
        self.assertIn("axis 2 of 2", " ".join(report.warnings))
        self.assertIsNone(pia.fit_curve(wave(200), tolerance=1e-3).report.axis_error)
        with self.assertRaises(pia.ShapeError):
            pia.fit_curve(wave(200), axis_tolerances=[1])

    def test_threads_do_not_change_a_bit(self):
        points = wave(20000)
        self.same(pia.fit_curve(points, control=300, threads=1).control, pia.fit_curve(points, control=300, threads=4).control)


class Others(Case):
    def test_a_function_graph_sorts_its_abscissas(self):
        x = [((37 * i) % 101) / 10 for i in range(101)]
        y = [math.sin(v) for v in x]
        model = pia.fit_function(x, y, control=30)
        self.near(model(5.0), [5.0, math.sin(5.0)], 1e-4)
        self.same(pia.fit_function(list(zip(x, y)), control=30).control, model.control)
        both = pia.fit_function(x, [[math.sin(v), math.cos(v)] for v in x], control=30)
        self.near(both(5.0), [5.0, math.sin(5.0), math.cos(5.0)], 1e-4)

    def test_grids_of_points_and_of_heights(self):
        points = [[[i, j, math.sin(0.3 * i) * math.cos(0.2 * j)] for j in range(25)] for i in range(20)]
        model = pia.fit_grid(points, control=(8, 9))
        self.assertEqual(model.control_count, (8, 9))
        self.assertEqual(model.report.kind, "grid")
        self.assertLess(model.report.max_error, 0.02)
        heights = [[p[2] for p in row] for row in points]
        flat = pia.fit_grid(heights, x=range(25), y=range(20), control=(8, 9))
        self.near(flat(0.3, 0.6)[2], model(0.3, 0.6)[2], 1e-12)
        closed = pia.fit_grid(points, control=8, closed=(False, True))
        self.assertEqual(closed.closed, (False, True))

    def test_scattered_points_with_given_or_named_parameters(self):
        place = [((i * 0.618034) % 1, (i * 0.414214) % 1) for i in range(600)]
        points = [[u, v, u * v] for u, v in place]
        given = pia.fit_surface(points, parameters=place, control=6)
        self.assertLess(given.report.max_error, 1e-10)
        named = pia.fit_surface(points, parameters="xy", control=6)
        self.assertLess(named.report.max_error, 1e-10)
        self.assertEqual(len(given.parameters), 600)

    def test_a_noisy_curve_suggests_a_tolerance(self):
        noise = [((i * 7919) % 1000 / 1000 - 0.5) * 0.02 for i in range(500)]
        tolerance, deviation = pia.suggest_tolerance([[i * 0.1, n] for i, n in enumerate(noise)])
        self.assertGreater(tolerance, deviation)
        self.assertLess(deviation, 0.02)

    def test_points_of_a_file_fit(self):
        points = pia.read_points(f"{DATA}/airfoil/rae2822.dat")
        model = pia.fit_curve(points, tolerance=1e-4)
        self.assertTrue(model.report.reached)
        self.assertLess(model.control_count, 40)


class Failures(Case):
    def refused(self, error, words, call, *arguments, **options):
        with self.assertRaises(error) as caught:
            call(*arguments, **options)
        for word in words if isinstance(words, tuple) else (words,):
            self.assertIn(word, str(caught.exception))
        return caught.exception

    def test_failures_are_pia_errors_and_what_they_resemble(self):
        points = wave(30)
        self.refused(pia.ArgumentError, "tolerance is -1", pia.fit_curve, points, tolerance=-1)
        self.refused(ValueError, "no method", pia.fit_curve, points, method="magic")
        self.refused(pia.DataError, ("row 2", "nan"), pia.fit_curve, [[0, 0], [1, 1], [2, math.nan], [3, 3]])
        self.refused(pia.ConstraintError, "", pia.fit_curve, points, control=5, interpolate=range(20))
        self.refused(pia.FileError, "/no/such/file", pia.read_points, "/no/such/file.csv")
        self.refused(OSError, "/no/such/file", pia.load, "/no/such/file.json")
        self.refused(pia.FormatError, "rae2822.dat", pia.load, f"{DATA}/airfoil/rae2822.dat", format="json")
        for name in ("ArgumentError", "ShapeError", "DataError", "FileError", "FormatError", "OutOfMemory"):
            self.assertTrue(issubclass(getattr(pia, name), pia.Error))
        self.assertTrue(issubclass(pia.OutOfMemory, MemoryError))

    def test_misspelt_options_are_told_the_right_one(self):
        self.refused(TypeError, "did you mean 'tolerance'", pia.fit_curve, wave(30), tolerence=1)
        self.refused(TypeError, "did you mean 'control'", pia.Fit, wave(30), contol=9)

    def test_values_of_the_wrong_kind_name_their_option(self):
        points = wave(30)
        self.refused(TypeError, "degree", pia.fit_curve, points, degree="three")
        self.refused(ValueError, "degree", pia.fit_curve, points, degree=(3, 3))
        self.refused(TypeError, "tolerance", pia.fit_curve, points, tolerance="small")
        self.refused(TypeError, "method", pia.fit_curve, points, method=7)
        self.refused(TypeError, "is no row", pia.fit_curve, points, interpolate=[0.5])
        self.refused(TypeError, "method_options", pia.fit_curve, points, method="wpia", method_options="omega=1")
        self.refused(TypeError, "Model", pia.fit_curve, points, start="model")
        self.refused(ValueError, "measure", pia.fit_curve, points, measure="miles")
        self.refused(ValueError, "interpolate", pia.fit_curve, points, interpolate="every")
        self.refused(TypeError, "no 'row'", pia.fit_curve, points, constraints=[{"row": 3}])
        self.refused(ValueError, "'at' is missing", pia.fit_curve, points, constraints=[{"value": [0, 0]}])
        self.refused(ValueError, "value has 3", pia.fit_curve, points, constraints=[{"at": 3, "value": [0, 0, 0]}])
        line = pia.fit_curve(points)
        self.refused(TypeError, "a pia.Model", pia.fit_curve, points, joins=[{"join": 3, "end": "start"}])
        self.refused(ValueError, "are needed", pia.fit_curve, points, joins=[{"join": line}])
        self.refused(ValueError, "end is 'top'", pia.fit_curve, points, joins=[{"join": line, "end": "top"}])
        self.refused(ValueError, "'C0', 'G1' or 'C1'", pia.fit_curve, points, joins=[{"join": line, "end": "end", "continuity": "C2"}])
        self.refused(TypeError, "no 'edge'", pia.fit_curve, points, joins=[{"join": line, "edge": "end"}])
        self.refused(TypeError, "a dict such as", pia.fit_curve, points, joins=[line])
        self.refused(ValueError, "no order", pia.fit_curve, points, constraints=[{"at": 0.5, "derivative": 1.5, "value": [0, 0]}])

    def test_shapes_that_do_not_fit_say_what_is_needed(self):
        self.refused(pia.ShapeError, "count, components", pia.fit_curve, [1.0, 2.0, 3.0])
        self.refused(pia.ShapeError, "rows, columns", pia.fit_grid, [1.0, 2.0])
        self.refused(pia.ShapeError, "17", pia.fit_curve, [[0.0] * 20] * 5)
        self.refused(ValueError, "rows differ in length", pia.fit_curve, [[0, 0], [1], [2, 2]])
        self.refused(pia.ShapeError, ("weights", "30"), pia.fit_curve, wave(30), weights=[1, 2])
        self.refused(pia.DataError, "point", pia.fit_curve, [[0.0, 0.0]])
        self.refused(TypeError, "number", pia.fit_curve, [["a", "b"], ["c", "d"]])
        self.refused(pia.ShapeError, "count, components", pia.fit_curve, 7)

    def test_registries_and_options_are_the_librarys(self):
        self.assertIn("lspia", [entry.name for entry in pia.registry("method")])
        self.assertIn("omega", [setting.name for setting in pia.settings("wpia")])
        self.assertRaises(ValueError, pia.registry, "fish")
        names = [option.name for option in pia.options()]
        self.assertEqual(len(names), len(set(names)))
        for option in pia.options():
            self.assertIn(option.sentence.split()[0], pia.fit_curve.__doc__ if option.name not in ("measure_distance", "parametrization", "placement") else option.sentence)
        self.assertRegex(pia.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
