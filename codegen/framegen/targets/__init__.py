"""The targets: one folder for each kind of output."""
