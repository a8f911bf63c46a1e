"""Where to look: the worst element of every zone, ranked by how much of its allowable it used."""

import numpy as np

from solver.aircraft.assessed_airframe import AssessedAirframe
from solver.assessment import HotSpot, PeakField

#: Bulk-data card of an element with so many corners.
_CARDS = {4: "CQUAD4", 3: "CTRIA3", 2: "CBAR"}


def rank_hot_spots(
    airframe: AssessedAirframe, peaks: PeakField, count: int = 12
) -> tuple[HotSpot, ...]:
    """Worst element of each zone, most used first.

    One line per zone, because an inspector is sent to a zone, not to an element; the neighbours of
    the worst element would otherwise fill the list.

    Parameters
    ----------
    airframe : AssessedAirframe
        Gives every element its zone, position and allowable.
    peaks : PeakField
        Peak of every element over the landing.
    count : int
        How many zones to report.
    """
    zones = airframe.definition.zones
    # Stable order: by zone, then by falling use; the first of each zone is its worst.
    order = np.lexsort((-peaks.utilisation, airframe.element_zone))
    _, first = np.unique(airframe.element_zone[order], return_index=True)
    worst = order[first]
    worst = worst[np.argsort(-peaks.utilisation[worst], kind="stable")][:count]
    spots = []
    for rank, row in enumerate(worst.tolist(), start=1):
        zone = zones[int(airframe.element_zone[row])]
        x, y, z = (float(c) for c in airframe.centroids[row])
        used = float(peaks.utilisation[row])
        spots.append(
            HotSpot(
                rank=rank,
                component=zone.component,
                zone=zone.name,
                side=zone.side,
                element=int(peaks.element_identifiers[row]),
                element_kind=_CARDS[int(airframe.element_corners[row])],
                position=(x, y, z),
                peak_stress=float(peaks.stress[row]),
                allowable=float(airframe.allowables[row]),
                utilisation=used,
                margin=1.0 / used - 1.0 if used > 0.0 else float("inf"),
                time=float(peaks.time[row]),
                contact=int(peaks.contact[row]),
                ata_chapter=zone.ata_chapter,
                inspection=zone.look_for,
            )
        )
    return tuple(spots)
