"""Gear and landing beside exudyn: figures and drawings of the chapter."""

from dataclasses import dataclass, fields, replace
from math import radians

import numpy as np

from app.cli.landing_file import LandingFile
from solver.arrays import Array
from solver.frames import rotation_matrix
from solver.gear.drop_test import drop_test
from solver.landing.contact import Contact
from solver.landing.history import LandingHistory
from solver.landing.peaks import refined_peak
from solver.landing.simulate import SimulationOptions, simulate_landing
from verification.chapter import Comparisons, Item, Plot, Table, Text
from verification.comparison import Comparison
from verification.gear.naca1154 import DropTestSet
from verification.peers.apart import apart
from verification.peers.exudyn_drop_test import PeerDropTest, drop
from verification.peers.exudyn_landing import PeerLanding, land
from verification.plots import Line, Panel, line_plot
from verification.run import ROOT, Run

SOURCE = "exudyn, redundant coordinates, implicit generalised-alpha, force laws written anew"
EXAMPLE = "examples/landing_level_10fps.json"
PEER_SOURCES = (
    "verification/peers/exudyn_landing.py",
    "verification/peers/exudyn_drop_test.py",
    "verification/peers/gear_laws.py",
)
#: Step of the peer's landing and drop test [s].
LANDING_STEP = 2e-4
DROP_STEP = 5e-5
DROP_DURATION = 0.30
#: Stiffness of the peer's stop at full extension, a hundred times that of the aircraft's [N/m].
DROP_STOP = 1.5e9


def drop_test_items(run: Run) -> list[Item]:
    """Drop test of NACA Report 1154 by exudyn."""
    run.progress("drop test by exudyn", 0.0)
    parameters = DropTestSet().in_si()
    found = drop_test(parameters)
    peer: PeerDropTest = apart(
        drop,
        parameters,
        DROP_DURATION,
        DROP_STEP,
        DROP_STOP,
        report=lambda share: run.progress("drop test by exudyn", share),
    )
    force_time, force = refined_peak(peer.time, peer.ground_force)
    stroke_time, stroke = refined_peak(peer.time, peer.stroke)
    strut = refined_peak(peer.time, peer.strut_force)[1]
    after = peer.time > (found.breakout_time or 0.0) + 0.01
    distance = float(
        np.max(
            np.abs(
                peer.ground_force[after]
                - np.interp(peer.time[after], found.history.time, found.history.ground_force)
            )
        )
    )
    stop = (
        "the peer's strut rests on a stop of 1.5 GN/m where the solver's is rigid until it breaks "
        "out; its error falls in proportion to the compliance, and is 1e-5 at this stiffness"
    )
    step = "steps of the peer are 0.05 ms, its peaks are refined by a parabola"
    rows = (
        Comparison(
            "drop test, peak force of the ground",
            found.peak_ground_force,
            force,
            5e-5,
            "N",
            SOURCE,
            stop,
        ),
        Comparison(
            "drop test, peak force of the strut",
            float(found.history.strut_force.max()),
            strut,
            1e-4,
            "N",
            SOURCE,
            stop + "; the solver's history has samples of 0.5 ms",
        ),
        Comparison(
            "drop test, largest stroke", found.maximum_stroke, stroke, 5e-5, "m", SOURCE, stop
        ),
        Comparison(
            "drop test, time of the peak force",
            found.peak_ground_force_time,
            force_time,
            5e-5,
            "s",
            SOURCE,
            step,
            scale=1.0,
        ),
        Comparison(
            "drop test, time of the largest stroke",
            found.maximum_stroke_time or np.nan,
            stroke_time,
            5e-5,
            "s",
            SOURCE,
            step,
            scale=1.0,
        ),
        Comparison(
            "drop test, largest distance of the force curves over the peak",
            distance / force,
            0.0,
            2e-3,
            "",
            SOURCE,
            "after the break-out; the solver's history is interpolated between its samples",
            scale=1.0,
        ),
    )
    ours = found.history
    plot = line_plot(
        "peers-drop-test",
        "Drop test of NACA Report 1154 by the solver and, dashed, by exudyn.",
        [
            _overlay(
                "force of the ground [kN]",
                (ours.time, ours.ground_force / 1e3),
                (peer.time, peer.ground_force / 1e3),
                DROP_DURATION,
            ),
            _overlay(
                "stroke [mm]",
                (ours.time, ours.stroke * 1e3),
                (peer.time, peer.stroke * 1e3),
                DROP_DURATION,
            ),
        ],
    )
    return [plot, Comparisons("Drop test beside exudyn", rows)]


