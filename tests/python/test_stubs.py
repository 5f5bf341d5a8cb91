"""The type stubs name what the package has, option by option and member by member."""

import ast
import inspect
import os
import unittest

import pia
from pia._options import keywords

STUB = os.path.join(os.environ["PIA_SOURCE"], "python", "pia", "__init__.pyi")


def members(body):
    names = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
    return names


class Stubs(unittest.TestCase):
    def setUp(self):
        with open(STUB) as file:
            self.tree = ast.parse(file.read())
        self.classes = {node.name: node for node in self.tree.body if isinstance(node, ast.ClassDef)}

    def test_every_public_name_is_there(self):
        stubbed = {name for name in members(self.tree.body) if not name.startswith("__")}
        helpers = {"Array", "ArrayLike", "Path", "Pair", "Kind", "Constraint", "Join", "Edge", "FitOptions"}
        self.assertEqual(stubbed - helpers, set(pia.__all__))

    def test_options_are_those_of_the_library(self):
        self.assertEqual(members(self.classes["FitOptions"].body), set(keywords()))
        for function in (pia.fit_curve, pia.fit_grid, pia.fit_surface, pia.fit_function):
            self.assertLessEqual(set(keywords()), set(inspect.signature(function).parameters))

    def test_classes_have_their_members(self):
        for name in ("Model", "Fit"):
            own = {key for key in vars(getattr(pia, name)) if not key.startswith("_")}
            stubbed = {key for key in members(self.classes[name].body) if not key.startswith("_")}
            self.assertEqual(stubbed, own, name)
        report = pia.fit_curve([[0, 0], [1, 1], [2, 0], [3, 1]]).report
        self.assertEqual(members(self.classes["Report"].body), set(vars(report)))
        for name in vars(report):
            self.assertIn(name, pia.Report.__doc__)
        for name in ("Deviation", "TraceRow", "Option", "Entry", "Setting"):
            self.assertEqual(members(self.classes[name].body), set(getattr(pia, name)._fields), name)

    def test_signatures_agree(self):
        functions = {node.name: node for node in self.tree.body if isinstance(node, ast.FunctionDef)}
        for name, node in functions.items():
            stubbed = {a.arg for a in node.args.args + node.args.kwonlyargs}
            real = set(inspect.signature(inspect.unwrap(getattr(pia, name))).parameters)
            self.assertEqual(stubbed, real - (set(keywords()) if name.startswith("fit_") else set()), name)

    def test_everything_public_is_documented(self):
        for name in pia.__all__:
            self.assertTrue(getattr(pia, name).__doc__, name)
        for owner in (pia.Model, pia.Fit):
            for name, member in vars(owner).items():
                if not name.startswith("_"):
                    self.assertTrue(member.__doc__, f"{owner.__name__}.{name}")


if __name__ == "__main__":
    unittest.main()
