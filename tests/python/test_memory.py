"""References and memory: nothing is lost in success or failure, and failing allocations end in MemoryError."""

import gc
import os
import pickle
import resource
import subprocess
import sys
import unittest

import pia
from common import Case, needs, wave

POINTS = wave(40)
BAD = [
    dict(control=10, degree=99),
    dict(control=10, method="magic"),
    dict(control=10, constraints=[{"at": 3}, {"at": 4, "value": [1]}]),
    dict(control=10, interpolate=[500]),
    dict(weights=[1.0]),
    dict(start=3),
    dict(joins=[{"join": 3, "end": "start"}]),
    dict(method_options=7),
    dict(knots=[0, "a"]),
]


def work():
    """Every kind of call once."""
    model = pia.fit_curve(POINTS, control=10, interpolate="ends", constraints=[{"at": 0.5, "derivative": 1, "value": [1, 0]}], method_options={})
    for options in BAD:
        try:
            pia.fit_curve(POINTS, **options)
        except (pia.Error, TypeError, ValueError):
            continue
        raise AssertionError(f"{options} should fail")
    with pia.Fit(POINTS, control=10, joins=[{"join": model, "end": "start"}]) as fit:
        fit.join([{"join": model, "end": "end"}])
    model(0.5), model([0.1, 0.2]), model.derivative(0.5, order=2), model.curvature(0.5)
    model.closest(POINTS[:3]), model.deviation(POINTS), model.bounds(), model.length()
    model.insert_knots([0.5]), model.elevate(), model.split(0.5), model.bezier(), model.remove_knots(0.1)
    saddle = pia.Model((1, 1), ([0, 0, 1, 1], [0, 0, 1, 1]), [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]])
    saddle.trim([[[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]]]).trim_loops
    model.knots, model.control, model.weights, model.report, model.parameters, repr(model)
    pickle.loads(pickle.dumps(model)), pia.Model.from_dict(model.to_dict())
    with pia.Fit(POINTS, control=10, method="lspia", trace_every=1, progress=lambda report: False) as fit:
        fit.step(3)
        fit.move_point(3, [0, 0]), fit.weigh_point(4, 2), fit.add_point([0, 0], 0.5), fit.insert_knot(0.4)
        fit.trace, fit.parameters, fit.residuals, fit.model, fit.report, fit.unsupported, fit.warnings, fit.rows
        fit.freeze([1]), fit.free([1])
        try:
            fit.move_point(3, "xy")
        except (TypeError, ValueError):
            pass
    try:
        pia.fit_curve(POINTS, control=10, method="lspia", progress=lambda report: 1 / 0)
    except ZeroDivisionError as failure:
        failure.model(0.5)
    pia.options(), pia.registry("method"), pia.settings("wpia"), pia.suggest_tolerance(POINTS)


class References(Case):
    def test_no_object_is_lost_by_any_call(self):
        if not sys.getallocatedblocks():
            self.skipTest("PYTHONMALLOC=malloc counts nothing; the next test runs without it")
        growth, rounds = [], 100
        for _ in range(8):
            gc.collect()
            before = sys.getallocatedblocks()
            for _ in range(rounds):
                work()
            gc.collect()
            growth.append(sys.getallocatedblocks() - before)
        # Python's caches fill up, less and less; an object that is lost in every round is `rounds` objects in every block.
        self.assertLess(min(growth), rounds // 2, growth)

    def test_no_object_is_lost_with_pythons_own_allocator(self):
        if sys.getallocatedblocks():
            self.skipTest("the test before has just said it")
        environment = {k: v for k, v in os.environ.items() if k != "PYTHONMALLOC"}
        done = subprocess.run(
            [sys.executable, __file__, "References.test_no_object_is_lost_by_any_call"], env=environment, capture_output=True, text=True
        )
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])

    def test_what_was_given_is_given_back(self):
        points, weights = [tuple(p) for p in POINTS], [1.0] * 40
        constraint = {"at": 0.5, "value": [1.0, 2.0]}
        held = [points, points[0], weights, constraint, constraint["value"]]
        before = [sys.getrefcount(item) for item in held]
        model = pia.fit_curve(points, control=10, weights=weights, constraints=[constraint])
        with pia.Fit(points, control=10, weights=weights, constraints=[constraint]) as fit:
            fit.run()
        for _ in range(3):
            self.assertRaises(pia.Error, pia.fit_curve, points, control=10, degree=99, weights=weights)
        self.assertEqual([sys.getrefcount(item) for item in held], before)
        self.assertEqual(sys.getrefcount(model), 2)


