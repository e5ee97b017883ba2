"""The only package that knows YAML: the text of a spec, its values, and the position of each."""
