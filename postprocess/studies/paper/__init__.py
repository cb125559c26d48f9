"""The study of the paper in full: its cases, its formula, its experiment and the report on them."""
