"""Error against run time: run a table of cases, compare with a reference, fit models, draw.

``scripts/study error-vs-time`` is the command.
"""
