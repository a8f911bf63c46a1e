"""Reading ``definition.toml`` into the values of `solver.aircraft.definition`."""

import hashlib
import math
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from solver.aircraft import definition as values
from solver.aircraft import definition_file as file
from solver.aircraft.scatter import AllowableBasis, Scatter
from solver.aircraft.toml_document import read_document
from solver.assessment import Verdict
from solver.errors import ModelError
from solver.gear.parameters import SpringBack, Strut, Tyre


def load_definition(folder: Path) -> values.AircraftDefinition:
    """Read and check the definition in an aircraft's folder.

    Raises
    ------
    ModelError
        The file is missing or not TOML, a key is unknown, missing or outside its range (each is
        named with its value and range), or names that must differ are repeated.
    """
    path = folder / values.DEFINITION_FILE
    checked = read_document(path, file.DefinitionFile)
    try:
        return _definition(checked)
    except ModelError as error:
        raise ModelError(f"{path}: {error}") from error


def content_hash(folder: Path, *files: str) -> str:
    """SHA-256 over the definition and ``files``: everything that decides an assessment.

    The digests of the files are hashed, so that no byte can move from one to the other unseen.
    """
    digests = [
        hashlib.sha256((folder / name).read_bytes()).digest()
        for name in (values.DEFINITION_FILE, *files)
    ]
    return hashlib.sha256(b"".join(digests)).hexdigest()


def _definition(checked: file.DefinitionFile) -> values.AircraftDefinition:
    _refuse_repeated("gears.name", (gear.name for gear in checked.gears))
    _refuse_repeated("gears.pins.node", (pin.node for gear in checked.gears for pin in gear.pins))
    for gear in checked.gears:
        _refuse_repeated(f"{gear.name}: pins.name", (pin.name for pin in gear.pins))
    _refuse_repeated(
        "tanks and bays: name", (group.name for group in (*checked.tanks, *checked.bays))
    )
    _refuse_repeated("materials.mat1", (material.mat1 for material in checked.materials))
    _refuse_repeated("zones.name", (zone.name for zone in checked.zones))
    masses, reference, aero = checked.masses, checked.reference, checked.aerodynamics
    return values.AircraftDefinition(
        name=checked.name,
        title=checked.title,
        description=checked.description,
        disclaimer=checked.disclaimer,
        bulk_data=checked.bulk_data,
        masses=values.Masses(
            operating_empty=masses.operating_empty_kg,
            maximum_zero_fuel=masses.maximum_zero_fuel_kg,
            maximum_landing=masses.maximum_landing_kg,
            maximum_takeoff=masses.maximum_takeoff_kg,
        ),
        reference=values.Reference(
            wing_area=reference.wing_area_m2,
            wing_span=reference.wing_span_m,
            mean_chord=reference.mean_chord_m,
            mean_chord_leading_edge=reference.mean_chord_leading_edge_station_m,
            forward_centre_of_gravity=reference.forward_centre_of_gravity_station_m,
            aft_centre_of_gravity=reference.aft_centre_of_gravity_station_m,
        ),
        aerodynamics=values.AerodynamicDerivatives(
            air_density=aero.air_density_kg_m3,
            drag_coefficient=aero.drag_coefficient,
            pitch_damping=aero.pitch_damping_per_rad,
            roll_damping=aero.roll_damping_per_rad,
            yaw_damping=aero.yaw_damping_per_rad,
            weathercock=aero.weathercock_per_rad,
        ),
        modal_damping_ratio=checked.structure.modal_damping_ratio,
        verdict=values.VerdictThresholds(
            firm_utilisation=checked.verdict.firm_utilisation,
            inspect_utilisation=checked.verdict.inspect_utilisation,
            overweight_factor=checked.verdict.overweight_factor,
            roll_limit=math.radians(checked.verdict.roll_limit_deg),
            nose_closure_limit=checked.verdict.nose_closure_limit_m_s,
            nose_first=Verdict(checked.verdict.nose_first),
            # Looking costs 1, not looking the ratio times the probability over its complement.
            inspect_probability=1.0 / (1.0 + checked.verdict.missed_over_needless_cost),
            hard_probability=checked.verdict.hard_probability,
        ),
        gears=tuple(_gear(gear, checked) for gear in checked.gears),
        tanks=tuple(map(_mass_group, checked.tanks)),
        bays=tuple(map(_mass_group, checked.bays)),
        air_loads=values.AirLoadLayout(
            wing=_surface(checked.air_loads.wing),
            tail=_surface(checked.air_loads.tail),
            fin=_surface(checked.air_loads.fin),
            fuselage=_skin(checked.air_loads.fuselage),
            fuselage_drag_share=checked.air_loads.fuselage.drag_share,
        ),
        materials=tuple(
            values.MaterialAllowable(material.name, material.mat1, material.limit_allowable_pa)
            for material in checked.materials
        ),
        zones=tuple(_zone(zone) for zone in checked.zones),
        scatter=_scatter(checked.scatter),
        makers_rule=checked.verdict.makers_rule,
    )


