"""What this project's own studies need: not installed, ``scripts/`` puts it on the path.

``programs`` runs the programs of the build, for the tests too; the others are one study each:

- ``paper``: cases, formulas and report of ``scripts/reproduce --full``, with ``experiment``;
- ``error_time``, ``speed``, ``stability``, ``linearity``, ``microgeometry``, ``validation``: the
  scripts of the same names. ``section`` holds what a report is made of.
"""
