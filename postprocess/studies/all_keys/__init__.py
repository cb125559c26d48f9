"""Whether numbers are what they say they are: random inputs, again on twice the cells."""
