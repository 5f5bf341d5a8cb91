"""Types of the package. Arrays are numpy.ndarray where NumPy is installed, else nested lists; what is taken is any array of numbers."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, NamedTuple, Self, TypeAlias, TypedDict, Unpack

Array: TypeAlias = Any
ArrayLike: TypeAlias = Any
Path: TypeAlias = str | bytes | PathLike[str] | PathLike[bytes]
Pair: TypeAlias = tuple[int, int]
Kind: TypeAlias = Literal["curve", "grid", "surface", "function"]

__version__: str
__all__: list[str]

class Constraint(TypedDict, total=False):
    at: int | float | tuple[float, float]
    derivative: int | Pair
    value: ArrayLike
    direction: bool

Edge: TypeAlias = Literal["start", "end", "u0", "u1", "v0", "v1"]

class Join(TypedDict, total=False):
    join: Model
    end: Edge
    to: Edge
    continuity: Literal["C0", "G1", "C1"]
    reversed: bool

class FitOptions(TypedDict, total=False):
    degree: int | Pair | None
    closed: bool | tuple[bool, bool] | None
    control: int | Pair | None
    tolerance: float | None
    method: str | None
    method_options: Mapping[str, object] | None
    limiter: str | None
    limiter_options: Mapping[str, object] | None
    start: Model | None
    interpolate: Iterable[int] | Literal["ends"] | None
    constraints: Sequence[Constraint] | None
    joins: Sequence[Join] | None
    soft: float | None
    freeze: Iterable[int] | None
    fairing: float | None
    robust: Literal["huber", "tukey"] | None
    robust_scale: float | None
    between: float | None
    correct: int | None
    corners: Iterable[int] | Literal["auto"] | None
    max_iterations: int | None
    stop_change: float | None
    stop_gradient: float | None
    time_limit: float | None
    trace_every: int | None
    parameters: str | ArrayLike | None
    knots: str | ArrayLike | None
    weights: ArrayLike | None
    tolerances: ArrayLike | None
    axis_tolerances: ArrayLike | None
    measure: Literal["parametric", "distance"] | None
    threads: int | None
    progress: Callable[[Report], object] | None

def fit_curve(points: ArrayLike, **options: Unpack[FitOptions]) -> Model: ...
def fit_function(x: ArrayLike, y: ArrayLike | None = None, **options: Unpack[FitOptions]) -> Model: ...
def fit_grid(points: ArrayLike, *, x: ArrayLike | None = None, y: ArrayLike | None = None, **options: Unpack[FitOptions]) -> Model: ...
def fit_surface(points: ArrayLike, **options: Unpack[FitOptions]) -> Model: ...
def suggest_tolerance(points: ArrayLike, kind: Kind = "curve") -> tuple[float, float]: ...

class Model:
    def __new__(cls, degree: int | Pair, knots: ArrayLike, control: ArrayLike, weights: ArrayLike | None = None) -> Self: ...
    @property
    def directions(self) -> Literal[1, 2]: ...
    @property
    def dim(self) -> int: ...
    @property
    def rational(self) -> bool: ...
    @property
    def degree(self) -> int | Pair: ...
    @property
    def control_count(self) -> int | Pair: ...
    @property
    def closed(self) -> bool | tuple[bool, bool]: ...
    @property
    def domain(self) -> tuple[float, float] | tuple[tuple[float, float], tuple[float, float]]: ...
    @property
    def knots(self) -> Array | tuple[Array, Array]: ...
    @property
    def control(self) -> Array: ...
    @property
    def weights(self) -> Array: ...
    @property
    def report(self) -> Report | None: ...
    @property
    def parameters(self) -> Array | None: ...
    def __call__(self, *parameters: ArrayLike) -> Array: ...
    def derivative(self, *parameters: ArrayLike, order: int | Pair = 1) -> Array: ...
    def curvature(self, *parameters: ArrayLike) -> Array: ...
    def closest(self, points: ArrayLike) -> tuple[Array, Array]: ...
    def deviation(self, points: ArrayLike, parameters: ArrayLike | None = None) -> Deviation: ...
    def length(self) -> float: ...
    def bounds(self) -> tuple[Array, Array]: ...
    def insert_knots(self, values: ArrayLike, direction: int = 0) -> Self: ...
    def remove_knots(self, bound: float) -> tuple[Self, float]: ...
    def elevate(self, by: int = 1, direction: int = 0) -> Self: ...
    def split(self, value: float, direction: int = 0) -> tuple[Self, Self]: ...
    def bezier(self) -> Self: ...
    def trim(self, loops: Iterable[ArrayLike]) -> Self: ...
    @property
    def trim_loops(self) -> list[Array]: ...
    def contains(self, u: float, v: float) -> bool: ...
    def save(
        self,
        path: Path,
        format: str | None = None,
        samples: int | None = None,
        *,
        unit: Literal["mm", "m", "inch"] = "mm",
        schema: Literal["ap214", "ap242"] = "ap214",
        tolerance: float | None = None,
        name: str | None = None,
    ) -> None: ...
    def plot(
        self,
        path: Path,
        points: ArrayLike | None = None,
        *,
        title: str | None = None,
        width: float = 0,
        height: float = 0,
        control: bool = True,
        knots: bool = True,
        comb: bool = False,
        azimuth: float | None = None,
        elevation: float | None = None,
    ) -> None: ...
    def to_scipy(self) -> Any: ...
    @classmethod
    def from_scipy(cls, spline: Any) -> Self: ...
    def to_dict(self) -> dict[str, Any]: ...
    @classmethod
    def from_dict(cls, shape: Mapping[str, Any]) -> Self: ...

class Fit:
    def __new__(cls, points: ArrayLike, kind: Kind | None = None, **options: Unpack[FitOptions]) -> Self: ...
    @classmethod
    def resume(cls, path: Path, *, threads: int | None = None, progress: Callable[[Report], object] | None = None) -> Self: ...
    def step(self, iterations: int = 1) -> Report: ...
    def run(self) -> Report: ...
    @property
    def report(self) -> Report: ...
    @property
    def model(self) -> Model: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def trace(self) -> list[TraceRow]: ...
    @property
    def parameters(self) -> Array: ...
    @property
    def rows(self) -> list[int] | None: ...
    @property
    def residuals(self) -> Array: ...
    @property
    def robust_weights(self) -> Array | None: ...
    @property
    def unsupported(self) -> list[int]: ...
    @property
    def corners(self) -> list[int]: ...
    def set(self, name: str, value: object) -> None: ...
    def move_point(self, row: int, point: ArrayLike) -> None: ...
    def weigh_point(self, row: int, weight: float) -> None: ...
    def add_points(self, points: ArrayLike, parameters: ArrayLike, weights: ArrayLike | None = None) -> None: ...
    def add_point(self, point: ArrayLike, parameter: ArrayLike, weight: float = 1.0) -> None: ...
    def freeze(self, control: Iterable[int]) -> None: ...
    def free(self, control: Iterable[int]) -> None: ...
    def constrain(self, constraints: Sequence[Constraint]) -> range: ...
    def join(self, joins: Sequence[Join]) -> range: ...
    def release(self, id: int) -> None: ...
    def insert_knot(self, knot: float, direction: int = 0) -> None: ...
    def save(self, path: Path) -> None: ...
    def close(self) -> None: ...
    def __enter__(self) -> Self: ...
    def __exit__(self, *failure: object) -> None: ...

class Report:
    kind: Literal["curve", "grid", "surface"]
    method: str
    parametrization: str
    placement: str
    limiter: str
    degree: int | Pair
    control: int | Pair
    control_count: int
    point_count: int
    iterations: int
    round_count: int
    stop: str
    reached: bool | None
    max_error: float
    max_error_index: int
    rms_error: float
    axis_error: tuple[float, ...] | None
    worst_axis: int | None
    between_error: float | None
    start_error: float
    measure: Literal["parametric", "distance"]
    constraint_error: float | None
    relative_gradient: float | None
    rate: float | None
    repaired_count: int
    unsupported_count: int
    outlier_count: int
    seconds: float
    warnings: list[str]

class Deviation(NamedTuple):
    point_count: int
    max_error: float
    rms_error: float
    max_error_index: int
    percentile: tuple[float, float, float]
    foot_points: bool
    distances: Array

class TraceRow(NamedTuple):
    iteration: int
    control_count: int
    max_error: float
    rms_error: float
    adjust_max: float
    constraint_error: float
    seconds: float

class Option(NamedTuple):
    name: str
    type: str
    directions: int
    automatic: bool
    minimum: float
    maximum: float
    initial: float
    values: str | None
    sentence: str

class Entry(NamedTuple):
    name: str
    title: str
    reference: str | None
    detail: str | None

class Setting(NamedTuple):
    name: str
    values: str | None
    initial: str
    minimum: float
    maximum: float
    sentence: str

def options() -> list[Option]: ...
def registry(name: str) -> list[Entry]: ...
def settings(name: str) -> list[Setting]: ...
def load(path: Path, format: str | None = None) -> Model: ...
def load_all(path: Path, format: str | None = None) -> list[Model]: ...
def save(
    path: Path,
    models: Model | Iterable[Model],
    format: str | None = None,
    samples: int | None = None,
    *,
    unit: Literal["mm", "m", "inch"] = "mm",
    schema: Literal["ap214", "ap242"] = "ap214",
    tolerance: float | None = None,
    name: str | None = None,
) -> None: ...
def read_points(
    path: Path,
    *,
    format: str | None = None,
    columns: str | None = None,
    part: int | None = None,
    skip_invalid: bool = False,
    grid: bool = False,
    allow_nan: bool = False,
) -> Array: ...
def read_parts(
    path: Path,
    *,
    format: str | None = None,
    columns: str | None = None,
    skip_invalid: bool = False,
    grid: bool = False,
    allow_nan: bool = False,
) -> list[Array]: ...
def plot(
    path: Path,
    models: Model | Iterable[Model],
    points: ArrayLike | None = None,
    *,
    title: str | None = None,
    width: float = 0,
    height: float = 0,
    control: bool = True,
    knots: bool = True,
    comb: bool = False,
    azimuth: float | None = None,
    elevation: float | None = None,
) -> None: ...

class Error(Exception): ...
class ArgumentError(Error, ValueError): ...
class ShapeError(Error, ValueError): ...
class DataError(Error, ValueError): ...
class ConstraintError(Error, ValueError): ...
class OutOfMemory(Error, MemoryError): ...
class SizeError(Error, OverflowError): ...
class UnavailableError(Error, RuntimeError): ...
class FormatError(Error, ValueError): ...
class FileError(Error, OSError): ...
class InternalError(Error, RuntimeError): ...
