"""What the flexible landing must fulfil by itself, and what its settings are worth."""

import numpy as np

from solver.inertia_relief.basis import elastic_modes
from solver.landing.history import LandingHistory
from verification.chapter import Table
from verification.comparison import Comparison
from verification.flexible_airframe.study import (
    FULL,
    FULL_MODES,
    STICK,
    Approach,
    Landed,
    Models,
    land_with,
    mirrored,
    on_ground,
    peak,
    strut_forces,
    truncated,
)

#: Numbers of modes at which convergence is looked at.
MODE_NUMBERS = (0, 20, 50, 100, 200)
#: What they are compared with.
MANY_MODES = 400
#: Frequencies times these: the airframe becomes rigid.
STIFFNESS_FACTORS = (5.0, 10.0)
#: Lowest frequencies of the stick that must be near those of the full model, and how near.
FREQUENCIES = ((3, 0.03), (9, 0.1))
#: Largest difference of peak strut forces that is still called none: main gears, nose gear.
MAIN_TOLERANCE, NOSE_TOLERANCE = 0.1, 0.15


def strut_comparisons(all_landed: list[Landed]) -> list[Comparison]:
    """Peak strut forces: one-way coupling against two-way."""
    rows = []
    for landed in all_landed:
        for index in landed.loaded_gears():
            rigid, full = landed.rigid.gears[index], landed.full.history.gears[index]
            rows.append(
                Comparison(
                    f"{landed.approach.title}: {rigid.name.replace('_', ' ')}, peak strut force "
                    "with the rigid airframe",
                    peak(rigid),
                    peak(full),
                    NOSE_TOLERANCE if rigid.name == "nose" else MAIN_TOLERANCE,
                    "N",
                    "two-way coupling with the modes of the full model",
                    "Lee et al. see no significant difference and give no figure; a fitting that "
                    "gives way spares the strut a few hundredths of its closing speed, which the "
                    "oil's force feels squared; the forward fuselage, on which the nose gear comes "
                    "down last, swings most",
                )
            )
    return rows


def stick_comparisons(all_landed: list[Landed]) -> list[Comparison]:
    """Peak strut forces: the stick against the full model's modes."""
    rows = []
    for landed in all_landed:
        for index in landed.loaded_gears():
            stick, full = (
                history.gears[index] for history in (landed.stick.history, landed.full.history)
            )
            rows.append(
                Comparison(
                    f"{landed.approach.title}: {full.name.replace('_', ' ')}, peak strut force "
                    "with the stick",
                    peak(stick),
                    peak(full),
                    0.03,
                    "N",
                    f"modes of the {FULL}",
                    "two representations of one airframe; frequencies agree within a twentieth, "
                    "and the struts feel only a share of the structure's motion",
                )
            )
    return rows


def model_comparisons(models: Models, exact: bool) -> list[Comparison]:
    """Compare the stick with the full model: mass to rounding, frequencies as far as beams go."""
    full, stick = (
        body.rigid_body_properties() for body in (models.inertia, models.stick.structure.inertia)
    )
    frequencies = models.all_full.circular_frequency
    rounding = "every mass point goes to one station as a whole, halves of couplings to two"
    rows = [
        Comparison("mass of the stick", stick.mass, full.mass, 1e-12, "kg", FULL, rounding),
        Comparison(
            "centre of gravity of the stick, distance",
            float(np.linalg.norm(stick.centre_of_gravity - full.centre_of_gravity)),
            0.0,
            1e-10,
            "m",
            FULL,
            rounding,
            scale=1.0,
        ),
        Comparison(
            "inertia tensor of the stick, largest difference over the largest moment",
            float(np.abs(stick.inertia - full.inertia).max() / np.abs(full.inertia).max()),
            0.0,
            1e-12,
            "",
            FULL,
            rounding,
            scale=1.0,
        ),
    ]
    for count, bound in FREQUENCIES:
        ratio = models.all_stick.circular_frequency[:count] / frequencies[:count] - 1
        worst = int(np.argmax(np.abs(ratio)))
        rows.append(
            Comparison(
                f"lowest {count} frequencies of the stick, worst is number {worst + 1}",
                float(models.all_stick.circular_frequency[worst]) / (2 * np.pi),
                float(frequencies[worst]) / (2 * np.pi),
                bound,
                "Hz",
                FULL,
                "one beam for a bay of some metre with frames, floor and joints; higher modes "
                "deform the joints of wing, fuselage and tail, which no beam is like; what the "
                "struts feel of it is compared further down",
            )
        )
    if exact:
        count = 30
        found, _ = elastic_modes(models.body, count)
        ratio = frequencies[:count] / found[:count] - 1
        worst = int(np.argmax(np.abs(ratio)))
        rows.append(
            Comparison(
                f"lowest {count} frequencies of the reduced model, worst is number {worst + 1}",
                float(frequencies[worst]) / (2 * np.pi),
                float(found[worst]) / (2 * np.pi),
                1e-3,
                "Hz",
                "eigenvalues of the full matrices at this loading",
                "the basis holds the modes of another mass state and how they change with it",
            )
        )
    return rows


