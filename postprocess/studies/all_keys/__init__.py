"""Whether numbers are what they say they are: random inputs over every key, and again on twice the cells."""
