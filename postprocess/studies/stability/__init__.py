"""The stability map: many contacts, mild to extreme, and what became of each."""
