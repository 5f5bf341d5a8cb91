"""Arrays in and out: what is read in place, what is converted, what is refused; with NumPy and without."""

import array
import ctypes
import os
import subprocess
import sys
import unittest

import pia
from common import Case, flat, needs, wave

POINTS = wave(60)
FLAT = [x for p in POINTS for x in p]


def control(points, **options):
    return flat(pia.fit_curve(points, control=12, **options).control)


class Buffers(Case):
    def test_doubles_are_the_same_from_any_buffer(self):
        doubles = memoryview(array.array("d", FLAT)).cast("B").cast("d", (60, 2))
        self.assertEqual(control(doubles), control(POINTS))
        self.assertEqual(control(tuple(map(tuple, POINTS))), control(POINTS))
        self.assertEqual(control(iter(POINTS)), control(POINTS))
        self.assertEqual(control([array.array("d", p) for p in POINTS]), control(POINTS))
        block = (ctypes.c_double * 2 * 60)(*(tuple(p) for p in POINTS))
        self.assertEqual(control(block), control(POINTS))

    def test_numbers_of_other_formats_are_converted(self):
        whole = [[i, (i * i) % 50] for i in range(60)]
        for code in "bBhHiIlLqQf":
            row = memoryview(array.array(code, [x for p in whole for x in p])).cast("B").cast(code, (60, 2))
            self.assertEqual(control(row), control(whole), code)

    def test_results_can_be_written_and_outlive_their_model(self):
        values = pia.fit_curve(POINTS, control=12).control
        values[0][0] = 7.0
        self.assertEqual(values[0][0], 7.0)
        self.assertNotEqual(control(POINTS)[0], 7.0)

    def test_a_buffer_is_let_go_after_success_and_failure(self):
        block = bytearray(array.array("d", FLAT))
        for degree in (3, 99):
            view = memoryview(block).cast("d", (60, 2))
            try:
                pia.fit_curve(view, control=12, degree=degree)
            except pia.ArgumentError:
                pass
            view.release()
            block.append(0)  # BufferError where somebody still holds it
            del block[-1:]

    def test_too_many_axes_and_odd_items_are_refused(self):
        with self.assertRaisesRegex(ValueError, "axes"):
            pia.fit_curve((ctypes.c_double * 2 * 2 * 2 * 2)())
        with self.assertRaisesRegex(TypeError, "no numbers"):
            pia.fit_curve(memoryview(b"abcdefgh").cast("c", (4, 2)))
        with self.assertRaises(ValueError):
            pia.fit_curve([[[[[1.0]]]]])
        nested = []
        nested.append(nested)
        with self.assertRaises(ValueError):
            pia.Model(1, [0, 0, 1, 1], nested)
        for empty in ([], [[]], [[], []]):
            with self.assertRaises(pia.Error):
                pia.fit_curve(empty)

    def test_t_peer_24_sizes_beyond_memory_are_refused_before_it_is_asked(self):
        row = [0.0] * 3
        line = [row] * 2_000_000
        with self.assertRaises(MemoryError):
            pia.fit_grid([line] * 2_000_000)

    def test_no_points_give_no_values(self):
        model = pia.fit_curve(POINTS, control=12)
        self.assertEqual(flat(model([])), [])
        self.assertEqual(flat(model.curvature([])), [])


