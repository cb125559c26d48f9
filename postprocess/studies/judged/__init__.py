"""Laws of the package against the program: random contacts, and what laws take of them."""
