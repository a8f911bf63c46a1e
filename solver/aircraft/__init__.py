"""The aircraft: definition file, bulk data, mass states, air loads, the example jet."""
