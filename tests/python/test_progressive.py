"""The progressive service: each method does what the C call of its name does."""

import os
import tempfile
import unittest

import pia
from common import Case, wave


class Steps(Case):
    def test_steps_make_the_error_fall_and_run_ends_it(self):
        with pia.Fit(wave(200), control=30, method="lspia") as fit:
            first = fit.step(1)
            later = fit.step(20)
            self.assertEqual((first.iterations, later.iterations, later.stop), (1, 21, "none"))
            self.assertLess(later.max_error, first.max_error)
            self.assertNotEqual(fit.run().stop, "none")
            self.near(fit.model.control, pia.fit_curve(wave(200), control=30).control, 1e-9)
            self.assertRaises(ValueError, fit.step, -1)

    def test_one_call_and_steps_give_the_same_bits(self):
        options = {"control": 25, "method": "lspia", "max_iterations": 40}
        with pia.Fit(wave(150), **options) as fit:
            for _ in range(40):
                fit.step()
            self.same(fit.model.control, pia.fit_curve(wave(150), **options).control)

    def test_what_can_be_looked_at(self):
        points = wave(150)
        with pia.Fit(points, control=25, method="lspia", trace_every=1) as fit:
            fit.step(5)
            self.assertEqual([row.iteration for row in fit.trace][:3], [0, 1, 2])
            self.assertEqual(fit.trace[-1].max_error, fit.report.max_error)
            at, model = fit.parameters, fit.model
            self.assertEqual(len(at), 150)
            self.assertIsNone(fit.rows)
            self.near([[p[0] - q[0], p[1] - q[1]] for p, q in zip(points, model(at))], fit.residuals, 1e-14)
            self.assertEqual(fit.unsupported, [])
            self.assertIsNone(fit.robust_weights)
            self.assertIn("<pia.Fit lspia", repr(fit))

    def test_outliers_get_small_weights(self):
        points = wave(100)
        points[50][1] += 5
        with pia.Fit(points, control=12, robust="tukey") as fit:
            fit.run()
            self.assertLess(fit.robust_weights[50], 0.5)
            self.assertGreater(fit.robust_weights[10], 0.5)
            self.assertEqual(fit.report.outlier_count, sum(w < 0.5 for w in fit.robust_weights))

    def test_grids_and_clouds_and_graphs(self):
        grid = [[[i, j, i * j / 50] for j in range(12)] for i in range(10)]
        with pia.Fit(grid, control=(5, 6)) as fit:
            fit.run()
            self.assertEqual(len(fit.parameters), 22)
            self.assertEqual(fit.model.control_count, (5, 6))
        place = [((i * 0.618034) % 1, (i * 0.414214) % 1) for i in range(300)]
        with pia.Fit([[u, v, u * v] for u, v in place], "surface", parameters=place, control=5) as fit:
            fit.run()
            self.same(fit.parameters, place)
        with pia.Fit([[x / 10, x * x / 100] for x in range(60)], "function", control=8) as fit:
            fit.run()
            self.assertEqual(len(fit.residuals[0]), 1)
            self.near(fit.model(2.0), [2, 4], 1e-10)
        self.assertRaises(ValueError, pia.Fit, grid, "blob")


