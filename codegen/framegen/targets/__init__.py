"""What framegen writes: one folder for each kind of output."""
