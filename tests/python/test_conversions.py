"""Models as SciPy and geomdl hold them; SciPy's values are the reference."""

import unittest

import pia
from common import Case, needs, wave


class Dicts(Case):
    def test_curves_surfaces_and_rational_models_survive(self):
        knots = [0, 0, 0, 1, 1, 1]
        arc = pia.Model(2, knots, [[1, 0], [1, 1], [0, 1]], [1, 0.5, 1])
        net = [[[i, j, i * j] for j in range(3)] for i in range(4)]
        patch = pia.Model((3, 2), ([0, 0, 0, 0, 1, 1, 1, 1], knots), net)
        for model, at in ((arc, (0.3,)), (patch, (0.3, 0.6)), (pia.fit_curve(wave(30)), (0.3,))):
            shape = model.to_dict()
            again = pia.Model.from_dict(shape)
            self.near(again(*at), model(*at), 1e-15)
            self.assertEqual(again.to_dict(), shape)
        self.assertEqual(patch.to_dict()["size_v"], 3)
        self.assertEqual(patch.to_dict()["control_points"][4], [1, 1, 1])


@needs("scipy.interpolate")
class SciPy(Case):
    def setUp(self):
        import numpy
        import scipy.interpolate

        self.np, self.scipy = numpy, scipy.interpolate

    def test_values_and_derivatives_agree_both_ways(self):
        np = self.np
        model = pia.fit_curve(wave(60, 3), control=14, degree=4)
        spline = model.to_scipy()
        t = np.linspace(0, 1, 101)
        for order in range(4):
            scale = np.abs(spline(t, nu=order)).max()
            self.near(model.derivative(t, order=order) / scale, spline(t, nu=order) / scale, 1e-12)
        self.same(pia.Model.from_scipy(spline).control, model.control)

    def test_interpolation_is_scipys_on_the_same_knots(self):
        np = self.np
        t = np.linspace(0, 1, 30)
        y = np.array(wave(30))
        theirs = self.scipy.make_interp_spline(t, y, k=5)
        ours = pia.fit_curve(y, parameters=t, knots=theirs.t, degree=5)
        self.near(ours.control, theirs.c, 1e-11)

    def test_least_squares_is_scipys_on_the_same_knots(self):
        np = self.np
        t = np.linspace(0, 1, 200)
        y = np.array(wave(200))
        knots = np.r_[[0] * 4, np.linspace(0, 1, 12)[1:-1], [1] * 4]
        theirs = self.scipy.make_lsq_spline(t, y, knots, k=3)
        ours = pia.fit_curve(y, parameters=t, knots=knots)
        self.near(ours.control, theirs.c, 1e-11)

    def test_what_splprep_makes_is_taken(self):
        np = self.np
        x = np.linspace(0, 6, 80)
        tck, u = self.scipy.splprep([np.cos(x), np.sin(x)], s=1e-4)
        model = pia.Model.from_scipy((tck, u))
        self.near(model(u), np.array(self.scipy.splev(u, tck)).T, 1e-13)

    def test_periodic_and_unclamped_splines_are_clamped_without_a_change(self):
        np = self.np
        t = np.linspace(0, 1, 41)
        ring = np.c_[np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)]
        ring[-1] = ring[0]
        spline = self.scipy.make_interp_spline(t, ring, bc_type="periodic")
        model = pia.Model.from_scipy(spline)
        self.assertTrue(model.closed)
        self.near(model(t), spline(t), 1e-13)
        open_spline = self.scipy.BSpline(np.arange(12.0), np.random.default_rng(5).normal(size=(8, 2)), 3)
        inside = np.linspace(3, 8, 50)
        model = pia.Model.from_scipy(open_spline)
        self.near(model(inside), open_spline(inside), 1e-12)
        self.assertEqual(model.domain, (3.0, 8.0))

    def test_surfaces_need_a_new_scipy(self):
        model = pia.fit_grid([[[i, j, i * j] for j in range(9)] for i in range(8)], control=5)
        if hasattr(self.scipy, "NdBSpline"):
            self.near(model.to_scipy()([[0.3, 0.6]])[0], model(0.3, 0.6), 1e-12)
            again = pia.Model.from_scipy(model.to_scipy())
        else:
            self.assertRaisesRegex(ImportError, "1.11", model.to_scipy)
            again = pia.Model.from_scipy((model.knots, model.control, model.degree))
        self.near(again.control, model.control, 1e-15)

    def test_rational_models_are_refused(self):
        arc = pia.Model(2, [0, 0, 0, 1, 1, 1], [[1, 0], [1, 1], [0, 1]], [1, 0.5, 1])
        self.assertRaisesRegex(pia.Error, "rational", arc.to_scipy)


if __name__ == "__main__":
    unittest.main()
