"""Random machine elements over the range of catalogues: how many contacts have an answer."""
