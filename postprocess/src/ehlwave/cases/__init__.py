"""Cases and studies by the programs."""