def soundness_comparisons(all_landed: list[Landed]) -> list[Comparison]:
    """Energy of all landings, symmetry of the symmetric one."""
    rows = []
    for landed in all_landed:
        for name, landing in ((STICK, landed.stick), (FULL, landed.full)):
            rows.append(
                Comparison(
                    f"{landed.approach.title}: energy account with the {name}, largest imbalance "
                    "over the impact energy",
                    landing.history.energy.closure_error,
                    0.0,
                    1e-4,
                    "",
                    "kinetic, potential, strain and lost energy against the work of lift",
                    "integration error at the tolerance of all landings",
                    scale=1.0,
                )
            )
    landed = all_landed[0]
    sides = mirrored(landed)
    for name, history in landed.histories.items():
        gears = {gear.name: gear for gear in history.gears}
        port, starboard = (gears[side].strut_force for side in sides)
        rows.append(
            Comparison(
                f"{landed.approach.title}: port against starboard strut, {name}, over the peak",
                float(np.abs(port - starboard).max() / port.max()),
                0.0,
                5e-4,
                "",
                "symmetry",
                "the aircraft is symmetric; its modes are so to single precision, in which they "
                "are found, and but for what the basis drops",
                scale=1.0,
            )
        )
    return rows


def settings_comparisons(
    models: Models, approach: Approach, landed: Landed, duration: float
) -> tuple[list[Comparison], Table]:
    """Convergence with the number of modes; stiff limit; terms of second order."""
    everything = land_with(
        models, truncated(models.all_full, 400, models.loading), approach, duration
    )
    exact = strut_forces(everything.history)
    tops = exact.max(axis=1)
    rows, table = [], []

    def apart(history: LandingHistory) -> float:
        touching = on_ground(history, everything.history)
        squares = np.where(touching, (strut_forces(history) - exact) ** 2, 0.0)
        means = squares.sum(axis=1) / touching.sum(axis=1)
        return float((np.sqrt(means) / tops).max())

    for number in MODE_NUMBERS:
        flexible = truncated(models.all_full, number, models.loading)
        history = land_with(models, flexible, approach, duration).history
        found = strut_forces(history)
        worst = float(np.abs(found.max(axis=1) / tops - 1).max())
        table.append(
            (
                str(number),
                str(flexible.size),
                f"{flexible.circular_frequency[number - 1] / (2 * np.pi):.0f}" if number else "-",
                f"{flexible.circular_frequency[-1] / (2 * np.pi):.0f}",
                f"{100 * worst:.2f}",
                f"{100 * apart(history):.2f}",
            )
        )
        if number == FULL_MODES:
            rows.append(
                Comparison(
                    f"{approach.title}: peak strut forces with {number} modes and residual "
                    "vectors, worst difference",
                    worst,
                    0.0,
                    0.005,
                    "",
                    f"{MANY_MODES} modes",
                    "a tenth of what flexibility does to the strut forces",
                    scale=1.0,
                )
            )
    first = models.full.without_second_order()
    bare = strut_forces(land_with(models, first, approach, duration).history)
    full = strut_forces(landed.full.history)
    rows.append(
        Comparison(
            f"{approach.title}: strut forces without the rate terms of second order, largest "
            "difference over the peak",
            float((np.abs(bare - full).max(axis=1) / full.max(axis=1)).max()),
            0.0,
            0.01,
            "",
            "all terms of the turning frame",
            "body rates of some tenths of rad/s against modes of 17 rad/s and more",
            scale=1.0,
        )
    )
    rigid = strut_forces(landed.rigid)
    for factor in STIFFNESS_FACTORS:
        stiff = land_with(models, models.full.stiffened(factor), approach, duration)
        found = strut_forces(stiff.history)
        rows.append(
            Comparison(
                f"{approach.title}: peak strut forces, all frequencies times {factor:g}, worst "
                "difference from the rigid airframe",
                float(np.abs(found.max(axis=1) / rigid.max(axis=1) - 1).max()),
                0.0,
                0.5 / factor**2,
                "",
                "simulation of the rigid airframe",
                "deflections fall with the square of the factor; half covers a difference of "
                "first order in them",
                scale=1.0,
            )
        )
    note = (
        f"Against {MANY_MODES} modes and residual vectors: worst gear, over its peak. "
        f"The landings of this chapter use {FULL_MODES}."
    )
    return rows, Table(
        f"Convergence with the number of modes, {approach.title}",
        (
            "modes",
            "with residual vectors",
            "highest mode [Hz]",
            "highest residual vector [Hz]",
            "peak strut force [%]",
            "strut force, root mean square, tyre on the ground [%]",
        ),
        tuple(table),
        note,
    )
