"""Recordings of a line: their files, their forms and their entries."""
