"""The command ``scripts/study``: every study with its options, steps and output.

Needs the standard library alone, so that help and the refusal of bad options need nothing else. The
steps of a study are commands: ``scripts/build``, ``scripts/run-sweep``, ``python -m studies.NAME``.
"""
