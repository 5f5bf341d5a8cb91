"""Files of models, points, pictures."""

from . import _pia
from ._arrays import numpy
from ._model import Model


def load(path, format=None):
    """The model of a file. format: a name of pia.registry('format'), None: by extension. A file of several models is refused; see
    load_all."""
    models = load_all(path, format)
    if len(models) != 1:
        raise ValueError(f"{path}: holds {len(models)} models; pia.load_all reads them all")
    return models[0]


def load_all(path, format=None):
    """All models of a file, a list."""
    return _pia.load(Model, path, format)


_units = {"mm": 0, "m": 1, "inch": 2}
_schemas = {"ap214": 0, "ap242": 1}


def _chosen(what, word, words):
    if word not in words:
        raise ValueError(f"{what}: {word!r} is unknown; {', '.join(words)}")
    return words[word]


def save(path, models, format=None, samples=None, *, unit="mm", schema="ap214", tolerance=None, name=None):
    """Writes models into one file, whole or not at all.

    models     a Model or several
    format     a name of pia.registry('format'); None: by extension
    samples    points a direction, in formats that hold samples (csv, npy, obj); None: enough for a picture
    unit       of STEP and IGES: 'mm', 'm' or 'inch'
    schema     of STEP: 'ap214' or 'ap242'
    tolerance  of STEP and IGES: distance below which points are the same, in that unit; None: 1e-7
    name       of the part in STEP and IGES; None: that of the file
    """
    models = (models,) if isinstance(models, Model) else tuple(models)
    unit, schema = _chosen("unit", unit, _units), _chosen("schema", schema, _schemas)
    _pia.save(path, models, format, -1 if samples is None else samples, unit, schema, -1.0 if tolerance is None else tolerance, name)


def read_parts(path, *, format=None, columns=None, skip_invalid=False, grid=False, allow_nan=False):
    """Points of a file, a list with one array [count, dim] for each part that blank lines separate; grids [rows, columns, dim] are one
    part. See read_points."""
    points = _pia.read_points(path, format, columns, skip_invalid, grid, allow_nan)
    first, values = points._parts(), _seen(points)
    return [values[a:b] for a, b in zip(first, first[1:])] if len(first) > 2 else [values]


def _seen(points):
    """The points of a file as an array that keeps them alive."""
    np = numpy()
    return np.asarray(points) if np is not None else memoryview(points).tolist()


def read_points(path, *, format=None, columns=None, part=None, skip_invalid=False, grid=False, allow_nan=False):
    """Points of a file: an array [count, dim], of a grid [rows, columns, dim], read-only, without a copy.

    format        a name of pia.registry('format'); None: by extension
    columns       'x,y,z' names or '1,2' numbers from 1; None: all numeric columns
    part          the only part wanted of a file with several; None: a file of several is one array
    skip_invalid  bad rows are dropped instead of refused
    grid          a text or NPY matrix is a grid of heights
    allow_nan     nan is kept, for the holes of a grid
    """
    if part is not None:
        return read_parts(path, format=format, columns=columns, skip_invalid=skip_invalid, grid=grid, allow_nan=allow_nan)[part]
    return _seen(_pia.read_points(path, format, columns, skip_invalid, grid, allow_nan))


def plot(path, models, points=None, *, title=None, width=0, height=0, control=True, knots=True, comb=False, azimuth=None, elevation=None):
    """Draws models, and the points they stand for coloured by deviation, into an svg, png or pdf file, or as an interactive page into
    an html file, whole or not at all.

    models            a Model or several
    points            [count, dim] or a grid, None: none
    width, height     points of 1/72 inch, pixels for png; 0: chosen from the shape
    control, knots    control polygon or net, knot marks
    comb              curvature comb
    azimuth, elevation  viewing direction of surfaces and space curves, degrees
    """
    models = (models,) if isinstance(models, Model) else tuple(models)
    if not models:
        raise ValueError("there is no model to draw")
    _pia.plot(path, models, points, title, width, height, control, knots, comb, azimuth, elevation)
