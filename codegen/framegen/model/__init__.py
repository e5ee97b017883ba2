"""The model that follows from a spec: roles, layouts, sizes, exchanges; and the reference codec."""
