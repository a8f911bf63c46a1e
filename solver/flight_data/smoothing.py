"""All courses of a window smoothed together, given the contacts as far as they are known."""

import numpy as np

from solver.arrays import Array
from solver.flight_data.alignment import Series, aligned, best
from solver.flight_data.contacts import NOSE_KINDS, ContactKind, ContactTime
from solver.flight_data.course import (
    ATTITUDE_ACTIVITY,
    SPEED_ACTIVITY,
    YAW_ACTIVITY,
    Course,
    smooth_course,
)
from solver.flight_data.datum import Datum
from solver.flight_data.geometry import Geometry, Wheel
from solver.flight_data.parameter import Parameter
from solver.flight_data.sufficiency import Shortcoming, UndeterminedError
from solver.flight_data.touchdown import Courses
from solver.flight_data.vertical import OVER_RUNWAY, smooth_vertical
from solver.flight_data.vertical_acceleration import VerticalSources
from solver.flight_data.vertical_course import Touch
from solver.flight_data.window import Window
from solver.gear.place import Place

#: How long before and after the first contact the motion is smoothed [s].
BEFORE, AFTER = 9.0, 7.0

#: After so long the aircraft rolls, unless it bounced meanwhile [s].
SETTLING = 3.0

#: Spectral density of the angular acceleration while the ground acts: half a rad/s2 over a fifth of
#: a second [rad2/s3].
SHOCK = 0.05

#: The same in pitch towards the end of a hop, for a nose wheel that has come down before: it turns
#: the aircraft by a rad/s2 and more over a third of a second [rad2/s3, s].
NOSE_SHOCK, NOSE_SPAN = 0.1, 0.5

#: The same of an aircraft that rolls on its wheels [rad2/s3].
ROLLING = 1e-3

#: In heading and drift the ground acts less [rad2/s3].
YAW_SHOCK = 0.01

#: How long the ground acts on the attitude after a contact [s].
SHOCK_SPAN = 1.5

#: Taken for the effect of a slope where no ground speed is recorded at the contact [m/s].
USUAL_SPEED = 60.0


def smooth_window(
    window: Window,
    normal: Series,
    geometry: Geometry,
    contacts: list[ContactTime],
    datum: Datum,
    *,
    is_tied: bool = True,
) -> Courses:
    """Smooth everything; ``is_tied`` puts the wheels to the ground at the contacts."""
    first, last = contacts[0].time, contacts[-1].time
    span = (
        max(first - BEFORE, float(normal.time[0])),
        min(last + AFTER, float(normal.time[-1])),
    )
    nodes = np.unique(np.concatenate([[span[0], span[1]], [c.time for c in contacts]]))
    shocks = [(c.time, c.time + SHOCK_SPAN, SHOCK) for c in contacts]
    yaw_shocks = [(start, end, YAW_SHOCK) for start, end, _ in shocks]
    struck = [
        (c.time - NOSE_SPAN, c.time, NOSE_SHOCK) for c in contacts if c.kind is ContactKind.BOUNCE
    ]
    ground = (first, ROLLING)
    pitch = _course(window, Parameter.PITCH, nodes, shocks + struck, ATTITUDE_ACTIVITY, ground)
    roll = _course(window, Parameter.ROLL, nodes, shocks, ATTITUDE_ACTIVITY, ground)
    if pitch is None or roll is None:
        raise UndeterminedError(_NO_ATTITUDE)
    heading = _course(window, Parameter.HEADING, nodes, yaw_shocks, YAW_ACTIVITY)
    drift = _course(window, Parameter.DRIFT, nodes, yaw_shocks, YAW_ACTIVITY)
    ground_speed = _course(window, Parameter.GROUND_SPEED, nodes, [], SPEED_ACTIVITY)
    speed = USUAL_SPEED if ground_speed is None else float(ground_speed.at(first))
    sources = VerticalSources(
        normal=normal,
        lateral=best(window, Parameter.LATERAL_ACCELERATION),
        longitudinal=best(window, Parameter.LONGITUDINAL_ACCELERATION),
        radio=aligned(window, Parameter.RADIO_ALTITUDE),
        inertial=aligned(window, Parameter.VERTICAL_SPEED),
        datum=datum,
    )
    touches = tuple(
        Touch(c.time, c.sd, tuple(wheel.gear for wheel in touching_wheels(c.kind, geometry)))
        for c in contacts
        # The wheels that come down second are timed by the height: it must not be tied to them.
        if is_tied and c.kind in (ContactKind.FIRST, ContactKind.NOSE_FIRST, ContactKind.BOUNCE)
    )
    rolling = last + SETTLING
    vertical = smooth_vertical(
        sources,
        pitch,
        roll,
        speed,
        geometry,
        touches,
        rolling if rolling < span[1] - 1.0 else None,
        first - OVER_RUNWAY,
        span,
    )
    return Courses(vertical, pitch, roll, heading, drift, ground_speed)


def _course(
    window: Window,
    parameter: Parameter,
    nodes: Array,
    opened: list[tuple[float, float, float]],
    activity: Array,
    ground: tuple[float, float] = (np.inf, 0.0),
) -> Course | None:
    series = aligned(window, parameter)
    usable = tuple(s for s in series if np.sum((s.time >= nodes[0]) & (s.time <= nodes[-1])) >= 2)
    if not usable:
        return None
    return smooth_course(usable, nodes, tuple(opened), activity, ground)


_NO_ATTITUDE = Shortcoming(
    "no_attitude",
    "pitch or roll is not recorded around the contact",
    "pitch and roll at 1 Hz or more from 9 s before to 7 s after the contact",
)


def touching_wheels(kind: ContactKind, geometry: Geometry) -> tuple[Wheel, ...]:
    """Wheels of which the lowest touches in a contact."""
    return geometry.of(Place.NOSE) if kind in NOSE_KINDS else geometry.mains
