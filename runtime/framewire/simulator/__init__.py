"""Virtual devices: a line on which bytes take their time and faults happen, its ports, its time."""
