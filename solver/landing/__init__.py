"""The landing: rigid airframe on moving gears, from contact until it rolls."""
