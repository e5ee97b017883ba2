"""Frames with checksums: one protocol for each kind of sum, each with the peers that speak it."""
