"""Side-by-side measurements of the generated library against its peers: `python -m benchmarks`."""
