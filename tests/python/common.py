"""Points and comparisons that several tests use."""

import math
import os
import unittest

DATA = os.environ["PIA_DATA"]


def wave(count, dim=2):
    """A wave without noise, as lists [count][dim]."""
    return [[math.sin(0.06 * i * d) + d * i / count if d else i / count for d in range(dim)] for i in range(count)]


def flat(values):
    """All numbers of an array, a memoryview, or nested lists."""
    if hasattr(values, "tolist"):
        values = values.tolist()
    if isinstance(values, (list, tuple)):
        return [number for item in values for number in flat(item)]
    return [values]


class Case(unittest.TestCase):
    def near(self, a, b, bound):
        a, b = flat(a), flat(b)
        self.assertEqual(len(a), len(b))
        for x, y in zip(a, b):
            self.assertLessEqual(abs(x - y), bound)

    def same(self, a, b):
        self.assertEqual(flat(a), flat(b))


def needs(module):
    """Skips a test case where the module is missing."""
    try:
        __import__(module)
    except ImportError:
        return unittest.skip(f"{module} is not installed")
    return lambda case: case
