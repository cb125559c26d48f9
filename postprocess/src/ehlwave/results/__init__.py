"""Results of the programs: reading, tables, figures, fits, export."""
