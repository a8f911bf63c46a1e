"""Force laws of the tyre: figures, the catalogue's points, and the limits of Fiala's laws."""

import math
from collections.abc import Mapping

import numpy as np

from solver.gear.parameters import Tyre
from solver.gear.tyre import fiala_forces, tyre_vertical_force
from verification.chapter import Plot
from verification.comparison import Comparison
from verification.gear.naca1154 import FOOT, POUND_FORCE
from verification.plots import Line, Panel, line_plot

INCH = FOOT / 12

#: Rated and bottoming load [lb] with their deflections [in], from the tyre makers' catalogue, of
#: the tyres of the example aircraft by their free radius [m].
CATALOGUE = {
    0.27559: ((7100.0, 1.25), (21300.0, 2.85)),  # 22x5.75-12 12PR
    0.224155: ((4350.0, 0.925), (13050.0, 2.025)),  # 18x4.4 12PR
}


def tyre_plot(tyre: Tyre, title: str) -> Plot:
    """Vertical law with its bottoming, and Fiala's laws at three loads."""
    deflection = np.linspace(0.0, 1.12 * tyre.bottoming_deflection, 161)
    vertical = tyre_vertical_force(deflection, tyre) / tyre.count
    slip = np.linspace(-1.0, 1.0, 401)
    angle = np.radians(np.linspace(-20.0, 20.0, 401))
    rated = tyre.longitudinal_stiffness / 10  # as the definition of the example aircraft has it
    longitudinal, lateral, moment = [], [], []
    for share in (0.5, 1.0, 1.5):
        label = f"{share * rated / 1e3:.0f} kN"
        along = [_fiala(share * rated, kappa, 0.0, tyre)[0] / 1e3 for kappa in slip]
        across = [_fiala(share * rated, 0.0, math.tan(alpha), tyre) for alpha in angle]
        longitudinal.append(Line(slip, np.array(along), label))
        lateral.append(Line(np.degrees(angle), np.array([f[1] for f in across]) / 1e3, label))
        moment.append(Line(np.degrees(angle), np.array([f[2] for f in across]), label))
    return line_plot(
        "gear-tyre-laws",
        f"Force laws of one tyre of the {title}: vertical with the catalogue's two points, "
        "longitudinal against slip, lateral force and aligning moment against slip angle, each "
        "at three vertical loads.",
        [
            Panel(
                "deflection [mm]",
                "force [kN]",
                [
                    Line(deflection * 1e3, vertical / 1e3, "law"),
                    Line(
                        np.array([point[1] for point in CATALOGUE[tyre.free_radius]]) * INCH * 1e3,
                        np.array([point[0] for point in CATALOGUE[tyre.free_radius]])
                        * POUND_FORCE
                        / 1e3,
                        "catalogue",
                        "points",
                        label_at=70.0,
                    ),
                ],
                "Vertical",
            ),
            Panel("slip", "force [kN]", longitudinal, "Longitudinal"),
            Panel("slip angle [deg]", "force [kN]", lateral, "Lateral"),
            Panel("slip angle [deg]", "moment [N m]", moment, "Aligning"),
        ],
    )


def tyre_comparisons(tyres: Mapping[str, Tyre]) -> tuple[Comparison, ...]:
    """Vertical laws against the catalogue, Fiala's laws against their limits."""
    rows = []
    for gear, tyre in tyres.items():
        for words, (load, inches) in zip(
            ("rated", "bottoming"), CATALOGUE[tyre.free_radius], strict=True
        ):
            force = tyre_vertical_force(np.array([inches * INCH]), tyre)[0] / tyre.count
            rows.append(
                Comparison(
                    f"{gear} tyre, {words} load",
                    float(force),
                    load * POUND_FORCE,
                    2e-3,
                    "N",
                    "tyre makers' catalogue, load and deflection of this size",
                    "catalogue deflections are given to a hundredth of an inch; the law's two "
                    "constants were fitted to the two points",
                )
            )
    tyre = next(iter(tyres.values()))
    normal, small = 3e4, 1e-4
    full = tyre.minimum_friction * normal
    locked = full - full**2 / (4 * tyre.longitudinal_stiffness)
    exact = "rounding of a few operations"
    bend = "curvature of the law over a slip of 1e-4"
    rows += [
        Comparison(
            "slope of the longitudinal force at no slip",
            _fiala(normal, small, 0.0, tyre)[0] / small,
            tyre.longitudinal_stiffness,
            1e-12,
            "N",
            "longitudinal stiffness of the Fiala tyre",
            exact,
        ),
        Comparison(
            "longitudinal force of a locked wheel",
            _fiala(normal, -1.0, 0.0, tyre)[0],
            -locked,
            1e-12,
            "N",
            "Fiala's sliding branch at a slip of one",
            exact,
        ),
        Comparison(
            "slope of the lateral force at no slip",
            -_fiala(normal, 0.0, small, tyre)[1] / small,
            tyre.cornering_stiffness,
            2e-3,
            "N",
            "cornering stiffness of the Fiala tyre",
            bend,
        ),
        Comparison(
            "lateral force in full sliding",
            -_fiala(normal, 0.0, 1.0, tyre)[1],
            full,
            1e-12,
            "N",
            "Coulomb friction at full slip",
            exact,
        ),
        Comparison(
            "jump between the branches of the longitudinal law",
            _jump(normal, tyre),
            0.0,
            1e-9,
            "",
            "the branches meet",
            "a slip of 1e-12 across the border, and rounding",
            scale=1.0,
        ),
    ]
    return tuple(rows)


def _jump(normal: float, tyre: Tyre) -> float:
    """Relative change of the longitudinal force where one branch passes into the other."""

    def excess(slip: float) -> float:
        spread = tyre.maximum_friction - tyre.minimum_friction
        available = (tyre.maximum_friction - spread * slip) * normal
        return slip - available / (2 * tyre.longitudinal_stiffness)

    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    below, above = (_fiala(normal, slip, 0.0, tyre)[0] for slip in (low - 1e-12, high + 1e-12))
    return float(above / below - 1)


def _fiala(normal: float, slip: float, tangent: float, tyre: Tyre) -> tuple[float, float, float]:
    forces: tuple[float, float, float] = fiala_forces(
        normal,
        slip,
        tangent,
        tyre.longitudinal_stiffness,
        tyre.cornering_stiffness,
        tyre.maximum_friction,
        tyre.minimum_friction,
        tyre.width,
    )
    return forces
