"""What happens in Python while a fit runs: progress, Ctrl-C, other threads."""

import gc
import os
import signal
import threading
import time
import unittest

import pia
from common import Case, flat, wave

LONG = {"control": 200, "method": "lspia", "stop_change": 0, "stop_gradient": 0, "max_iterations": 10**9}


def interrupt_soon():
    """Ctrl-C after 0.2 s."""
    timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


class Progress(Case):
    def test_a_callback_sees_reports_and_stops_the_fit_with_its_model(self):
        seen = []

        def stop_at_five(report):
            seen.append((report.iterations, report.max_error))
            return report.iterations >= 5

        model = pia.fit_curve(wave(300), progress=stop_at_five, **LONG)
        self.assertEqual([k for k, _ in seen], [0, 1, 2, 3, 4, 5])
        self.assertEqual((model.report.stop, model.report.iterations), ("cancelled", 5))
        self.assertEqual(model.report.max_error, seen[-1][1])

    def test_an_exception_of_the_callback_comes_out_with_the_model(self):
        class Enough(Exception):
            pass

        def give_up(report):
            if report.iterations == 3:
                raise Enough("three are enough")

        with self.assertRaisesRegex(Enough, "three") as caught:
            pia.fit_curve(wave(300), progress=give_up, **LONG)
        self.assertEqual(caught.exception.model.report.iterations, 3)
        with pia.Fit(wave(300), progress=give_up, **LONG) as fit:
            self.assertRaises(Enough, fit.run)
            self.assertEqual(fit.report.iterations, 3)
            self.assertEqual(fit.model.report.iterations, 3)

    def test_a_fit_cannot_be_used_from_its_own_callback(self):
        failures = []

        def meddle(report):
            for call in (fit.step, fit.close, lambda: fit.model, lambda: fit.move_point(3, [0, 0])):
                try:
                    call()
                except RuntimeError as failure:
                    failures.append(str(failure))
            return True

        with pia.Fit(wave(300), progress=meddle, **LONG) as fit:
            fit.run()
        self.assertEqual(len(failures), 4)
        self.assertIn("at work", failures[0])

    def test_a_callback_that_holds_its_fit_is_collected(self):
        class Holder:
            pass

        holder = Holder()
        holder.fit = pia.Fit(wave(100), progress=lambda report: holder.fit is None, control=20)
        gone = []
        import weakref

        weakref.finalize(holder, gone.append, True)
        del holder
        gc.collect()
        self.assertEqual(gone, [True])


class Interrupts(Case):
    def test_ctrl_c_stops_a_fit_and_leaves_the_best_model(self):
        timer, began = interrupt_soon(), time.monotonic()
        with self.assertRaises(KeyboardInterrupt) as caught:
            pia.fit_curve(wave(3000), **LONG)
        timer.join()
        self.assertLess(time.monotonic() - began, 20)
        self.assertEqual(caught.exception.model.report.stop, "cancelled")
        self.assertGreater(caught.exception.model.report.iterations, 0)

    def test_ctrl_c_while_stepping_leaves_the_fit_usable(self):
        with pia.Fit(wave(3000), **LONG) as fit:
            timer = interrupt_soon()
            self.assertRaises(KeyboardInterrupt, fit.run)
            timer.join()
            done = fit.report.iterations
            self.assertEqual(fit.step(2).iterations, done + 2)

    def test_ctrl_c_stops_the_search_for_knots(self):
        points = wave(200000)
        for i in range(0, len(points), 3):
            points[i][1] += 1e-3 * ((i * 7919) % 1000 - 500) / 500
        timer = interrupt_soon()
        with self.assertRaises(KeyboardInterrupt):
            while True:
                pia.fit_curve(points, tolerance=2e-4)
        timer.join()

    def test_a_handler_that_does_not_raise_lets_the_fit_go_on(self):
        seen = []
        before = signal.signal(signal.SIGUSR1, lambda *_: seen.append(time.monotonic()))
        try:
            timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGUSR1))
            timer.start()
            model = pia.fit_curve(wave(3000), **{**LONG, "time_limit": 0.6})
            timer.join()
        finally:
            signal.signal(signal.SIGUSR1, before)
        self.assertEqual(model.report.stop, "time")
        self.assertEqual(len(seen), 1)


class Threads(Case):
    def test_python_goes_on_while_a_fit_runs(self):
        """The fit ends only when another thread has worked, which it cannot while the lock is held."""
        flag = []
        worker = threading.Timer(0.05, flag.append, (True,))
        worker.start()
        model = pia.fit_curve(wave(500), progress=lambda report: bool(flag), **LONG)
        worker.join()
        self.assertEqual(model.report.stop, "cancelled")

    def test_fits_and_values_in_many_threads_are_those_of_one(self):
        expected = pia.fit_curve(wave(500), control=40, method="lspia", max_iterations=30)
        t = [i / 200 for i in range(201)]
        values = expected(t)
        wrong = []

        def work():
            for _ in range(10):
                model = pia.fit_curve(wave(500), control=40, method="lspia", max_iterations=30)
                if flat(model.control) != flat(expected.control) or flat(expected(t)) != flat(values):
                    wrong.append(model)

        threads = [threading.Thread(target=work) for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_one_fit_in_two_threads_is_refused_not_broken(self):
        refused = []
        with pia.Fit(wave(3000), **{**LONG, "time_limit": 0.5}) as fit:
            thread = threading.Thread(target=fit.run)
            thread.start()
            while thread.is_alive():
                try:
                    fit.step()
                except RuntimeError as failure:
                    refused.append(str(failure))
                time.sleep(0.02)
            thread.join()
        self.assertIn("at work", refused[0])

    def test_a_fit_in_another_thread_ignores_ctrl_c_of_the_main_one(self):
        result = []
        thread = threading.Thread(target=lambda: result.append(pia.fit_curve(wave(3000), **{**LONG, "time_limit": 0.5})))
        thread.start()
        timer = interrupt_soon()
        with self.assertRaises(KeyboardInterrupt):
            time.sleep(10)
        timer.join()
        thread.join()
        self.assertEqual(result[0].report.stop, "time")


if __name__ == "__main__":
    unittest.main()
