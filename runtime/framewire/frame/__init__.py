"""What a frame and its fields are: the classes that messages are made of, and their errors."""
