"""The envelope of an aircraft: how much of its limits a landing uses, known before it is solved."""
