"""``definition.toml`` of the example aircraft, as text."""

from collections.abc import Iterable, Mapping, Sequence

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet import gears, loading
from solver.aircraft.bizjet.aerodynamics import damping, weathercock
from solver.aircraft.bizjet.assembly import Parts
from solver.aircraft.bizjet.catalogue import Catalogue
from solver.aircraft.bizjet.families import FAMILY, MATERIALS
from solver.aircraft.bizjet.masses import MassGroupRange

NAME = "ebj-19"
DISCLAIMER = (
    "Generic midsize business jet for demonstration; NOT a model of a certified aeroplane. "
    "Advisory only: approved maintenance data remain the authority for return to service."
)
Value = str | int | float | Sequence["Value"]

#: Utilisations at which the verdict rises; from the sanity ladder in docs/example-aircraft.md.
VERDICT: dict[str, str | float] = {
    "firm_utilisation": 0.48,
    "inspect_utilisation": 0.85,
    "overweight_factor": 0.95,
    "roll_limit_deg": 6.0,
    "nose_first": "INSPECT",
    "makers_rule": NAME,
}


def definition_text(parts: Parts, groups: Sequence[MassGroupRange], bulk_data: str) -> str:
    """Give the whole file."""
    catalogue = parts.mesh.catalogue
    lines = [
        "# Example aircraft EBJ-19.  Written together with its bulk data; units are in the keys.",
        *_pairs(
            name=NAME,
            title="Example business jet EBJ-19",
            description="Generic midsize business jet: low swept wing, aft engines, T-tail.",
            disclaimer=DISCLAIMER,
            bulk_data=bulk_data,
        ),
        *_table(
            "masses",
            operating_empty_kg=loading.OPERATING_EMPTY,
            maximum_zero_fuel_kg=loading.MAXIMUM_ZERO_FUEL,
            maximum_landing_kg=loading.MAXIMUM_LANDING,
            maximum_takeoff_kg=loading.MAXIMUM_TAKEOFF,
        ),
        *_table(
            "reference",
            wing_area_m2=dim.WING_AREA,
            wing_span_m=dim.WING_SPAN,
            mean_chord_m=dim.MEAN_CHORD,
            mean_chord_leading_edge_station_m=dim.MEAN_CHORD_LEADING_EDGE,
            forward_centre_of_gravity_station_m=loading.FORWARD_LIMIT,
            aft_centre_of_gravity_station_m=loading.AFT_LIMIT,
        ),
        *_aerodynamics(),
        *_table(
            "structure",
            modal_damping_ratio=0.02,
            source="assumed: 1 to 3 % is usual for riveted aluminium airframes",
        ),
        *_table(
            "verdict", **VERDICT, source="sanity ladder of this aircraft, see its documentation"
        ),
        *_gears(parts),
        *_groups(groups),
        *_air_loads(catalogue),
        *_materials(),
        *_zones(catalogue),
    ]
    return "\n".join(lines) + "\n"


def _format(value: Value) -> str:
    if isinstance(value, str):
        return '"' + value.replace('"', '\\"') + '"'
    if isinstance(value, int | float):
        return repr(value)
    return "[" + ", ".join(_format(item) for item in value) + "]"


def _pairs(**values: Value) -> list[str]:
    return [f"{key} = {_format(value)}" for key, value in values.items()]


def _table(table: str, /, **values: Value) -> list[str]:
    return ["", f"[{table}]", *_pairs(**values)]


def _entry(table: str, /, **values: Value) -> list[str]:
    return ["", f"[[{table}]]", *_pairs(**values)]


def _aerodynamics() -> list[str]:
    values = damping()
    return _table(
        "aerodynamics",
        air_density_kg_m3=1.225,
        drag_coefficient=0.12,
        pitch_damping_per_rad=values.pitch,
        roll_damping_per_rad=values.roll,
        yaw_damping_per_rad=values.yaw,
        weathercock_per_rad=weathercock(),
        source="damping and weathercock: strip theory of wing, tailplane and fin (Etkin and Reid "
        "1996, chapter 5); drag with flaps and gears down: assumed",
    )


