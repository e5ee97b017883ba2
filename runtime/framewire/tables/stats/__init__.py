"""Count, measure and draw what a line carried."""
