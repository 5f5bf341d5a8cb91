"""Models: values, shapes, edits, files, pickles."""

import copy
import math
import os
import pickle
import tempfile
import unittest

import pia
from common import Case, flat, wave

CIRCLE = ((0, 0, 0, 1, 1, 1), [[1, 0], [1, 1], [0, 1]], [1, math.sqrt(0.5), 1])


def quarter():
    knots, control, weights = CIRCLE
    return pia.Model(2, knots, control, weights)


def saddle():
    """z = x y on the unit square, bilinear."""
    knots = [0, 0, 1, 1]
    return pia.Model((1, 1), (knots, knots), [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]])


class Values(Case):
    def test_a_rational_quarter_is_a_circle(self):
        for i in range(11):
            x, y = quarter()(i / 10)
            self.assertAlmostEqual(x * x + y * y, 1, delta=1e-15)
        self.near(quarter().curvature(0.3), [1], 1e-12)
        self.assertAlmostEqual(quarter().length(), math.pi / 2, delta=1e-10)

    def test_one_parameter_gives_a_point_and_many_give_their_shape(self):
        model = pia.fit_curve(wave(50, 3), control=10)
        self.assertEqual(len(model(0.25)), 3)
        self.same(model([0.25, 0.5])[1], model(0.5))
        self.assertEqual(len(flat(model([[0.1, 0.2], [0.3, 0.4]]))), 12)

    def test_derivatives_agree_with_differences(self):
        model = pia.fit_curve(wave(50), control=10)
        h = 1e-5
        for axis in range(2):
            slope = (model(0.4 + h)[axis] - model(0.4 - h)[axis]) / (2 * h)
            self.assertAlmostEqual(model.derivative(0.4)[axis], slope, delta=1e-6)
        self.near(model.derivative([0.2, 0.4], order=2), [model.derivative(0.2, order=2), model.derivative(0.4, order=2)], 0)
        self.near(model.derivative(0.4, order=4), [0, 0], 0)

    def test_a_surface_takes_two_parameters(self):
        model = saddle()
        self.near(model(0.5, 0.25), [0.5, 0.25, 0.125], 1e-15)
        self.near(model([0.5, 1.0], [0.25, 1.0]), [[0.5, 0.25, 0.125], [1, 1, 1]], 1e-15)
        self.near(model.derivative(0.5, 0.25), [[1, 0, 0.25], [0, 1, 0.5]], 1e-14)
        self.near(model.derivative(0.5, 0.25, order=(1, 1)), [0, 0, 1], 1e-14)
        self.near(model.derivative(0.5, 0.25, order=(0, 1)), [0, 1, 0.5], 1e-14)
        mean, gauss = model.curvature(0.0, 0.0)
        self.assertAlmostEqual(gauss, -1, delta=1e-12)
        self.assertAlmostEqual(mean, 0, delta=1e-12)
        self.assertRaises(TypeError, model, 0.5)
        self.assertRaises(ValueError, model.derivative, 0.5, 0.5, order=2)

    def test_closest_points_and_deviations(self):
        parameters, distances = quarter().closest([[2.0, 0.0], [0.0, 0.5]])
        self.near(distances, [1, 0.5], 1e-12)
        self.near(parameters, [0, 1], 1e-9)
        parameter, distance = quarter().closest([math.sqrt(2), math.sqrt(2)])
        self.assertAlmostEqual(distance, 1, delta=1e-12)
        self.assertAlmostEqual(parameter, 0.5, delta=1e-9)
        self.near(saddle().closest([0.5, 0.25, 0.125])[0], [0.5, 0.25], 1e-9)
        deviation = quarter().deviation([[2.0, 0.0], [0.0, 0.5]])
        self.assertEqual((deviation.max_error_index, deviation.point_count, deviation.foot_points), (0, 2, True))
        self.assertAlmostEqual(deviation.max_error, 1, delta=1e-12)
        at = quarter().deviation([[1.0, 0.0], [0.0, 0.0]], parameters=[0.0, 1.0])
        self.near(at.distances, [0, 1], 1e-15)
        self.assertRaises(ValueError, quarter().closest, [[1.0, 2.0, 3.0]])

    def test_what_it_is(self):
        model = quarter()
        self.assertEqual((model.degree, model.control_count, model.dim, model.rational, model.closed), (2, 3, 2, True, False))
        self.assertEqual(model.domain, (0.0, 1.0))
        self.near(model.weights, CIRCLE[2], 1e-15)
        self.near(model.control, CIRCLE[1], 1e-15)
        self.assertIsNone(model.report)
        self.assertIsNone(model.parameters)
        surface = saddle()
        self.assertEqual((surface.degree, surface.control_count, surface.directions), ((1, 1), (2, 2), 2))
        self.same(surface.knots[1], [0, 0, 1, 1])
        self.assertIn("surface of degree 1 x 1, 2 x 2 control points in 3", repr(surface))
        self.assertIn("rational curve of degree 2", repr(model))
        low, high = model.bounds()
        self.near([*low, *high], [0, 0, 1, 1], 1e-12)

    def test_impossible_models_are_refused(self):
        knots, control, weights = CIRCLE
        self.assertRaises(pia.ShapeError, pia.Model, 2, knots[1:], control)
        self.assertRaises(pia.Error, pia.Model, 0, knots, control)
        self.assertRaises(pia.Error, pia.Model, 2, knots, control, [1, -1, 1])
        self.assertRaises(pia.ShapeError, pia.Model, 2, knots, control, [1, 1])
        self.assertRaises(pia.ShapeError, pia.Model, (2, 2), (knots, knots), control)
        self.assertRaises(pia.DataError, pia.Model, 2, knots, [[1, 0], [math.nan, 1], [0, 1]])


