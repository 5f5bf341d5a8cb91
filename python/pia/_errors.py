"""Failures of the library as exceptions: each is an `Error` and the built-in exception that it resembles."""


class Error(Exception):
    """Base of all exceptions that pia raises itself. The message says what is wrong, where, and what to do."""


class ArgumentError(Error, ValueError):
    """An argument is out of its range, names something unknown, or does not go with another."""


class ShapeError(Error, ValueError):
    """Counts or dimensions do not fit together."""


class DataError(Error, ValueError):
    """The points cannot be fitted: not finite, too few, all equal, ..."""


class ConstraintError(Error, ValueError):
    """Constraints contradict each other or are more than the model can hold."""


class OutOfMemory(Error, MemoryError):
    """Memory that a fit needs could not be had."""


class SizeError(Error, OverflowError):
    """A product of sizes does not fit in 64 bits."""


class UnavailableError(Error, RuntimeError):
    """This build or this machine lacks the part that was asked for."""


class FormatError(Error, ValueError):
    """A file does not hold what its format promises."""


class FileError(Error, OSError):
    """The operating system refused a file."""


class InternalError(Error, RuntimeError):
    """A defect of the library."""
