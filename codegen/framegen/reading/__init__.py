"""The only room that knows YAML: the text of a spec, its values, and where each of them stands."""
