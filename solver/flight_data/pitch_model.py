"""Pitch from the first contact until the nose wheel is down, as a Gaussian process.

On the main wheels the pitch follows the load on them, which the normal acceleration shows; how much
each part turns the aircraft is only roughly known, and is averaged over.  Angles are small enough
for their sum: what each part makes of the pitch is its acceleration integrated twice.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flight_data.alignment import Series
from solver.flight_data.contacts import ContactKind, ContactTime
from solver.flight_data.geometry import Geometry
from solver.flight_data.touchdown import Courses
from solver.flight_data.wheels import lowest_course
from solver.gear.place import Place
from solver.landing.records import GRAVITY

#: Radius of gyration in pitch per wheel base; an assumption, of the usual size for jets.
_GYRATION = 0.46

#: Pitch acceleration per g that the mains' load shows, over that of their vertical force alone at
#: its lever arm (rolling and spin-up drag act the same way), and its spread.
_OF_MAINS, _OF_MAINS_SPREAD = 1.8, 0.35

#: A hop shows the lift from so long after the first contact until so long before the next [s].
_COMPRESSED, _ONSET = 0.25, 0.03

#: Rate at which pitch motion is damped on the main wheels [1/s].
_DAMPING = (2.0, 0.7)

#: Acceleration of pitch that stays [rad/s2], jump of the pitch rate at a contact of the mains
#: [rad/s], and spectral densities of what else moves the pitch in the air and on the mains, and
#: when the nose strut works [rad2/s3].
_STEADY, _JUMP = 0.05, 0.02
_IN_AIR, _ON_MAINS, _ON_NOSE = 2e-3, 5e-4, 1.5e-2

#: Pitch acceleration by the nose strut times the wheel base: its preload comes at once [m/s2].
_BY_NOSE, _BY_NOSE_SPREAD = 5.5, 0.33

#: Spread of angle and rate of pitch before anything is known [rad, rad/s].
_ANGLE_SD, _RATE_SD = 1.0, 0.2

#: Step at which the recorded acceleration is integrated [s].
_STEP = 0.005


@dataclass(frozen=True, slots=True)
class PitchModel:
    """What the pitch is made of besides where and how fast it began."""

    start: float  #: [s]
    first: float  #: contact of the aircraft [s]
    mains: tuple[float, ...]  #: contacts of the main wheels [s]
    time: Array  #: (n,) from the first contact on [s]
    by_load: Array  #: (n,) pitch that one rad/s2 per g of the mains' load would have made [rad]
    by_damping: Array  #: (n,) pitch that a damping of one per second would have made [rad]
    load_lever: float  #: [rad/s2 per g]
    nose_acceleration: float  #: [rad/s2]

    def moments(self, time: Array, touch: Array) -> tuple[Array, Array]:
        """Mean (n, m) and covariance (n, m, m) of the pitch, by when the nose wheel touches.

        Parameters
        ----------
        time : (n, m) array
            Times at which the pitch is wanted, for each touch [s].
        touch : (n,) array
            Of the nose wheel [s].
        """
        passed, down, nose = time - self.start, time - self.first, time - touch[:, None]
        covariance = _ANGLE_SD**2 + _RATE_SD**2 * outer(passed) + _integrated(passed, _IN_AIR)
        covariance += _integrated(down, _ON_MAINS) + _integrated(nose, _ON_NOSE)
        covariance += _STEADY**2 * outer(np.maximum(down, 0.0) ** 2 / 2)
        for contact in self.mains:
            covariance += _JUMP**2 * outer(np.maximum(time - contact, 0.0))
        mean = np.zeros_like(time)
        for shape, usual, spread in (
            (
                np.interp(time, self.time, self.by_load, left=0.0),
                self.load_lever,
                abs(self.load_lever) * _OF_MAINS_SPREAD,
            ),
            (np.interp(time, self.time, self.by_damping, left=0.0), *_DAMPING),
            (
                np.maximum(nose, 0.0) ** 2 / 2,
                self.nose_acceleration,
                self.nose_acceleration * _BY_NOSE_SPREAD,
            ),
        ):
            mean += usual * shape
            covariance += spread**2 * outer(shape)
        return mean, covariance


def pitch_model(
    normal: Series,
    courses: Courses,
    geometry: Geometry,
    contacts: list[ContactTime],
    span: tuple[float, float],
) -> PitchModel:
    """Prepare the model for a window.

    Parameters
    ----------
    normal : Series
        Normal acceleration.
    courses : Courses
        Smoothed with all contacts of the main wheels.
    geometry : Geometry
        With a nose wheel.
    contacts : list of ContactTime
        Of the main wheels, the first one first.
    span : (float, float)
        First and last time at which the pitch is wanted [s].
    """
    first = contacts[0].time
    time = np.arange(first, span[1] + 1.0, _STEP)
    load = np.interp(time, normal.time, normal.value) - 1.0
    load -= _lift_change(time, load, courses, geometry, contacts)
    base = wheel_base(geometry)
    main = max(float(wheel.position[0]) for wheel in geometry.mains)
    lever = main - float(geometry.centre_of_gravity[0])
    return PitchModel(
        start=span[0],
        first=first,
        mains=tuple(contact.time for contact in contacts),
        time=time,
        by_load=np.cumsum(np.cumsum(load)) * _STEP**2,
        by_damping=-np.cumsum(courses.pitch.at(time) - courses.pitch.at(first)) * _STEP,
        load_lever=-_OF_MAINS * GRAVITY * lever / (_GYRATION * base) ** 2,
        nose_acceleration=_BY_NOSE / base,
    )


def _lift_change(
    time: Array, load: Array, courses: Courses, geometry: Geometry, contacts: list[ContactTime]
) -> Array:
    """Change of lift over weight, (n,): in a hop the normal acceleration shows it."""
    hops = [contact.time for contact in contacts if contact.kind is ContactKind.BOUNCE]
    if not hops:
        return np.zeros_like(time)
    low, _ = lowest_course(courses, geometry, geometry.mains, time)
    off = (time > contacts[0].time + _COMPRESSED) & (time < hops[0] - _ONSET) & (low > 0)
    shown = np.concatenate([[contacts[0].time], time[off]])
    return np.asarray(np.interp(time, shown, np.concatenate([[0.0], load[off]])))


def wheel_base(geometry: Geometry) -> float:
    """Distance of the nose wheel from the mains [m]."""
    main = max(float(wheel.position[0]) for wheel in geometry.mains)
    return main - float(geometry.of(Place.NOSE)[0].position[0])


def outer(rows: Array) -> Array:
    """Outer product of each row with itself, (n, m) to (n, m, m)."""
    return np.asarray(rows[:, :, None] * rows[:, None, :])


def _integrated(since: Array, density: float) -> Array:
    """Covariance of white noise that begins at 0, integrated twice, (n, m, m).

    Notes
    -----
    ``S a^2 (3 b - a) / 6`` at a < b: C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for
    Machine Learning (2006), eq. 6.28.
    """
    late = np.maximum(since, 0.0)
    one, other = late[:, :, None], late[:, None, :]
    less, more = np.minimum(one, other), np.maximum(one, other)
    return np.asarray(density * less**2 * (3 * more - less) / 6)
