"""The stability map: many contacts, mild to extreme, and the outcome of each."""
