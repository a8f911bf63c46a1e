"""What a recorder shows after a contact, held against the simulated landing, corrects its state."""
