"""A model that cannot be used is refused with the element, property or node that is wrong."""

import dataclasses

import numpy as np
import pytest

from solver.errors import ModelError
from solver.fe.model import Material
from solver.fe.structure import build_structure
from verification.elements.meshes import (
    beams_on,
    lumped,
    model,
    plate,
    rectangle_section,
    straight_beam,
)

SECTION = rectangle_section(0.02, 0.03)


def sheet():
    return plate(1.0, 1.0, 2, 2)


def moved(mesh, node, position):
    coordinates = mesh.coordinates.copy()
    coordinates[node] = position
    return dataclasses.replace(mesh, coordinates=coordinates)


def with_property(mesh, kind, **changes):
    properties = {1: dataclasses.replace(getattr(mesh, kind)[1], **changes)}
    return dataclasses.replace(mesh, **{kind: properties})


def folded():
    return moved(sheet(), 4, [1.4, 1.4, 0.0])


def reordered():
    mesh = sheet()
    nodes = mesh.quads.nodes.copy()
    nodes[2] = nodes[2][[0, 2, 1, 3]]
    return dataclasses.replace(mesh, quads=dataclasses.replace(mesh.quads, nodes=nodes))


def separate():
    mesh = sheet()
    count = mesh.node_count
    coordinates = np.concatenate([mesh.coordinates, mesh.coordinates + np.array([5.0, 0, 0])])
    return model(coordinates, quads=np.concatenate([mesh.quads.nodes, mesh.quads.nodes + count]))


def loose():
    mesh = sheet()
    return model(np.concatenate([mesh.coordinates, [[3.0, 3.0, 3.0]]]), quads=mesh.quads.nodes)


BAD = {
    "quad without area": (
        lambda: model(np.zeros((4, 3)) + np.arange(4)[:, None], quads=np.array([[0, 1, 2, 3]])),
        ["quadrilateral 1", "no area"],
    ),
    "quad turned inside out": (folded, ["quadrilateral 2", "not convex"]),
    "quad with crossed sides": (reordered, ["quadrilateral 3"]),
    "triangle without area": (
        lambda: model(
            np.array([[0.0, 0, 0], [1, 1, 1], [2, 2, 2]]), triangles=np.array([[0, 1, 2]])
        ),
        ["triangle 100000", "no area"],
    ),
    "beam without length": (
        lambda: moved(straight_beam(1.0, 2, SECTION), 1, [1.0, 0, 0]),
        ["beam 200001", "length"],
    ),
    "beam with its orientation along it": (
        lambda: straight_beam(1.0, 2, SECTION, orientation=(-2.0, 0, 0)),
        ["beam 200000", "orientation"],
    ),
    "missing shell property": (
        lambda: dataclasses.replace(sheet(), shell_properties={}),
        ["element 1 ", "shell property 1"],
    ),
    "missing beam property": (
        lambda: dataclasses.replace(straight_beam(1.0, 1, SECTION), beam_properties={}),
        ["element 200000", "beam property 1"],
    ),
    "missing material": (
        lambda: dataclasses.replace(sheet(), materials={}),
        ["shell property 1", "material 1"],
    ),
    "material without stiffness": (
        lambda: dataclasses.replace(sheet(), materials={1: Material(1, 0.0, 1e9, 0.3, 2700)}),
        ["material 1", "E 0.0"],
    ),
    "impossible Poisson ratio": (
        lambda: dataclasses.replace(sheet(), materials={1: Material(1, 1e9, 1e9, 0.7, 2700)}),
        ["material 1", "0.7"],
    ),
    "negative density": (
        lambda: dataclasses.replace(sheet(), materials={1: Material(1, 1e9, 1e9, 0.3, -1.0)}),
        ["material 1", "-1.0"],
    ),
    "shell without thickness": (
        lambda: with_property(sheet(), "shell_properties", thickness=0.0),
        ["shell property 1", "thickness"],
    ),
    "beam without torsional stiffness": (
        lambda: with_property(
            straight_beam(1.0, 1, SECTION), "beam_properties", torsion_constant=0.0
        ),
        ["beam property 1", "torsion constant"],
    ),
    "three stress points": (
        lambda: with_property(
            straight_beam(1.0, 1, SECTION), "beam_properties", stress_points=np.zeros((3, 2))
        ),
        ["beam property 1", "stress points"],
    ),
    "position that is not a number": (
        lambda: moved(sheet(), 4, [np.nan, 0, 0]),
        ["node 5", "nan"],
    ),
    "element on a node that is not there": (
        lambda: model(np.eye(3), beams=beams_on(np.array([[0, 7]])), section=SECTION),
        ["beam 200000", "7"],
    ),
    "mass on a node that is not there": (
        lambda: dataclasses.replace(sheet(), point_masses=lumped([99], [1.0])),
        ["lumped mass 900001", "99"],
    ),
    "node without element": (loose, ["node 10", "no stiffness"]),
    "two separate parts": (separate, ["2 parts", "not connected"]),
}


@pytest.mark.parametrize("name", list(BAD))
def test_unusable_model_is_refused_by_name(name):
    build, named = BAD[name]
    with pytest.raises(ModelError) as refusal:
        build_structure(build())
    for words in named:
        assert words in str(refusal.value)


def test_building_reports_progress_up_to_its_end():
    heard = []
    build_structure(sheet(), lambda _, share: heard.append(share))
    assert heard == sorted(heard)
    assert heard[-1] == 1.0