class Edits(Case):
    def test_the_same_shape_with_more_knots_or_a_higher_degree(self):
        model = pia.fit_curve(wave(50), control=10)
        at = [i / 37 for i in range(38)]
        for other in (model.insert_knots([0.3, 0.3, 0.7]), model.elevate(2), model.bezier()):
            self.near(other(at), model(at), 1e-12)
        self.assertEqual(model.insert_knots([0.3, 0.3, 0.7]).control_count, 13)
        self.assertEqual(model.elevate(2).degree, 5)
        back, error = model.insert_knots([0.31]).remove_knots(1e-9)
        self.assertLessEqual(back.control_count, 10)
        self.assertLessEqual(error, 1e-9)
        left, right = model.split(0.4)
        self.near(left(0.2), model(0.2), 1e-12)
        self.near(right(0.8), model(0.8), 1e-12)
        self.assertRaises(pia.Error, model.split, 2.0)
        surface = saddle().insert_knots([0.5], direction=1)
        self.assertEqual(surface.control_count, (2, 3))


    def test_a_trimmed_surface_keeps_its_loops(self):
        outside = [[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]]
        hole = [[0.4, 0.4], [0.4, 0.6], [0.6, 0.6], [0.6, 0.4]]
        face = saddle().trim([outside, hole])
        self.assertEqual((face.contains(0.2, 0.2), face.contains(0.5, 0.5), face.contains(0.05, 0.5)), (True, False, False))
        self.assertIn("trimmed surface", repr(face))
        self.same(face(0.5, 0.5), saddle()(0.5, 0.5))
        again = pickle.loads(pickle.dumps(face))
        self.assertEqual([flat(loop) for loop in again.trim_loops], [flat(loop) for loop in face.trim_loops])
        self.assertEqual(sorted(map(tuple, zip(*[iter(flat(face.trim_loops[0]))] * 2))), sorted(map(tuple, outside)))
        self.assertEqual(face.trim([]).trim_loops, [])
        self.assertTrue(quarter().contains(0.5, 0))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "face.json")
            face.save(path)
            self.assertEqual(len(pia.load(path).trim_loops), 2)
        self.assertRaises(pia.ShapeError, saddle().trim, [[[0.1, 0.1, 0.1]] * 3])
        self.assertRaises(pia.Error, saddle().trim, [outside, outside])
        self.assertRaises(pia.Error, quarter().trim, [outside])