def _gears(parts: Parts) -> list[str]:
    lines: list[str] = []
    for kind, sections in gears.GEAR_TYPES.items():
        lines += _table(f"gear_types.{kind}", unsprung_mass_kg=gears.UNSPRUNG_MASS[kind])
        for section, values in sections.items():
            lines += _table(f"gear_types.{kind}.{section}", **values)
        vertical, drag, side = gears.LIMITS[kind]
        lines += _table(
            f"gear_types.{kind}.limits",
            vertical_n=vertical,
            drag_n=drag,
            side_n=side,
            source="largest of the design cases (14 CFR 25.473 to 25.499), see the aircraft's "
            "documentation",
        )
    pins = {
        "nose": (parts.nose_pins, gears.NOSE_PINS),
        "main_left": (parts.main_pins[-1], gears.MAIN_PINS),
        "main_right": (parts.main_pins[1], gears.MAIN_PINS),
    }
    for name, (kind, pivot) in gears.gear_pivots().items():
        lines += _entry(
            "gears", name=name, type=kind, position=kind, pivot_m=pivot, axis=(0.0, 0.0, -1.0)
        )
        nodes, stiffnesses = pins[name]
        for pin, (label, (translation, rotation)) in zip(nodes, stiffnesses.items(), strict=True):
            lines += _entry(
                "gears.pins",
                name=label,
                node=pin.row + 1,
                translational_stiffness_n_m=translation,
                rotational_stiffness_n_m_rad=rotation,
            )
    return lines


def _groups(groups: Sequence[MassGroupRange]) -> list[str]:
    lines: list[str] = []
    for group in groups:
        tank = group.name.startswith("wing")
        lines += _entry(
            "tanks" if tank else "bays",
            name=group.name,
            capacity_kg=group.capacity,
            conm2=[[group.first, group.last]],
            default_fill=0.3 if tank else 0.5,
        )
    return lines


def _ranges(catalogue: Catalogue, families: Iterable[str]) -> list[list[int]]:
    ranges = catalogue.zone_ranges()
    wanted = set(families)
    return [list(span) for (family, _), span in ranges.items() if family in wanted]


def _air_loads(catalogue: Catalogue) -> list[str]:
    def family_names(start: str, word: str = "skin") -> list[str]:
        return [name for name in FAMILY if name.startswith(start) and word in name]

    tail = [(0.0, dim.FIN_TIP_LEADING_EDGE, dim.FIN_TIP_CHORD),
            (dim.TAIL_HALF_SPAN, dim.TAIL_TIP_LEADING_EDGE, dim.TAIL_TIP_CHORD)]  # fmt: skip
    fin = [(dim.FIN_ROOT_HEIGHT, dim.FIN_ROOT_LEADING_EDGE, dim.FIN_ROOT_CHORD),
           (dim.FIN_TIP_HEIGHT, dim.FIN_TIP_LEADING_EDGE, dim.FIN_TIP_CHORD)]  # fmt: skip
    wing = [(y, round(float(dim.wing_leading_edge(y)), 4), round(float(dim.wing_chord(y)), 4))
            for y in (0.0, dim.HALF_SPAN)]  # fmt: skip
    lines: list[str] = []
    for name, families, law, chords in (
        ("wing", [*family_names("wing "), *family_names("centre box")], "schrenk", wing),
        ("tail", family_names("tailplane"), "schrenk", tail),
        ("fin", family_names("fin"), "uniform", fin),
    ):
        lines += _table(
            f"air_loads.{name}",
            properties=_ranges(catalogue, families),
            law=law,
            centre_of_pressure=0.25,
        )
        for position, station, chord in chords:
            lines += _entry(
                f"air_loads.{name}.planform",
                span_position_m=position,
                leading_edge_station_m=station,
                chord_m=chord,
            )
    skin = [name for name in FAMILY if name.startswith("fuselage skin")]
    lines += _table("air_loads.fuselage", properties=_ranges(catalogue, skin), drag_share=0.5)
    return lines


def _materials() -> list[str]:
    lines: list[str] = []
    for name, material, allowable in MATERIALS:
        lines += _entry(
            "materials",
            name=name,
            mat1=material.identifier,
            limit_allowable_pa=allowable,
            source="assumed, of the size of MMPDS values; no certified data",
        )
    return lines


def _zones(catalogue: Catalogue) -> list[str]:
    lines: list[str] = []
    for (name, side), span in catalogue.zone_ranges().items():
        family = FAMILY[name]
        allowable: Mapping[str, float] = {
            f"{'beam' if family.is_beam else 'shell'}_limit_allowable_pa": family.allowable
        }
        lines += _entry(
            "zones",
            name=name if side == "centre" else f"{name}, {side}",
            component=family.component,
            side=side,
            ata_chapter=family.ata_chapter,
            properties=[list(span)],
            look_for=family.look_for,
            access=family.access,
            **allowable,
        )
    return lines
