"""Buckling of the panels that elements are: flat, simply supported, in closed form.

At full size one shell element spans one bay between stiffeners.  Under compressions s_x, s_y and
shear s_xy a panel a x b of thickness t buckles at the smallest factor f of its stresses with

    direct:   f_d = min over m, n of  pi^2 D / t (m^2/a^2 + n^2/b^2)^2 / (s_x m^2/a^2 + s_y n^2/b^2)
    shear:    f_s = k pi^2 D / (b^2 t) / s_xy,   k = 5.34 + 4 (b/a)^2,   b <= a
    both:     f / f_d + (f / f_s)^2 = 1

Curvature and clamped edges, which would help, are left out: the elements are flat, too, and the
nonlinear reference knows no more than they do.

Source: S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd edition 1961, sections 9.4
(two directions), 9.7 (shear) and 9.8 (both).
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.fe.model import FiniteElementModel
from solver.fe.sections import ShellSections, shell_sections

#: Half waves along each side that are looked at.
HALF_WAVES = 5


@dataclass(frozen=True, slots=True)
class Panels:
    """Panels of all shells, in the solver's element order; each field (m,)."""

    length: Array  #: a, along the element's first axis [m]
    width: Array  #: b, across it [m]
    bending: Array  #: pi^2 D / t [N/m]

    def utilisation(self, stresses: Array) -> Array:
        """Reciprocal of the critical factor under mid-surface stresses (m, 3, nt) [Pa]; (m, nt)."""
        x, y, shear = -stresses[:, 0], -stresses[:, 1], np.abs(stresses[:, 2])
        along, across = self.length**-2.0, self.width**-2.0
        direct = np.zeros_like(x)
        for m in range(1, HALF_WAVES + 1):
            for n in range(1, HALF_WAVES + 1):
                p, q = m * m * along, n * n * across
                hold = self.bending * (p + q) ** 2
                np.maximum(direct, (p / hold)[:, None] * x + (q / hold)[:, None] * y, out=direct)
        short, long = np.minimum(self.length, self.width), np.maximum(self.length, self.width)
        hold = (5.34 + 4.0 * (short / long) ** 2) * self.bending / short**2
        sheared = shear / hold[:, None]
        # f / f_d + (f / f_s)^2 = 1, solved for 1 / f
        both: Array = direct / 2 + np.sqrt(direct**2 / 4 + sheared**2)
        return both


def panels(model: FiniteElementModel) -> Panels:
    """Panels of a model; triangles count as the rectangle around them."""
    lengths, widths, bending = [], [], []
    for shells in (model.quads, model.triangles):
        corners = model.coordinates[shells.nodes]
        if shells.nodes.shape[1] == 4:
            x1, x2, x3, x4 = (corners[:, k] for k in range(4))
            # element axes run along the bisector from side 4-1 to side 2-3
            along = np.linalg.norm((x2 + x3) - (x1 + x4), axis=1) / 2
            across = np.linalg.norm((x3 + x4) - (x1 + x2), axis=1) / 2
        else:
            along = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
            normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            across = np.linalg.norm(normal, axis=1) / along
        lengths.append(along)
        widths.append(across)
        bending.append(_bending(shell_sections(model, shells)))
    return Panels(np.concatenate(lengths), np.concatenate(widths), np.concatenate(bending))


def _bending(sections: ShellSections) -> Array:
    stiffness: Array = (
        np.pi**2 * sections.young_modulus * sections.thickness**2
        / (12.0 * (1.0 - sections.poisson_ratio**2))
    )  # fmt: skip
    return stiffness
