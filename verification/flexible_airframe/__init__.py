"""What the chapter on the flexible airframe computes."""
