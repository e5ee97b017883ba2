"""What real firmware is asked over a port, how its answers are judged, and how that is told."""
