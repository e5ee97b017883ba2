"""Write the tables of a capture to one file, or to one for each table."""