class Growth(Case):
    def test_memory_stays_flat_over_many_fits(self):
        """Resident memory in the second half of many fits; the sanitizer's quarantine makes it grow, so it runs without."""
        program = (
            "import resource, pia\n"
            "from common import wave\n"
            "points = wave(30)\n"
            "def peak(): return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
            "def run(count):\n"
            "    for i in range(count):\n"
            "        pia.fit_curve(points, control=8, method='lspia', max_iterations=2, progress=lambda r: False)(0.5)\n"
            "run(500); first = peak(); run(1500); print(peak() - first)\n"
        )
        if "libasan" in os.environ.get("LD_PRELOAD", ""):
            program = program.replace("run(500)", "run(3)").replace("run(1500)", "run(3)")
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=os.path.dirname(os.path.abspath(__file__)))
        self.assertEqual(done.returncode, 0, done.stderr)
        if "libasan" not in os.environ.get("LD_PRELOAD", ""):
            self.assertLess(int(done.stdout), 512)  # KiB


@needs("_testcapi")
class FailingAllocations(Case):
    def fails(self, call):
        """Fails every allocation of Python from the k-th on, for each k, until the call succeeds."""
        import _testcapi

        # Where the memory of a bytearray fails, Python 3.11 prints that it "has exported buffers": their count is not set yet.
        for start in range(1, 2000):
            _testcapi.set_nomemory(start, start + 1)
            try:
                call()
                return start
            except MemoryError:
                pass
            finally:
                _testcapi.remove_mem_hooks()
        self.fail("2000 allocations are too many for this call")

    def test_t_peer_10_each_failing_allocation_is_a_memory_error_and_no_crash(self):
        from pia import _pia

        model = pia.fit_curve(POINTS, control=10)
        points, value = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.5], [3.0, 1.0]], [[0.5, 0.5]]
        constraints = [{"at": 0.5, "value": (0.5, 0.5)}]
        options = {"degree": 2, "knots": [0, 0, 0, 0.5, 1, 1, 1], "constraints": constraints, "method_options": {}}
        calls = [
            lambda: _pia.fit(pia.Model, dict, 0, points, None, None, None, options, -1, None),
            lambda: _pia.Fit(dict, 0, points, None, None, None, options, -1, None),
            lambda: model._eval([0.1, 0.2, 0.3], 1),
            lambda: model._closest(points),
            lambda: model._deviation(points, None),
            lambda: model._split(0, 0.5),
            lambda: model._control(),
            lambda: model._report(),
            lambda: _pia.Model((2,), ([0, 0, 0, 1, 1, 1],), [[0, 0], [1, 1], [2, 0]], None),
            lambda: _pia.options(),
        ]
        for call in calls:
            call()
            self.assertGreater(self.fails(call), 1)

    def test_t_peer_10_the_library_out_of_memory_is_a_memory_error(self):
        if "libasan" in os.environ.get("LD_PRELOAD", ""):
            self.skipTest("the sanitizer needs all addresses")
        program = (
            "import resource, pia\n"
            "points = [[i, i % 7] for i in range(100000)]\n"
            "pia.fit_curve(points[:50])\n"
            "used = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize()\n"
            "resource.setrlimit(resource.RLIMIT_AS, (used + 3_000_000,) * 2)\n"
            "try: pia.fit_curve(points)\n"
            "except MemoryError: print('refused')\n"
        )
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, "refused\n"), done.stderr)


class Gaps(Case):
    def test_t_peer_47_a_gap_of_many_knots_is_bounded_and_reported(self):
        points = [[x / 100, x % 3 / 10] for x in range(40)] + [[x / 100, x % 3 / 10] for x in range(70, 100)]
        model = pia.fit_function(points, control=60, knots="uniform")
        self.assertGreater(model.report.unsupported_count, 4)
        for x in range(100):
            self.assertLess(abs(model(x / 100)[1]), 2)


if __name__ == "__main__":
    unittest.main()