@needs("numpy")
class NumPy(Case):
    def setUp(self):
        import numpy

        self.np = numpy
        self.points = numpy.array(POINTS)

    def test_results_are_arrays_of_the_shape_of_the_parameters(self):
        np, model = self.np, pia.fit_curve(self.points, control=12)
        t = np.linspace(0, 1, 24).reshape(2, 3, 4)
        self.assertEqual(model(t).shape, (2, 3, 4, 2))
        self.assertEqual(model(0.5).shape, (2,))
        self.assertEqual(model.derivative(t, order=2).shape, (2, 3, 4, 2))
        self.assertEqual(model.curvature(t).shape, (2, 3, 4))
        self.assertEqual(model(np.float64(0.5)).tolist(), model(0.5).tolist())
        self.assertEqual(model(np.zeros((0, 3))).shape, (0, 3, 2))
        parameters, distances = model.closest(self.points.reshape(3, 20, 2))
        self.assertEqual((parameters.shape, distances.shape), ((3, 20), (3, 20)))
        surface = pia.fit_grid(np.add.outer(np.arange(9.0), np.arange(8.0) ** 2), control=5)
        net = surface(np.linspace(0, 1, 7)[:, None], np.linspace(0, 1, 6))
        self.assertEqual(net.shape, (7, 6, 3))
        self.assertEqual(surface.derivative(np.zeros(4), 0.5).shape, (4, 2, 3))
        self.assertEqual(surface.closest(net)[0].shape, (7, 6, 2))

    def test_strides_byte_order_and_small_types_change_nothing(self):
        np, expected = self.np, control(POINTS)
        wide = np.zeros((120, 4))
        wide[::2, 1:3] = self.points
        for points in (
            np.asfortranarray(self.points),
            wide[::2, 1:3],
            self.points[::-1][::-1],
            self.points.astype(">f8"),
            np.frombuffer(b"x" + self.points.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(60, 2),
        ):
            self.assertEqual(control(points), expected)
        self.assertEqual(control(self.points.astype(np.float32)), control(self.points.astype(np.float32).tolist()))
        whole = (self.points * 100).astype(np.int16)
        self.assertEqual(control(whole), control(whole.tolist()))
        for odd in (self.points.astype(complex), self.points.astype(object), self.points.astype(np.float16)):
            with self.assertRaises((TypeError, ValueError)):
                pia.fit_curve(odd)

    def test_c_order_doubles_are_read_in_place(self):
        """The library sees the very numbers: a fit of 80 MB takes no second 80 MB."""
        import tracemalloc

        points = self.np.zeros((5_000_000, 2))
        points[:, 0] = self.np.arange(5_000_000)
        tracemalloc.start()
        pia.suggest_tolerance(points)
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        self.assertLess(peak, 1_000_000)

    def test_t_peer_24_a_broadcast_array_that_stands_for_terabytes_is_refused(self):
        endless = self.np.broadcast_to(1.0, (500_000, 500_000, 3))
        with self.assertRaises(MemoryError):
            pia.fit_grid(endless)

    def test_rows_and_weights_may_be_arrays(self):
        np = self.np
        model = pia.fit_curve(self.points, control=12, interpolate=np.array([0, -1]), weights=np.ones(60, dtype=np.int8))
        self.near(model(1.0), POINTS[-1], 1e-12)
        with self.assertRaises(TypeError):
            pia.fit_curve(self.points, interpolate=np.array([0.5]))
        model = pia.fit_curve(self.points, control=12, constraints=[{"at": np.int64(5)}, {"at": np.float64(0.9), "value": self.points[54]}])
        self.assertLess(model.report.constraint_error, 1e-12)

    def test_whatever_has_an_array_is_taken(self):
        class Frame:
            def __init__(self, values):
                self.values = values

            def __len__(self):
                return len(self.values)

            @property
            def shape(self):
                return self.values.shape

            def __array__(self):
                return self.values

        self.assertEqual(control(Frame(self.points)), control(POINTS))


class WithoutNumPy(Case):
    def test_everything_else_works_where_numpy_is_missing(self):
        here = os.path.dirname(os.path.abspath(__file__))
        program = (
            "import sys; sys.modules['numpy'] = None; sys.path.insert(0, sys.argv[1]); import unittest\n"
            "from test_fits import *; from test_models import *; from test_progressive import *\n"
            "import pia; assert type(pia.fit_curve([[0, 0], [1, 1], [2, 0], [3, 1]]).control) is list\n"
            "unittest.main(argv=['test'])"
        )
        done = subprocess.run([sys.executable, "-c", program, here], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr[-4000:])


if __name__ == "__main__":
    unittest.main()
