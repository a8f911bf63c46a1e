"""Rigid against flexible airframe: the same landing coupled one way and two ways."""

import numpy as np

from verification.chapter import Chapter, Comparisons, Item, Text
from verification.flexible_airframe.checks import (
    model_comparisons,
    settings_comparisons,
    soundness_comparisons,
    stick_comparisons,
    strut_comparisons,
)
from verification.flexible_airframe.figures import (
    flexibility_table,
    force_plot,
    frequency_table,
    peak_table,
    spring_back_table,
    stick_plot,
)
from verification.flexible_airframe.pins import pin_comparison
from verification.flexible_airframe.stress import (
    both_peaks,
    consistency_comparisons,
    stress_comparisons,
    stress_plot,
    stress_table,
)
from verification.flexible_airframe.study import (
    APPROACHES,
    FULL_MODES,
    Landed,
    Models,
    build_models,
    land,
)
from verification.run import Run

#: Numbers of the paper's figures of strut forces.
FIGURES = {"symmetric": 20, "asymmetric": 21}


def chapter(run: Run) -> Chapter:
    """Compute and describe."""
    models = build_models(run)
    approaches, duration = (APPROACHES[:2], 0.3) if run.quick else (APPROACHES, 1.0)
    all_landed = []
    for number, approach in enumerate(approaches):
        run.progress("landings, rigid and flexible", number / len(approaches))
        all_landed.append(land(models, approach, duration))
    run.progress("landings, rigid and flexible", 1.0)
    items: list[Item] = [
        Text(
            "The service lands a rigid airframe and then loads the structure: coupling is one-way. "
            "Here the airframe moves with its gears and is moved by them, in two forms: a stick "
            "model of beams, and the modes of the full model. The rigid motion is nonlinear; the "
            "elastic motion is modal, in the mean-axis frame, from the steady flight shape on, "
            "with the damping of the analysis of stress. Each gear hangs on its fitting, which "
            "follows its pins on the deformed airframe in position, velocity and rotation; the "
            "gears are those of the service, kernel by kernel."
        ),
        stick_plot(models.stick),
        Text(
            "No stiffness or mass of the stick is typed in. Unit loads on the ends of all "
            "branches and unit air loads, balanced by inertia, are laid on the full model; in "
            "every bay the section loads follow from equilibrium and the relative motion of its "
            "ends from the full model. Axial, bending, shear and torsional stiffness, shear "
            "centre and principal axes are fitted to all of them. Masses go to the nearest "
            "station."
        ),
        frequency_table(models, 20),
        flexibility_table(models),
        Comparisons("Stick against full model", tuple(model_comparisons(models, not run.quick))),
        *[force_plot(landed, FIGURES[landed.approach.name]) for landed in all_landed[:2]],
        peak_table(all_landed),
        Text(_what_differs(models, all_landed)),
        Comparisons(
            "Peak strut forces: rigid airframe against flexible",
            tuple(strut_comparisons(all_landed)),
        ),
        Comparisons(
            "Peak strut forces: stick against full model", tuple(stick_comparisons(all_landed))
        ),
        Text(
            "Spring-back feels the airframe more than the struts do: the legs swing on fittings "
            "that give way and turn, hence slower than on a rigid airframe."
        ),
        spring_back_table(all_landed[:2]),
        Comparisons("Energy and symmetry", tuple(soundness_comparisons(all_landed))),
    ]
    if not run.quick:
        run.progress("convergence with the number of modes", 0.0)
        rows, table = settings_comparisons(models, approaches[1], all_landed[1], duration)
        rows.append(pin_comparison(models, all_landed[1], duration))
        run.progress("convergence with the number of modes", 1.0)
        items += [table, Comparisons("Settings and limits", tuple(rows))]
    items += _stress_items(run, models, all_landed)
    return Chapter("flexible_airframe", "Rigid against flexible airframe", tuple(items))


def _what_differs(models: Models, all_landed: list[Landed]) -> str:
    changes = []
    for landed in all_landed:
        for index in landed.loaded_gears():
            rigid, full = landed.rigid.gears[index], landed.full.history.gears[index]
            changes.append(full.strut_force.max() / rigid.strut_force.max() - 1)
    first = all_landed[0]
    share = np.ptp(first.full.elastic_energy) / first.rigid.energy.impact_energy
    # Down is positive in body axes: a fitting that gives way moves up.
    main = int(np.argmax([gear.strut_force.max() for gear in first.rigid.gears]))
    yielding = -(models.full.fittings[main, 2] @ first.full.velocities).min()
    closing = first.full.history.gears[main].stroke_rate.max()
    return (
        f"Two-way coupling with {FULL_MODES} modes changes the peak strut forces by "
        f"{100 * min(changes):+.1f} to {100 * max(changes):+.1f} %. In the "
        f"{first.approach.name} approach the main fittings give way at up to {yielding:.2f} m/s "
        f"while their struts close at up to {closing:.2f} m/s, and the structure's strain energy "
        f"swings by {100 * share:.0f} % of the impact energy. Differences at one instant are "
        "larger, where a steep flank comes a few milliseconds earlier or later, where the "
        "airframe's vibration rides on the force, and where a strut that leaves the ground runs "
        "out against its stop."
    )


def _stress_items(run: Run, models: Models, all_landed: list[Landed]) -> list[Item]:
    peaks = []
    for number, landed in enumerate(all_landed):
        run.progress("peak stress, one-way and two-way", number / len(all_landed))
        peaks.append(both_peaks(run, models, landed))
    run.progress("peak stress, one-way and two-way", 1.0)
    consistent = [row for each in peaks for row in consistency_comparisons(models, each)]
    return [
        Text(
            "The pin loads of the flexible landing, put through the same extended inertia relief "
            "in place of those of the rigid one, say what one-way coupling costs in stress. The "
            "rigid motion is taken as that which these loads give the undeformed airframe, so "
            "that they balance to rounding. As a check of both, inertia relief then finds the "
            "elastic motion that the flexible landing had."
        ),
        Comparisons("Inertia relief against the flexible landing", tuple(consistent)),
        stress_table(run, peaks),
        stress_plot(peaks),
        Comparisons(
            "Stress from one-way coupling against two-way", tuple(stress_comparisons(run, peaks))
        ),
    ]
