"""What the scripts of pages are made of, and the protocol as data for them."""
