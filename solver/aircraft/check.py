"""What an engineer wants to know of an aircraft folder before trusting its verdicts."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from solver.aircraft.airframe import Airframe
from solver.arrays import Array
from solver.fe.inertia import MassProperties
from solver.progress import Progress, silent

#: A mode below this is no elastic one: airframes start above 1 Hz [Hz].
RIGID_FREQUENCY = 0.05
#: Strain energy of a rigid motion, as a share of the energy of the same motion node by node.
RIGID_ENERGY = 1e-9
_MODES = 12
_SHIFT_FREQUENCY = 0.5  #: makes K - sigma M definite, far below the first elastic mode [Hz]
_WORST_ASPECT = 20.0
_WORST_WARP = 15.0  #: [deg]
_FARTHEST_PIN = 2.5  #: from the gear's pivot [m]


@dataclass(frozen=True, slots=True)
class ZoneCheck:
    """One zone: how many elements, and the span of their allowables."""

    name: str
    elements: int
    lowest_allowable: float  #: [Pa]
    highest_allowable: float  #: [Pa]


@dataclass(frozen=True, slots=True)
class AirframeCheck:
    """Findings about one aircraft."""

    name: str
    content_hash: str
    counts: dict[str, int]
    empty_mass: float  #: operating empty with the unsprung masses [kg]
    loaded_mass: float  #: gross at the default loading [kg]
    loaded_centre: Array  #: (3,) gross centre of gravity at the default loading [m]
    loaded_chord_fraction: float  #: of it on the mean aerodynamic chord
    rigid_body: MassProperties  #: airframe without the unsprung masses, default loading
    rigid_energy: float  #: largest share, see ``RIGID_ENERGY``
    rigid_modes: int  #: modes below ``RIGID_FREQUENCY``; six for a sound model
    elastic_frequencies: tuple[float, ...]  #: lowest of the free airframe, default loading [Hz]
    zones: tuple[ZoneCheck, ...]
    warnings: tuple[str, ...]

    @property
    def is_sound(self) -> bool:
        """Whether the model moves rigidly without stress and has no mechanism."""
        return self.rigid_energy < RIGID_ENERGY and self.rigid_modes == 6


def check_airframe(airframe: Airframe, progress: Progress = silent) -> AirframeCheck:
    """Count, weigh and shake an airframe that could be read and assembled."""
    structure, definition = airframe.structure, airframe.definition
    model = structure.model
    loading = airframe.loading_for()
    progress("rigid and elastic modes", 0.0)
    energy = rigid_energy_share(airframe)
    frequencies = lowest_frequencies(airframe, loading.factors)
    progress("rigid and elastic modes", 1.0)
    zones = []
    for index, zone in enumerate(definition.zones):
        allowables = airframe.allowables[airframe.element_zone == index]
        zones.append(
            ZoneCheck(zone.name, len(allowables), float(allowables.min()), float(allowables.max()))
        )
    rigid_modes = int(np.sum(frequencies < RIGID_FREQUENCY))
    return AirframeCheck(
        name=definition.name,
        content_hash=airframe.content_hash,
        counts={
            "nodes": model.node_count,
            "quadrilaterals": len(model.quads.identifiers),
            "triangles": len(model.triangles.identifiers),
            "beams": len(model.beams.identifiers),
            "elements": len(model.element_identifiers),
            "lumped masses, empty": len(model.point_masses.identifiers),
            "rigid bodies": len(model.rigid_bodies),
            "interpolations": len(model.interpolations),
            "freedoms": structure.n_free,
            "gears": len(definition.gears),
            "pins": len(airframe.pin_rows),
            "tanks": len(definition.tanks),
            "bays": len(definition.bays),
            "zones": len(definition.zones),
        },
        empty_mass=airframe.mass_states.gross(np.zeros(len(airframe.groups)))[0],
        loaded_mass=loading.mass,
        loaded_centre=loading.centre_of_gravity,
        loaded_chord_fraction=definition.reference.chord_fraction(
            float(loading.centre_of_gravity[0])
        ),
        rigid_body=airframe.mass_properties(loading.factors),
        rigid_energy=energy,
        rigid_modes=rigid_modes,
        elastic_frequencies=tuple(frequencies[rigid_modes:].tolist()),
        zones=tuple(zones),
        warnings=tuple(_warnings(airframe, energy, rigid_modes)),
    )


def rigid_energy_share(airframe: Airframe) -> float:
    """Largest strain energy of a unit rigid motion about the centre of gravity, relative.

    The measure is ``phi' K phi / phi' diag(K) phi``: one if the nodes moved independently, rounding
    if the model has no hidden support and its elements carry rigid motion without stress.
    """
    stiffness = airframe.structure.stiffness
    centre = airframe.mass_properties(np.zeros(len(airframe.groups))).centre_of_gravity
    modes = airframe.structure.rigid_modes(centre)
    energy = np.sum(modes * (stiffness @ modes), axis=0)
    scale = np.sum(modes**2 * stiffness.diagonal()[:, None], axis=0)
    return float(np.max(np.abs(energy) / scale))


def lowest_frequencies(airframe: Airframe, factors: Array) -> Array:
    """Lowest free-free frequencies of the loaded airframe, rigid ones included, ascending [Hz]."""
    stiffness = airframe.structure.stiffness
    mass = airframe.inertia(factors).mass_matrix()
    shift = -((2 * np.pi * _SHIFT_FREQUENCY) ** 2)
    # positive definite: diagonal pivots and an ordering for symmetric matrices halve the fill
    factor = splu(
        csc_matrix(stiffness - shift * mass),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    inverse = LinearOperator(stiffness.shape, matvec=factor.solve, dtype=np.float64)
    start = np.random.default_rng(0).standard_normal(stiffness.shape[0])
    values = eigsh(
        stiffness, k=_MODES, M=mass, sigma=shift, OPinv=inverse, v0=start,
        return_eigenvectors=False,
    )  # fmt: skip
    return np.asarray(np.sqrt(np.maximum(np.sort(values), 0.0)) / (2 * np.pi))


def _warnings(airframe: Airframe, energy: float, rigid_modes: int) -> Iterator[str]:
    definition, states = airframe.definition, airframe.mass_states
    if energy >= RIGID_ENERGY:
        yield f"rigid motion strains the model (share {energy:.2g}): a hidden support"
    if rigid_modes != 6:
        yield f"{rigid_modes} modes below {RIGID_FREQUENCY} Hz instead of six: a mechanism"
    if airframe.ignored_parameters:
        yield f"PARAM passed over: {', '.join(airframe.ignored_parameters)}"
    groups = len(airframe.groups)
    empty, full = states.gross(np.zeros(groups))[0], states.gross(np.ones(groups))[0]
    masses = definition.masses
    if abs(empty - masses.operating_empty) > 1e-3 * masses.operating_empty:
        yield f"empty mass {empty:.0f} kg, defined {masses.operating_empty:.0f} kg"
    if full < masses.maximum_takeoff:
        yield f"full tanks and bays give {full:.0f} kg, below take-off {masses.maximum_takeoff:.0f}"
    reference = definition.reference
    centre = airframe.loading_for().centre_of_gravity
    if not reference.forward_centre_of_gravity <= centre[0] <= reference.aft_centre_of_gravity:
        yield (
            f"centre of gravity {centre[0]:.3f} m at the default loading is outside "
            f"{reference.forward_centre_of_gravity:g} to {reference.aft_centre_of_gravity:g} m"
        )
    if abs(centre[1]) > 2e-3 * reference.wing_span:
        yield f"centre of gravity is {centre[1]:+.3f} m off the plane of symmetry"
    yield from _shape_warnings(airframe)
    positions = iter(airframe.structure.model.coordinates[airframe.pin_rows])
    for gear in definition.gears:
        for pin in gear.pins:
            distance = float(np.linalg.norm(next(positions) - gear.pivot))
            if distance > _FARTHEST_PIN:
                yield f"{gear.name} pin {pin.name} is {distance:.2f} m from the gear's pivot"


def _shape_warnings(airframe: Airframe) -> Iterator[str]:
    """Quadrilaterals that are long or twisted."""
    model = airframe.structure.model
    if not len(model.quads.identifiers):
        return
    a, b, c, d = np.moveaxis(model.coordinates[model.quads.nodes], 1, 0)
    sides = np.stack([np.linalg.norm(q - p, axis=1) for p, q in ((a, b), (b, c), (c, d), (d, a))])
    aspect = sides.max(axis=0) / sides.min(axis=0)
    normals = [np.cross(b - a, d - a), np.cross(d - c, b - c)]
    cosine = np.sum(normals[0] * normals[1], axis=1)
    cosine /= np.linalg.norm(normals[0], axis=1) * np.linalg.norm(normals[1], axis=1)
    warp = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    for name, values, limit, unit in (
        ("aspect ratio", aspect, _WORST_ASPECT, ""),
        ("warp", warp, _WORST_WARP, " deg"),
    ):
        count = int(np.sum(values > limit))
        if count:
            worst = int(np.argmax(values))
            yield (
                f"{count} CQUAD4 have {name} above {limit:g}{unit}, worst "
                f"{model.quads.identifiers[worst]} with {values[worst]:.3g}{unit}"
            )
