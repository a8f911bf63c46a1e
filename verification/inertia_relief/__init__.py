"""Free bodies with closed forms, and what extended inertia relief makes of them."""