def _overlay(
    label: str, ours: tuple[Array, Array], peer: tuple[Array, Array], end: float, title: str = ""
) -> Panel:
    """Draw two histories, each of times and values, over one another."""
    return Panel(
        "time [s]",
        label,
        [
            Line(*ours, "solver", colour=0, width=2.4),
            Line(*peer, "exudyn", "dashed", colour=1),
        ],
        title,
        x_limits=(0.0, end),
    )


@dataclass(frozen=True, slots=True)
class _Landing:
    """A landing that both simulate."""

    name: str
    title: str
    contact: Contact
    duration: float  #: [s]


def _landings(file: LandingFile) -> tuple[_Landing, ...]:
    level = file.landing_contact()
    rolled = replace(
        level,
        sink_rate=2.9,
        roll=radians(3.0),
        drift=radians(2.0),
        roll_rate=radians(3.0),
        lift=replace(level.lift, fraction=0.8),
    )
    return (
        _Landing("level", "the example's level landing at 10 ft/s", level, 0.4),
        _Landing(
            "rolled",
            "3 degrees of roll, 2 degrees of drift, 3 degrees/s of roll rate, lift 0.8",
            rolled,
            0.6,
        ),
    )


def landing_items(run: Run) -> list[Item]:
    """Landings of the example's aircraft by exudyn."""
    file = LandingFile.model_validate_json((ROOT / EXAMPLE).read_bytes())
    description = file.aircraft_description
    assert description is not None
    aircraft = description.aircraft()
    items: list[Item] = [
        Text(
            "The aircraft of examples/landing_level_10fps.json, with rigid legs, is built of "
            "exudyn's bodies and joints: the airframe, three legs on prismatic joints, wheels on "
            "revolute ones. The laws of strut and tyre are written anew from their formulae and "
            "share nothing with the solver's. The integrators have nothing in common either."
        )
    ]
    for landing in _landings(file):
        options = SimulationOptions(
            output_interval=2.5e-4, time_limit=landing.duration, stop_when_settled=False
        )
        ours = simulate_landing(aircraft, landing.contact, options)
        peer = _stored_landing(run, aircraft, landing)
        items.append(_landing_plot(landing, ours, peer))
        items.append(
            Comparisons(f"Landing beside exudyn: {landing.title}", _compared(landing, ours, peer))
        )
        items.append(_landing_table(landing, ours, peer))
    return items


def _stored_landing(run: Run, aircraft: object, landing: _Landing) -> PeerLanding:
    step = f"{landing.name} landing by exudyn"

    def compute() -> dict[str, Array]:
        found: PeerLanding = apart(
            land,
            aircraft,
            landing.contact,
            landing.duration,
            LANDING_STEP,
            report=lambda share: run.progress(step, share),
        )
        return {field.name: np.asarray(getattr(found, field.name)) for field in fields(found)}

    kept = run.stored(
        f"peer-landing-{landing.name}",
        [aircraft, landing.contact, landing.duration, LANDING_STEP],
        PEER_SOURCES,
        compute,
    )
    return PeerLanding(**kept)


def _compared(landing: _Landing, ours: LandingHistory, peer: PeerLanding) -> tuple[Comparison, ...]:
    step = "the peer's steps of 0.2 ms are of second order and kinks of the laws lie within them"
    instant = "half the peer's step; peaks are refined by a parabola"
    rows = []
    for index, gear in enumerate(ours.gears):
        for words, unit, mine, theirs in (
            ("ground force", "N", -gear.ground_force[:, 2], peer.ground_force[:, index, 2]),
            ("spin-up drag", "N", -gear.ground_force[:, 0], -peer.ground_force[:, index, 0]),
            ("strut force", "N", gear.strut_force, peer.strut_force[:, index]),
            ("stroke", "m", gear.stroke, peer.stroke[:, index]),
        ):
            time, value = refined_peak(ours.time, mine)
            peer_time, target = refined_peak(peer.time, theirs)
            name = f"{landing.name}, {gear.name}, peak {words}"
            rows.append(Comparison(name, value, target, 3e-4, unit, SOURCE, step))
            if words in ("ground force", "stroke"):
                rows.append(
                    Comparison(
                        f"{landing.name}, {gear.name}, time of the peak {words}",
                        time,
                        peer_time,
                        1e-4,
                        "s",
                        SOURCE,
                        instant,
                        scale=1.0,
                    )
                )
    rows += _attitude_comparisons(landing, ours, peer)
    return tuple(rows)


