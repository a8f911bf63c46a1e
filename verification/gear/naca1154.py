"""Parameters of the drop test of NACA Report 1154 (Milwitzky & Cook, 1953), in the report's units.

The report's own text and figures were not at hand when the set was written down; each value states
what speaks for it besides.  What the set gives is therefore a solution of the report's equations,
and no statement about how well its measurements are met.
"""

from dataclasses import dataclass, replace

from solver.gear.drop_test import GRAVITY, DropTestParameters

POUND = 0.45359237  #: exact (1959 agreement) [kg]
FOOT = 0.3048  #: exact [m]
POUND_FORCE = POUND * GRAVITY  #: [N]
SLUG = POUND_FORCE / FOOT  #: [kg]


@dataclass(frozen=True, slots=True)
class DropTestSet:
    """The parameters in pounds, feet and seconds."""

    upper_weight: float = 2411.0  #: W_1 [lb]
    lower_weight: float = 131.0  #: W_2 [lb]
    pneumatic_area: float = 0.05761  #: A_a [ft2]
    hydraulic_area: float = 0.04708  #: A_h [ft2]
    orifice_area: float = 0.0005585  #: A_n [ft2]
    gas_pressure: float = 6264.0  #: p_0 [lb/ft2]
    gas_volume: float = 0.03545  #: V_0 [ft3]
    discharge_coefficient: float = 0.9  #: C_d
    polytropic_exponent: float = 1.12  #: n
    fluid_density: float = 1.67  #: rho [slug/ft3]
    tyre_coefficient: float = 18.7e3  #: m [lb/ft^r]
    tyre_exponent: float = 1.34  #: r
    lift_ratio: float = 1.0  #: K_L
    contact_speed: float = 8.86  #: V [ft/s]

    def in_si(self) -> DropTestParameters:
        """Give the same in SI units."""
        return DropTestParameters(
            upper_mass=self.upper_weight * POUND,
            lower_mass=self.lower_weight * POUND,
            pneumatic_area=self.pneumatic_area * FOOT**2,
            hydraulic_area=self.hydraulic_area * FOOT**2,
            orifice_area=self.orifice_area * FOOT**2,
            discharge_coefficient=self.discharge_coefficient,
            fluid_density=self.fluid_density * SLUG / FOOT**3,
            initial_gas_pressure=self.gas_pressure * POUND_FORCE / FOOT**2,
            initial_gas_volume=self.gas_volume * FOOT**3,
            polytropic_exponent=self.polytropic_exponent,
            tyre_coefficient=self.tyre_coefficient * POUND_FORCE / FOOT**self.tyre_exponent,
            tyre_exponent=self.tyre_exponent,
            lift_ratio=self.lift_ratio,
            contact_speed=self.contact_speed * FOOT,
        )

    def changed(self, name: str, factor: float) -> "DropTestSet":
        """Give the set with one value multiplied."""
        return replace(self, **{name: getattr(self, name) * factor})


@dataclass(frozen=True, slots=True)
class Certainty:
    """How sure a value of the set is."""

    name: str
    symbol: str
    unit: str
    evidence: str  #: what speaks for it beside recollection
    spread: float = 0.0  #: relative uncertainty that is allowed for


CERTAINTY = (
    Certainty("upper_weight", "W₁", "lb", "its sum with W₂ meets a known total of 2542 lb"),
    Certainty("lower_weight", "W₂", "lb", "as W₁"),
    Certainty("pneumatic_area", "Aₐ", "ft²", "a bore of 3.250 in to four digits"),
    Certainty("hydraulic_area", "Aₕ", "ft²", "a circle of 2 15/16 in to four digits"),
    Certainty("orifice_area", "Aₙ", "ft²", "a hole of 0.3200 in to four digits"),
    Certainty("gas_pressure", "p₀", "lb/ft²", "43.5 psi exactly"),
    Certainty("gas_volume", "V₀", "ft³", "stroke of 7.38 in, near that of NACA TN 3426"),
    Certainty("discharge_coefficient", "C_d", "", "none", 0.05 / 0.9),
    Certainty("polytropic_exponent", "n", "", "none", 0.15 / 1.12),
    Certainty("fluid_density", "ρ", "slug/ft³", "hydraulic fluid near 70 °F; assumed", 0.04),
    Certainty("tyre_coefficient", "m", "lb/ftʳ", "none", 0.10),
    Certainty("tyre_exponent", "r", "", "median of 385 catalogue tyres is 1.30", 0.03),
    Certainty("lift_ratio", "K_L", "", "none"),
    Certainty("contact_speed", "V", "ft/s", "none"),
)