def _scatter(section: file.ScatterSection) -> Scatter:
    return Scatter(
        gas_pressure=section.gas_pressure_relative_sd,
        strut_damping=section.strut_damping_relative_sd,
        tyre_stiffness=section.tyre_stiffness_relative_sd,
        tyre_friction=section.tyre_friction_relative_sd,
        lift_decay_start=section.lift_decay_start_sd_s,
        lift_decay_time=section.lift_decay_time_relative_sd,
        residual_lift_fraction=section.residual_lift_fraction_sd,
        structural_damping=section.structural_damping_relative_sd,
        allowable=section.allowable_relative_sd,
        allowable_basis=AllowableBasis(section.allowable_basis),
    )


def _refuse_repeated(field: str, names: Iterable[object]) -> None:
    repeated = [name for name, count in Counter(names).items() if count > 1]
    if repeated:
        raise ModelError(f"{field}: {repeated[0]!r} is used more than once")


def _identifiers(entries: Sequence[int | list[int]]) -> values.IdentifierSet:
    ranges = []
    for entry in entries:
        first, last = (entry, entry) if isinstance(entry, int) else (entry[0], entry[1])
        if first > last:
            raise ModelError(f"identifier range [{first}, {last}] runs backwards")
        ranges.append((first, last))
    return values.IdentifierSet(tuple(ranges))


def _gear(gear: file.GearSection, checked: file.DefinitionFile) -> values.GearDefinition:
    if gear.type not in checked.gear_types:
        known = ", ".join(sorted(checked.gear_types))
        raise ModelError(
            f"gears: {gear.name}: type {gear.type!r} is not among gear_types ({known})"
        )
    kind = checked.gear_types[gear.type]
    length = float(np.linalg.norm(gear.axis))
    if abs(length - 1.0) > 1e-3:
        raise ModelError(f"gears: {gear.name}: axis must have unit length, has {length:.4g}")
    try:
        strut, tyre = _strut(kind.strut), _tyre(kind.tyre)
        spring_back = _spring_back(kind)
    except ModelError as error:
        raise ModelError(f"gear_types.{gear.type}: {error}") from error
    return values.GearDefinition(
        name=gear.name,
        position=gear.position,
        strut=strut,
        tyre=tyre,
        spring_back=spring_back,
        unsprung_mass=kind.unsprung_mass_kg,
        pivot=np.array(gear.pivot_m, dtype=float),
        axis=np.array(gear.axis, dtype=float) / length,
        pins=tuple(
            values.PinDefinition(
                name=pin.name,
                node=pin.node,
                stiffness=np.array(
                    pin.translational_stiffness_n_m + pin.rotational_stiffness_n_m_rad, dtype=float
                ),
            )
            for pin in gear.pins
        ),
        limits=values.GearLimits(
            vertical=kind.limits.vertical_n, drag=kind.limits.drag_n, side=kind.limits.side_n
        ),
    )


