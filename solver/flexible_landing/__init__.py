"""The landing with a flexible airframe, coupled both ways to its gears."""