def _attitude_comparisons(
    landing: _Landing, ours: LandingHistory, peer: PeerLanding
) -> list[Comparison]:
    theirs = np.stack([np.interp(ours.time, peer.time, column) for column in peer.rate.T], axis=1)
    later = ours.time >= peer.time[0]
    largest = float(np.abs(peer.rate).max())
    distance = float(np.abs(ours.rate - theirs)[later].max()) / largest
    mine = rotation_matrix(ours.attitude)
    last = np.array(
        [np.interp(peer.time, ours.time, mine[:, i, j]) for i in range(3) for j in range(3)]
    )
    turned = float(np.abs(last.T.reshape(-1, 3, 3) - peer.attitude).max())
    turn = float(np.abs(peer.attitude - peer.attitude[0]).max())
    reason = "second order of the peer's step, over the whole history"
    return [
        Comparison(
            f"{landing.name}, largest distance of the angular rates over the largest rate",
            distance, 0.0, 5e-4, "", SOURCE, reason, scale=1.0,
        ),
        Comparison(
            f"{landing.name}, largest distance of the attitudes over the largest turn",
            turned / turn, 0.0, 5e-4, "", SOURCE, reason, scale=1.0,
        ),
    ]  # fmt: skip


def _landing_plot(landing: _Landing, ours: LandingHistory, peer: PeerLanding) -> Plot:
    end = landing.duration
    panels = []
    for index in (1, 2):
        gear, theirs = ours.gears[index], peer.ground_force[:, index] / 1e3
        mine = gear.ground_force / 1e3
        title = f"Ground force, {gear.name} gear"
        panels += [
            _overlay("up [kN]", (ours.time, -mine[:, 2]), (peer.time, theirs[:, 2]), end, title),
            _overlay("aft [kN]", (ours.time, -mine[:, 0]), (peer.time, -theirs[:, 0]), end, title),
        ]
    gear = ours.gears[1]
    panels += [
        _overlay(
            "stroke [mm]",
            (ours.time, gear.stroke * 1e3),
            (peer.time, peer.stroke[:, 1] * 1e3),
            end,
            f"Stroke, {gear.name} gear",
        ),
        _overlay(
            "pitch rate [deg/s]",
            (ours.time, np.degrees(ours.rate[:, 1])),
            (peer.time, np.degrees(peer.rate[:, 1])),
            end,
            "Pitch rate",
        ),
    ]
    return line_plot(
        f"peers-landing-{landing.name}",
        f"Landing by the solver and, dashed, by exudyn: {landing.title}.",
        panels,
    )


def _landing_table(landing: _Landing, ours: LandingHistory, peer: PeerLanding) -> Table:
    rows = []
    for index, gear in enumerate(ours.gears):
        theirs = np.interp(ours.time, peer.time, peer.ground_force[:, index, 2])
        peak = float(theirs.max())
        force = float(np.abs(-gear.ground_force[:, 2] - theirs)[1:].max()) / peak
        stroke = np.interp(ours.time, peer.time, peer.stroke[:, index])
        distance = float(np.abs(gear.stroke - stroke)[1:].max()) / float(stroke.max())
        spin = np.interp(ours.time, peer.time, peer.wheel_speed[:, index])
        speed = float(np.abs(gear.wheel_speed - spin)[1:].max()) / float(spin.max())
        rows.append((gear.name, f"{force:.1e}", f"{distance:.1e}", f"{speed:.1e}"))
    return Table(
        f"Largest distance of the histories over their peaks: {landing.title}",
        ("gear", "ground force", "stroke", "wheel speed"),
        tuple(rows),
        note=f"{len(peer.time)} steps of the peer, {len(ours.time)} samples of the solver, "
        "between which the histories are interpolated.",
    )
