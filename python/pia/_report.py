"""What a fit tells of itself."""

from typing import NamedTuple


class Report:
    """State of a fit, or how a model came to be.

    Attributes (one value for a curve, pairs for a surface where two are natural):

    kind                'curve', 'grid' or 'surface' (scattered points)
    method, parametrization, placement, limiter
                        what was used, also where the library chose
    degree, control     degrees; control points a direction
    control_count, point_count, iterations, round_count
    stop                why it ended: 'tolerance', 'change', 'gradient', 'iterations', 'time', 'cancelled', 'stalled', 'finite',
                        'no-knot-left', 'infeasible'; 'none' while it runs
    reached             True or False; None when no tolerance was asked
    max_error           largest deviation, units of the points
    max_error_index     the row of the points where it is
    rms_error           root of the mean square of the deviations, units of the points
    axis_error          largest deviation of each component, where there are axis tolerances; else None
    worst_axis          the component that takes most of its axis tolerance
    between_error       how far a curve fitted to a tolerance is from the straight line between neighbouring points that are far apart;
                        None where it was not measured
    start_error         max_error of the initial model
    measure             'parametric': at the parameters used; 'distance': to the closest point
    constraint_error    largest violation of a constraint; None without constraints
    relative_gradient   of least squares; None where the method has none
    rate                factor of the error from one iteration to the next; None if unknown
    repaired_count      rows dropped or merged
    unsupported_count   control points that no data holds
    outlier_count       rows the robust loss gave less than half weight
    seconds             time spent in the fit
    warnings            choices, repairs and warnings of the library, one line each; none in reports of progress
    """

    def __init__(self, members, warnings=()):
        self.__dict__.update(members)
        self.warnings = list(warnings)

    def __repr__(self):
        reached = {True: ", tolerance reached", False: ", tolerance not reached", None: ""}[self.reached]
        return (
            f"<pia.Report {self.method}: max error {self.max_error:.6g} at row {self.max_error_index}, rms {self.rms_error:.6g}, "
            f"{self.control_count} control points for {self.point_count} points, {self.iterations} iterations, "
            f"stop {self.stop}{reached}>"
        )


class Deviation(NamedTuple):
    """How far points are from a model, in the units of the points."""

    point_count: int
    max_error: float
    rms_error: float
    max_error_index: int
    percentile: tuple  #: 50, 90 and 99 % of the points deviate at most this much
    foot_points: bool  #: True: distances to the closest point; False: at given parameters
    distances: object  #: [count]


class TraceRow(NamedTuple):
    """One row of the history of a fit: the model after `iteration` updates."""

    iteration: int
    control_count: int
    max_error: float
    rms_error: float
    adjust_max: float  #: the farthest that a control point moved
    constraint_error: float  #: nan without constraints
    seconds: float


def all_of(item_at):
    """All values of the function item_at(index), which gives None past the end."""
    found = []
    while (item := item_at(len(found))) is not None:
        found.append(item)
    return found
