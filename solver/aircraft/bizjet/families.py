"""Kinds of structural part of the example aircraft: material, gauges, allowable, what to inspect.

Each part is one family; its bays get properties of their own, so that each can be sized.

Limit allowables are assumptions.  They start from values of the size that handbooks of metallic
materials give for the alloys named (MMPDS, the lesser of yield and ultimate / 1.5) and are lowered
for what the mesh does not show: thin panels that buckle (skins, webs), fastener rows and fatigue
(lower wing skin, stringers, caps), a fitting factor of 1.15 (14 CFR 25.625) and the stress
concentration of bores and lugs (fittings).  No fatigue analysis backs them; sizing keeps panels
from buckling, see `solver.sizing.panels`.
"""

from dataclasses import dataclass

from solver.fe.model import Material

#: name, MAT1 card, limit allowable von Mises [Pa]
MATERIALS: tuple[tuple[str, Material, float], ...] = (
    ("aluminium 2024-T3", Material(1, 72.4e9, 72.4e9 / 2.66, 0.33, 2780.0), 270e6),
    ("aluminium 7075-T6", Material(2, 71.0e9, 71.0e9 / 2.66, 0.33, 2810.0), 340e6),
    ("titanium Ti-6Al-4V", Material(3, 110.0e9, 110.0e9 / 2.62, 0.31, 4430.0), 560e6),
)
AL2024, AL7075, TITANIUM = 1, 2, 3


@dataclass(frozen=True, slots=True)
class Family:
    """One kind of part.  Beams have a depth, shells have none."""

    name: str
    component: str
    ata_chapter: str
    material: int
    gauge: float  #: thickness [m] or cross-section area [m2] before sizing
    minimum: float  #: gauge [m] or [m2]
    allowable: float  #: limit, von Mises [Pa]
    look_for: str
    depth: float = 0.0  #: of a beam with area ``gauge`` [m]
    access: str = "assumed: external"

    @property
    def is_beam(self) -> bool:
        """Whether the family is made of beams."""
        return self.depth > 0


_WRINKLES = "wrinkles, pulled or sheared fasteners, cracked paint"
_SPARS = "web distortion, cap cracks, fuel leaks, loose fasteners"
_FITTING = "cracks at lugs and bores, bearing migration, sheared fasteners; dye-penetrant the lugs"
_FRAME = "buckled webs, cracked caps, loose clips"
_FLOOR = "deformed beams, loose seat tracks"


def _family(
    name: str,
    component: str,
    ata: str,
    material: int,
    gauge: float,
    minimum: float,
    allowable: float,
    look_for: str,
    depth: float = 0.0,
    access: str = "assumed: external",
) -> Family:
    scale = 1e-6 if depth else 1e-3
    return Family(
        name,
        component,
        ata,
        material,
        gauge * scale,
        minimum * scale,
        allowable * 1e6,
        look_for,
        depth,
        access,
    )


_BAY = "assumed: gear bay with doors open"
_TANK = "assumed: tank access panels"
_LINING = "assumed: behind cabin lining"
_BELLY = "assumed: belly fairing panels"

