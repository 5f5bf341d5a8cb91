"""Arrays as the library gives them: NumPy arrays, without a copy, where NumPy is installed; nested lists otherwise."""


def numpy():
    """The module NumPy, or None. Loaded when first needed, so that `import pia` stays quick."""
    global _numpy
    if _numpy is _unknown:
        try:
            import numpy as _numpy
        except ImportError:
            _numpy = None
    return _numpy


_unknown = object()
_numpy = _unknown


def shaped(view, shape):
    """`view`, a flat memoryview of doubles, as an array of this shape; a tuple of no axes gives a float."""
    if shape == ():
        return view[0]
    np = numpy()
    if np is not None:
        return np.asarray(view).reshape(shape)
    values = view.tolist()
    for count in reversed(shape[1:]):
        values = [values[i : i + count] for i in range(0, len(values), count)] if count else []
    return values


def shape_of(values):
    """The shape of a number, an array, or nested sequences."""
    shape = getattr(values, "shape", None)
    if isinstance(shape, tuple):
        return shape
    shape = []
    while hasattr(values, "__len__") and not isinstance(values, (str, bytes)):
        shape.append(len(values))
        if not shape[-1]:
            break
        values = values[0]
    return tuple(shape)


def listed(values):
    """`values` itself, or a list of them where they can be walked but once."""
    return values if hasattr(values, "__len__") or hasattr(values, "__float__") else list(values)


def joined(columns):
    """Columns of one length side by side [count, columns]; a column of shape [count, k] counts as k. Copies."""
    np = numpy()
    if np is not None:
        return np.column_stack([np.asarray(column, dtype=float) for column in columns])
    rows = []
    for values in zip(*columns, strict=True):
        row = []
        for value in values:
            row.extend(value if hasattr(value, "__len__") else (value,))
        rows.append(row)
    return rows


def paired(u, v):
    """(parameter pairs, their shape) of u and v, which are broadcast against each other where NumPy is there."""
    np = numpy()
    if np is not None:
        u, v = np.broadcast_arrays(np.asarray(u, dtype=float), np.asarray(v, dtype=float))
        return np.stack([u, v], axis=-1), u.shape
    u, v = listed(u), listed(v)
    if hasattr(u, "__float__") and hasattr(v, "__float__"):
        return (u, v), ()
    if hasattr(u, "__float__"):
        u = [u] * len(v)
    if hasattr(v, "__float__"):
        v = [v] * len(u)
    return list(zip(u, v, strict=True)), (len(u),)
