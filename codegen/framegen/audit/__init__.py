"""Hold recordings of a line against a spec: what it covers, what fits nothing, what it settles."""
