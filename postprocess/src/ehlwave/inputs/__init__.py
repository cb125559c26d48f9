"""Input files of the programs: their keys, and what predictions do with them."""