class Files(Case):
    def test_a_model_and_its_report_come_back_from_json(self):
        model = pia.fit_curve(wave(50), tolerance=1e-3)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "m.json")
            model.save(path)
            again = pia.load(path)
            self.same(again.control, model.control)
            self.same(again.knots, model.knots)
            self.assertEqual(again.report.max_error, model.report.max_error)
            self.assertEqual(again.report.warnings, model.report.warnings)
            for name in ("m.step", "m.igs", "m.g2", "m.csv"):
                model.save(os.path.join(folder, name))
                self.assertGreater(os.path.getsize(os.path.join(folder, name)), 100)
            pia.save(path, [model, quarter()])
            self.assertEqual([m.rational for m in pia.load_all(path)], [False, True])
            part = os.path.join(folder, "part.step")
            model.save(part, unit="m", schema="ap242", tolerance=1e-5, name="flange")
            with open(part) as file:
                text = file.read()
            self.assertIn("flange", text)
            self.assertIn("AP242", text)
            self.assertRaisesRegex(ValueError, "unit", model.save, part, unit="mile")
            self.assertRaisesRegex(ValueError, "2 models", pia.load, path)
            self.assertRaisesRegex(ValueError, "extension", model.save, os.path.join(folder, "m.xyzzy"))

    def test_models_of_one_file_live_on_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "m.json")
            pia.save(path, [quarter() for _ in range(5)])
            last = pia.load_all(path)[-1]
        self.near(last(0.0), [1, 0], 0)

    def test_pictures_are_drawn_where_the_build_can(self):
        if "not in" in next(part.detail for part in pia.registry("part") if part.name == "cairo"):
            self.skipTest("built without Cairo")
        points = wave(50)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "m.svg")
            pia.fit_curve(points, control=9).plot(path, points, title="A wave", comb=True)
            with open(path) as file:
                self.assertIn("<svg", file.read())
            saddle().plot(os.path.join(folder, "s.png"), azimuth=30, elevation=20, width=300)
            pia.plot(path, [quarter(), quarter()])
        self.assertRaises(ValueError, pia.plot, "x.svg", [])

    def test_columns_parts_and_grids_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "p.csv")
            with open(path, "w") as file:
                file.write("a,b,c\n1,2,3\n4,5,6\n\n7,8,9\n")
            self.same(pia.read_points(path, columns="c,a"), [[3, 1], [6, 4], [9, 7]])
            self.assertEqual([len(part) for part in pia.read_parts(path)], [2, 1])
            self.same(pia.read_points(path, part=1), [[7, 8, 9]])
            path = os.path.join(folder, "h.csv")
            with open(path, "w") as file:
                file.write("1,2,3\n4,5,6\n")
            grid = pia.read_points(path, grid=True)
            self.assertEqual(len(flat(grid)), 18)
            self.assertEqual(flat(grid)[-1], 6)


class Python(Case):
    def test_pickles_come_back_with_their_report(self):
        for model in (pia.fit_curve(wave(50), tolerance=1e-3), saddle()):
            again = pickle.loads(pickle.dumps(model))
            self.assertIs(type(again), pia.Model)
            self.same(again.control, model.control)
            self.same(again.knots[0] if model.directions == 2 else again.knots, model.knots[0] if model.directions == 2 else model.knots)
            self.assertEqual(repr(again), repr(model))
            self.same(pickle.loads(pickle.dumps(again)).control, model.control)
        self.near(pickle.loads(pickle.dumps(quarter())).control, CIRCLE[1], 1e-15)

    def test_copies_of_what_cannot_change_are_itself(self):
        model = quarter()
        self.assertIs(copy.copy(model), model)
        self.assertIs(copy.deepcopy([model])[0], model)

    def test_subclasses_stay_subclasses(self):
        class Mine(pia.Model):
            pass

        mine = Mine(2, *CIRCLE)
        self.assertIs(type(mine.elevate()), Mine)
        self.assertIs(type(mine.split(0.5)[1]), Mine)


if __name__ == "__main__":
    unittest.main()