class Edits(Case):
    def setUp(self):
        self.points = wave(120)
        self.fit = pia.Fit(self.points, control=15, method="direct")
        self.fit.run()

    def tearDown(self):
        self.fit.close()

    def again(self, points, **options):
        return pia.fit_curve(points, parameters=self.fit.parameters, knots=self.fit.model.knots, **options).control

    def test_a_moved_point_is_fitted_where_it_is(self):
        self.fit.move_point(60, [0.5, 3.0])
        self.fit.run()
        moved = [list(p) for p in self.points]
        moved[60] = [0.5, 3.0]
        self.near(self.fit.model.control, self.again(moved), 1e-10)

    def test_a_dropped_point_is_as_if_it_had_no_weight(self):
        self.fit.weigh_point(60, 0)
        self.fit.run()
        self.near(self.fit.model.control, self.again(self.points, weights=[i != 60 for i in range(120)]), 1e-10)

    def test_added_points_pull(self):
        before = self.fit.model(0.5)[1]
        self.fit.add_point([0.5, before + 1], 0.5, 1e6)
        self.fit.add_points([[0.0, 0.0]], [0.0])
        self.fit.run()
        self.assertAlmostEqual(self.fit.model(0.5)[1], before + 1, delta=1e-3)
        self.assertEqual(self.fit.report.point_count, 122)

    def test_constraints_come_and_go(self):
        free = self.fit.model.control
        ids = self.fit.constrain([{"at": 0.5, "value": [0.5, 2.0]}, {"at": 7}])
        self.assertEqual(len(ids), 2)
        self.fit.run()
        self.near(self.fit.model(0.5), [0.5, 2.0], 1e-10)
        for id in ids:
            self.fit.release(id)
        self.fit.run()
        self.near(self.fit.model.control, free, 1e-9)
        self.assertRaises(pia.Error, self.fit.release, 99)

    def test_corners_are_told_by_their_rows(self):
        corner = [[i, abs(i - 20)] for i in range(41)]
        with pia.Fit(corner, tolerance=1e-6, corners="auto") as fit:
            self.assertEqual(fit.corners, [20])
        self.assertEqual(self.fit.corners, [])

    def test_joins_come_and_go(self):
        free = self.fit.model(0.0)
        other = pia.fit_curve([[x / 9 - 1, 0.3] for x in range(10)])
        ids = self.fit.join([{"join": other, "end": "start"}])
        self.assertGreaterEqual(len(ids), 2)
        self.fit.run()
        self.near(self.fit.model(0.0), [0.0, 0.3], 1e-10)
        self.assertLess(abs(self.fit.model.derivative(0.0)[1]), 1e-8)
        for id in ids:
            self.fit.release(id)
        self.fit.run()
        self.near(self.fit.model(0.0), free, 1e-9)

    def test_knots_are_inserted_and_control_points_frozen(self):
        before = self.fit.model
        self.fit.insert_knot(0.51)
        self.assertEqual(self.fit.model.control_count, 16)
        self.near(self.fit.model(0.3), before(0.3), 1e-12)
        frozen = self.fit.model.control[4]
        self.fit.freeze([4])
        self.fit.move_point(30, [0.25, 9.0])
        self.fit.run()
        self.near(self.fit.model.control[4], frozen, 0)
        self.fit.free([4])
        self.fit.run()
        self.assertGreater(abs(self.fit.model.control[4][1] - frozen[1]), 1e-6)

    def test_rules_can_be_set(self):
        with pia.Fit(self.points, control=15, method="lspia") as fit:
            fit.set("max_iterations", 7)
            self.assertEqual(fit.run().iterations, 7)
            self.assertRaises(pia.ArgumentError, fit.set, "colour", "red")

    def test_wrong_edits_are_refused_and_harm_nothing(self):
        before = self.fit.model.control
        self.assertRaises(pia.Error, self.fit.move_point, 1000, [0, 0])
        self.assertRaises(pia.ShapeError, self.fit.move_point, 3, [0, 0, 0])
        self.assertRaises(TypeError, self.fit.freeze, [1.5])
        self.assertRaises(pia.Error, self.fit.freeze, [1000])
        self.assertRaises(pia.Error, self.fit.insert_knot, 0.5, 4)
        self.same(self.fit.model.control, before)


class Life(Case):
    def test_a_saved_fit_goes_on_with_the_same_bits(self):
        with tempfile.TemporaryDirectory() as folder, pia.Fit(wave(100), control=20, method="lspia", stop_change=0) as fit:
            path = os.path.join(folder, "fit.pia")
            fit.step(5)
            fit.save(path)
            fit.step(5)
            seen = []
            with pia.Fit.resume(path, progress=seen.append) as other:
                self.assertEqual(other.step(5).iterations, 10)
                self.same(other.model.control, fit.model.control)
                self.same(other.residuals, fit.residuals)
            self.assertEqual(seen[0].iterations, 5)
            self.assertRaises(pia.FileError, pia.Fit.resume, os.path.join(folder, "none.pia"))

    def test_a_resumed_function_graph_knows_its_shape(self):
        with tempfile.TemporaryDirectory() as folder, pia.Fit([[x, x % 7] for x in range(60)], "function", control=9) as fit:
            path = os.path.join(folder, "fit.pia")
            fit.save(path)
            with pia.Fit.resume(path) as other:
                self.assertEqual(len(other.residuals[0]), 1)
                other.move_point(3, [5.0])

    def test_a_closed_fit_says_so_and_its_models_live_on(self):
        fit = pia.Fit(wave(50), control=9)
        fit.run()
        model = fit.model
        fit.close()
        fit.close()
        self.assertRaisesRegex(RuntimeError, "closed", fit.step)
        self.assertEqual(repr(fit), "<pia.Fit: the fit is closed>")
        self.near(model(0.0), wave(50)[0], 1)


if __name__ == "__main__":
    unittest.main()
