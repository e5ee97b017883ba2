"""Find frames and noise at many places of raw bytes at once."""
