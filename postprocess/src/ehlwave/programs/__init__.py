"""The programs ``ehlwave-case`` and ``ehlwave-sweep`` from Python."""
