"""Keyword arguments of fits. Names, ranges and sentences come from the library's own list; a few get a Python form here."""

import difflib
import inspect
import textwrap
from typing import NamedTuple

from . import _pia


class Option(NamedTuple):
    """An option of a fit, as the library lists it."""

    name: str
    type: str  #: 'switch', 'integer', 'count', 'number', 'name', 'dict', 'indices', 'numbers', 'constraints', 'model', 'joins'
    directions: int  #: 2: a pair (u, v) for surfaces, or one value for both
    automatic: bool  #: True: may be left to the library
    minimum: float
    maximum: float
    initial: float  #: default of a number; -1 where automatic
    values: str  #: the registry or the words that a name comes from
    sentence: str


class Entry(NamedTuple):
    """An entry of a registry."""

    name: str
    title: str
    reference: str  #: key of the bibliography, or None
    detail: str  #: what it needs or can do, or None


class Setting(NamedTuple):
    """A parameter of a method or limiter, for method_options and limiter_options."""

    name: str
    values: str  #: words separated by '|', or None for a plain number
    initial: str
    minimum: float
    maximum: float
    sentence: str


def options():
    """The options of a fit: list of `Option`."""
    return [Option(*row)._replace(automatic=bool(row[3])) for row in _pia.options()]


def registry(name):
    """What there is: list of `Entry` of 'method', 'parametrization', 'placement', 'limiter', 'format', 'backend' or 'part'."""
    entries = [Entry(*row) for row in _pia.entries(name)]
    if not entries:
        raise ValueError(f"there is no registry {name!r}; method, parametrization, placement, limiter, format, backend, part")
    return entries


def settings(name):
    """Parameters of a method or limiter: list of `Setting`, empty where it has none."""
    return [Setting(*row) for row in _pia.settings(name)]


_names = frozenset(option.name for option in options())

#: Options that go by another name, or by more than one form, in Python.
_renamed = {"measure_distance": "measure", "parametrization": "parameters", "placement": "knots"}

_data = {
    "parameters": "parameters of the points: a name, or an array (curve [count]; grid ([rows], [columns]); scattered [count, 2])",
    "knots": "a placement by name, or full knot vectors of control + degree + 1 values",
    "weights": "[count] one a point, >= 0",
    "tolerances": "[count] a tolerance for each point, units of the points",
    "measure": "'parametric' or 'distance': what tolerance and report measure",
    "threads": "most threads; left out: as many as pay. Results do not depend on it, bit for bit",
    "progress": "called with a Report at least once an iteration or round; a true answer stops the fit and keeps the model",
}


def keywords():
    """Names of all keyword arguments of a fit, with their sentences."""
    listed = {option.name: option.sentence for option in options() if option.name not in _renamed}
    return {**listed, **_data}


def _rows(rows, count, name):
    """Rows as counts from 0: negative ones count from the end, 'ends' are the first and the last."""
    if isinstance(rows, str):
        if rows == "ends":
            return [0, count - 1]
        if rows == "auto" and name == "corners":
            return rows
        raise ValueError(f"{name}: {rows!r} is unknown; give rows" + (" or 'auto'" if name == "corners" else " or 'ends'"))
    return [row + count if row < 0 else row for row in map(_index, rows)]


def _index(row):
    try:
        return row.__index__()
    except AttributeError:
        raise TypeError(f"{row!r} is no row; rows are whole numbers") from None


class Arguments:
    """The keyword arguments of a fit, as _pia takes them."""

    def __init__(self, keywords_given, count, grid=False):
        given = {name: value for name, value in keywords_given.items() if value is not None}
        self.threads = given.pop("threads", -1)
        self.progress = given.pop("progress", None)
        self.weights = given.pop("weights", None)
        self.tolerances = given.pop("tolerances", None)
        self.parameters = given.pop("parameters", None)
        if isinstance(self.parameters, str):
            given["parametrization"], self.parameters = self.parameters, None
        elif self.parameters is not None and grid:
            u, v = self.parameters
            self.parameters = [*u, *v]
        if isinstance(given.get("knots"), str):
            given["placement"] = given.pop("knots")
        if "measure" in given:
            given["measure_distance"] = _measure(given.pop("measure"))
        for name in ("interpolate", "corners"):
            if name in given:
                given[name] = _rows(given[name], count, name)
        unknown = given.keys() - _names
        if unknown:
            raise TypeError(_unknown(sorted(unknown)[0]))
        self.options = given

    def listed(self):
        return self.parameters, self.weights, self.tolerances, self.options, self.threads, self.progress


def _measure(word):
    if word not in ("parametric", "distance"):
        raise ValueError(f"measure: {word!r} is unknown; 'parametric' or 'distance'")
    return word == "distance"


def _unknown(name):
    near = difflib.get_close_matches(name, keywords(), 1)
    return f"a fit has no option {name!r}" + (f"; did you mean {near[0]!r}?" if near else "; pia.options() lists them")


def documented(function):
    """Appends the options to the docstring, and shows them in the signature."""
    lines = []
    for name, sentence in keywords().items():
        lines += textwrap.wrap(f"{name:<18}{sentence}", 110, subsequent_indent=" " * 18)
    text = inspect.cleandoc(function.__doc__).replace("OPTIONS", "\n".join(lines))
    function.__doc__ = text
    signature = inspect.signature(function)
    own = [p for p in signature.parameters.values() if p.kind is not inspect.Parameter.VAR_KEYWORD]
    more = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None) for name in keywords() if name not in signature.parameters]
    function.__signature__ = signature.replace(parameters=own + more)
    return function
