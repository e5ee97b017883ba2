"""What follows from a spec: roles, places, sizes, exchanges; and the reference codec."""
