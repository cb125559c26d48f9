"""Laws of the package against the program: random contacts, and the input of the laws."""
