"""The aircraft: definition file, bulk data, mass states, air loads, and the example business jet."""
