"""Force laws of the strut: figures in the form of the paper's, and what they must meet."""

import numpy as np
from scipy.integrate import quad

from solver.gear.drop_test import DropTestParameters
from solver.gear.oleo import gas_energy, gas_force, oleo_force
from solver.gear.parameters import Strut
from verification.chapter import Plot
from verification.comparison import Comparison
from verification.gear.one_gear_landing import strut_of
from verification.plots import Line, Panel, line_plot


def oleo_plot(given: DropTestParameters) -> Plot:
    """Laws of the strut in the form of the paper's Figs 8 to 10, and their sum."""
    strut = strut_of(given)
    rate = np.linspace(-1.5, 1.5, 241)
    stroke = np.linspace(0.0, 0.9 * given.stroke_limit, 181)
    near = np.linspace(-0.3e-3, 0.3e-3, 121)
    still = np.zeros_like
    # The gas force is taken off again, so that the oil's is seen alone.
    oil = oleo_force(np.full_like(rate, 0.05), rate, strut) - _gas(0.05, strut)
    gas = np.array([_gas(s, strut) for s in stroke])
    return line_plot(
        "gear-oleo-laws",
        "Force laws of the strut of the drop test: oil against closure speed, gas against stroke, "
        "the extension stop that carries the preload at full extension, and the sum of all "
        "against stroke at several closure speeds (the paper's Figs 8 to 10, and their sum).",
        [
            Panel("closure speed [m/s]", "force [kN]", [Line(rate, oil / 1e3)], "Oil"),
            Panel("stroke [mm]", "force [kN]", [Line(stroke * 1e3, gas / 1e3)], "Gas"),
            Panel(
                "stroke [mm]",
                "force [kN]",
                [Line(near * 1e3, oleo_force(near, still(near), strut) / 1e3)],
                "Stop at full extension",
            ),
            Panel(
                "stroke [mm]",
                "force [kN]",
                [
                    Line(
                        stroke * 1e3,
                        oleo_force(stroke, np.full_like(stroke, speed), strut) / 1e3,
                        f"{speed:g} m/s",
                    )
                    for speed in (0.0, 0.5, 1.0, 1.5)
                ],
                "Sum at closure speeds",
            ),
        ],
    )


def oleo_comparisons(given: DropTestParameters) -> tuple[Comparison, ...]:
    """Laws of the strut against their physics."""
    strut = strut_of(given)
    stroke, rate = 0.6 * given.stroke_limit, 1.2
    # Bernoulli: the flow A_h s' through C_d A_n needs a pressure of rho/2 (flow / area)^2.
    jet = given.hydraulic_area * rate / (given.discharge_coefficient * given.orifice_area)
    oil = given.fluid_density / 2 * jet**2 * given.hydraulic_area
    gas = _gas(stroke, strut)
    found = float(oleo_force(np.array([stroke]), np.array([rate]), strut)[0])
    work = quad(lambda s: _gas(s, strut), 0.0, stroke, epsabs=0.0, epsrel=1e-13)[0]
    energy = gas_energy(
        stroke,
        strut.pneumatic_area,
        strut.initial_gas_pressure,
        strut.initial_gas_volume,
        strut.polytropic_exponent,
    )
    volume = strut.initial_gas_volume - strut.pneumatic_area * stroke
    constant = gas / strut.pneumatic_area * volume**strut.polytropic_exponent
    initial = strut.initial_gas_pressure * strut.initial_gas_volume**strut.polytropic_exponent
    depth = 1e-4
    pair = oleo_force(np.array([0.0, -depth]), np.zeros(2), strut)
    gas_alone = _gas(0.0, strut) - _gas(-depth, strut)
    slope = float(pair[0] - pair[1] - gas_alone) / depth
    rounding = "rounding of a few operations"
    return (
        Comparison(
            "oil force at 1.2 m/s",
            found - gas,
            oil,
            1e-12,
            "N",
            "Bernoulli's equation and continuity, evaluated by pressures",
            rounding,
        ),
        Comparison(
            "p Vⁿ of the gas at 60 % of the stroke",
            constant,
            initial,
            1e-12,
            "",
            "the same at full extension",
            rounding,
        ),
        Comparison(
            "work of the gas to 60 % of the stroke",
            energy,
            work,
            1e-11,
            "J",
            "quadrature of the gas force",
            "the quadrature's own tolerance is 1e-13",
        ),
        Comparison(
            "stiffness of the extension stop",
            slope,
            strut.stop_stiffness,
            1e-9,
            "N/m",
            "its parameter",
            "rounding of a small difference of forces",
        ),
    )


def _gas(stroke: float, strut: Strut) -> float:
    force: float = gas_force(
        stroke,
        strut.pneumatic_area,
        strut.initial_gas_pressure,
        strut.initial_gas_volume,
        strut.polytropic_exponent,
    )
    return force