# Gauges in mm (shells) or mm2 (beams), allowables in MPa.
FAMILIES: tuple[Family, ...] = (
    _family("wing upper skin inner", "wing", "57", AL7075, 3.0, 1.4, 180, _WRINKLES),
    _family("wing upper skin outer", "wing", "57", AL7075, 1.8, 1.2, 140, _WRINKLES),
    _family("wing lower skin inner", "wing", "57", AL2024, 3.0, 1.4, 200, _WRINKLES),
    _family("wing lower skin outer", "wing", "57", AL2024, 1.8, 1.2, 170, _WRINKLES),
    _family("wing stringers", "wing", "57", AL7075, 150, 70, 230, _WRINKLES, 0.030, _TANK),
    _family("wing front spar", "wing", "57", AL7075, 2.5, 1.4, 160, _SPARS, access=_TANK),
    _family("wing rear spar", "wing", "57", AL7075, 2.5, 1.4, 160, _SPARS, access=_TANK),
    _family("wing spar caps", "wing", "57", AL7075, 350, 120, 240, _SPARS, 0.036, _TANK),
    _family("wing ribs", "wing", "57", AL2024, 1.6, 1.0, 120, _FRAME, access=_TANK),
    _family("main gear fitting", "main gear attachment", "32-11", TITANIUM, 6.0, 3.0, 260,
            _FITTING, access=_BAY),
    _family("main gear beam", "main gear attachment", "32-11", AL7075, 5.0, 2.0, 200,
            _FITTING, access=_BAY),
    _family("main gear ribs", "main gear attachment", "32-11", AL7075, 5.0, 2.0, 200,
            _FITTING, access=_BAY),
    _family("main gear brace fitting", "main gear attachment", "32-11", TITANIUM, 5.0, 2.5, 260,
            _FITTING, access=_BAY),
    _family("main gear bay panels", "main gear attachment", "57", AL7075, 3.0, 1.4, 160,
            _WRINKLES, access=_BAY),
    _family("main gear bay caps", "main gear attachment", "57", AL7075, 700, 150, 220,
            _FITTING, 0.055, _BAY),
    _family("centre box upper skin", "wing centre box", "57", AL7075, 3.5, 1.6, 190, _WRINKLES,
            access=_LINING),
    _family("centre box lower skin", "wing centre box", "57", AL2024, 3.5, 1.6, 200, _WRINKLES,
            access=_BELLY),
    _family("centre box spars", "wing centre box", "57", AL7075, 3.5, 1.8, 170, _SPARS,
            access=_BELLY),
    _family("centre box ribs", "wing centre box", "57", AL7075, 2.5, 1.4, 150, _FRAME,
            access=_BELLY),
    _family("centre box stringers", "wing centre box", "57", AL7075, 250, 100, 220, _WRINKLES,
            0.045, _BELLY),
    _family("centre box caps", "wing centre box", "57", AL7075, 500, 200, 240, _SPARS,
            0.045, _BELLY),
    _family("wing-body joint", "wing-body joint", "53", AL7075, 5.0, 2.0, 200, _FITTING,
            access=_BELLY),
    _family("fuselage skin forward", "fuselage", "53", AL2024, 1.3, 1.1, 90, _WRINKLES),
    _family("fuselage skin centre", "fuselage", "53", AL2024, 1.8, 1.2, 110, _WRINKLES),
    _family("fuselage skin aft", "fuselage", "53", AL2024, 1.3, 1.1, 90, _WRINKLES),
    _family("fuselage stringers", "fuselage", "53", AL7075, 90, 60, 180, _FRAME, 0.028, _LINING),
    _family("fuselage frames forward", "fuselage", "53", AL7075, 220, 120, 200, _FRAME, 0.075,
            _LINING),
    _family("fuselage frames centre", "fuselage", "53", AL7075, 350, 150, 210, _FRAME, 0.085,
            _LINING),
    _family("fuselage frames aft", "fuselage", "53", AL7075, 220, 120, 200, _FRAME, 0.075,
            _LINING),
    _family("forward pressure bulkhead", "fuselage", "53", AL2024, 2.0, 1.2, 110, _FRAME,
            access="assumed: nose compartment"),
    _family("aft pressure bulkhead", "fuselage", "53", AL2024, 2.0, 1.2, 110, _FRAME,
            access="assumed: baggage compartment"),
    _family("nose and tail caps", "fuselage", "53", AL2024, 1.5, 1.2, 110, _FRAME),
    _family("bulkhead stiffeners", "fuselage", "53", AL7075, 180, 80, 200, _FRAME, 0.050),
    _family("wing frames", "fuselage", "53", AL7075, 5.0, 3.0, 190, _FRAME, access=_LINING),
    _family("engine frames", "fuselage", "53", AL7075, 3.0, 1.4, 180, _FRAME,
            access="assumed: tail compartment"),
    _family("fin frames", "fuselage", "53", AL7075, 3.0, 1.4, 180, _FRAME,
            access="assumed: tail compartment"),
    _family("cabin floor", "fuselage", "53", AL2024, 1.5, 1.2, 120, _FLOOR, access=_LINING),
    _family("floor beams", "fuselage", "53", AL7075, 260, 120, 190, _FLOOR, 0.090, _LINING),
    _family("nose gear bay webs", "nose gear attachment", "53", AL7075, 2.5, 1.4, 160, _FRAME,
            access="assumed: nose gear bay"),
    _family("nose gear fitting", "nose gear attachment", "32-21", AL7075, 5.0, 2.0, 200,
            _FITTING, access="assumed: nose gear bay"),
    _family("nose gear frames", "nose gear attachment", "53", AL7075, 2.5, 1.4, 160, _FRAME,
            access="assumed: nose gear bay"),
    _family("nose gear bay stiffeners", "nose gear attachment", "53", AL7075, 300, 100, 220,
            _FRAME, 0.040, "assumed: nose gear bay"),
    _family("engine pylon skin", "engine pylon", "54", AL2024, 2.0, 1.2, 130, _WRINKLES),
    _family("engine pylon spars", "engine pylon", "54", AL7075, 4.0, 1.6, 190, _FITTING),
    _family("engine pylon caps", "engine pylon", "54", AL7075, 400, 150, 210, _FITTING, 0.045),
    _family("fin skin", "fin", "55-30", AL2024, 1.6, 1.1, 110, _WRINKLES),
    _family("fin spars", "fin", "55-30", AL7075, 2.5, 1.4, 150, _SPARS),
    _family("fin ribs", "fin", "55-30", AL2024, 1.5, 1.0, 110, _FRAME),
    _family("fin stringers", "fin", "55-30", AL7075, 120, 60, 180, _WRINKLES, 0.025),
    _family("tailplane skin", "tailplane", "55-10", AL2024, 1.4, 1.0, 110, _WRINKLES),
    _family("tailplane spars", "tailplane", "55-10", AL7075, 2.0, 1.2, 150, _SPARS),
    _family("tailplane ribs", "tailplane", "55-10", AL2024, 1.2, 1.0, 110, _FRAME),
    _family("tailplane stringers", "tailplane", "55-10", AL7075, 90, 60, 180, _WRINKLES, 0.022),
)  # fmt: skip
FAMILY = {family.name: family for family in FAMILIES}
