"""The search of a site: all that can be found, and where it stands."""
