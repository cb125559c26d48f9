"""Input files of the programs: their keys, and their use in predictions."""