def _strut(section: file.StrutSection) -> Strut:
    return Strut(
        pneumatic_area=section.pneumatic_area_m2,
        initial_gas_pressure=section.gas_pressure_pa,
        initial_gas_volume=section.gas_volume_m3,
        polytropic_exponent=section.polytropic_exponent,
        compression_coefficient=section.compression_damping_n_s2_m2,
        rebound_coefficient=section.rebound_damping_n_s2_m2,
        full_stroke=section.stroke_m,
        extended_length=section.length_m,
        metering=tuple((point.stroke_m, point.area_ratio) for point in section.metering),
        stop_stiffness=section.stop_stiffness_n_m,
        seal_friction=section.seal_friction_n,
    )


def _tyre(section: file.TyreSection) -> Tyre:
    return Tyre(
        free_radius=section.free_radius_m,
        vertical_coefficient=section.stiffness_n_m_r,
        vertical_exponent=section.exponent,
        longitudinal_stiffness=section.slip_stiffness_n,
        cornering_stiffness=section.cornering_stiffness_n_rad,
        maximum_friction=section.friction_maximum,
        minimum_friction=section.friction_minimum,
        width=section.width_m,
        wheel_inertia=section.wheel_inertia_kg_m2,
        count=section.count,
        bottoming_deflection=section.bottoming_deflection_m,
        bottoming_stiffness=section.bottoming_stiffness_n_m,
        rolling_resistance=section.rolling_resistance_m,
    )


def _spring_back(kind: file.GearTypeSection) -> SpringBack:
    section = kind.spring_back
    if section.frequency_hz is not None:
        return SpringBack.from_frequency(
            frequency=section.frequency_hz,
            unsprung_mass=kind.unsprung_mass_kg,
            length=kind.strut.length_m - section.frequency_stroke_m,
            damping_ratio=section.damping_ratio,
        )
    if section.stiffness_n_m_rad is not None:
        return SpringBack(stiffness=section.stiffness_n_m_rad, damping_ratio=section.damping_ratio)
    attachment = section.attachment_stiffness_n_m_rad
    return SpringBack(
        damping_ratio=section.damping_ratio,
        cylinder_rigidity=section.cylinder_rigidity_n_m2 or 0.0,
        piston_rigidity=section.piston_rigidity_n_m2 or 0.0,
        cylinder_length=section.cylinder_length_m or 0.0,
        attachment_stiffness=math.inf if attachment is None else attachment,
    )


def _mass_group(group: file.MassGroupSection) -> values.MassGroup:
    return values.MassGroup(
        name=group.name,
        capacity=group.capacity_kg,
        point_masses=_identifiers(group.conm2),
        default_fill=group.default_fill,
    )


def _skin(section: file.SurfaceSection | file.FuselageSection) -> values.LoadedSkin:
    return values.LoadedSkin(
        properties=None if section.properties is None else _identifiers(section.properties),
        nodes=None if section.nodes is None else _identifiers(section.nodes),
    )


def _surface(section: file.SurfaceSection) -> values.LiftingSurface:
    return values.LiftingSurface(
        skin=_skin(section),
        law=section.law,
        centre_of_pressure=section.centre_of_pressure,
        planform=values.Planform(
            span_position=np.array([chord.span_position_m for chord in section.planform]),
            leading_edge=np.array([chord.leading_edge_station_m for chord in section.planform]),
            chord=np.array([chord.chord_m for chord in section.planform]),
        ),
    )


def _zone(zone: file.ZoneSection) -> values.Zone:
    return values.Zone(
        name=zone.name,
        component=zone.component,
        side=zone.side,
        ata_chapter=zone.ata_chapter,
        properties=_identifiers(zone.properties),
        look_for=zone.look_for,
        access=zone.access,
        shell_limit_allowable=zone.shell_limit_allowable_pa,
        beam_limit_allowable=zone.beam_limit_allowable_pa,
    )
