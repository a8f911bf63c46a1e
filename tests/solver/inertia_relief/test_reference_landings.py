"""Reference landings fill the range of touchdowns and loadings."""

import numpy as np

from solver.inertia_relief.reference_landings import COUNT, RANGES, reference_contacts


def test_every_variable_and_every_fill_is_spread_evenly() -> None:
    contacts = reference_contacts(5)
    assert len(contacts) == COUNT
    low, high = np.array(RANGES).T
    values = np.array(
        [
            [
                contact.sink_rate,
                contact.ground_speed,
                *np.degrees([contact.pitch, contact.roll, contact.drift]),
                *np.degrees([contact.pitch_rate, contact.roll_rate, contact.yaw_rate]),
            ]
            for contact, _ in contacts
        ]
    )
    shares = np.hstack([(values - low) / (high - low), [fills for _, fills in contacts]])
    assert np.all((shares >= 0.0) & (shares <= 1.0))
    # a quarter of the points in every quarter, within what a sequence to the base 41 leaves
    for column in shares.T:
        counts = np.histogram(column, bins=4, range=(0.0, 1.0))[0]
        assert np.all(np.abs(counts - COUNT / 4) <= 0.4 * COUNT / 4)
