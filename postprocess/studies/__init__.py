"""Modules of this project's own studies: not installed, ``scripts/`` puts them on the path.

``programs`` runs the programs of the build, for the tests too; the others are one study each:

- ``paper``: cases, formulas and report of ``scripts/reproduce --full``, with ``experiment`` and
  ``two_waves``;
- ``error_time``, ``speed``, ``stability``, ``linearity``, ``microgeometry``, ``lambda_ratio``,
  ``validation``, ``accuracy``, ``all_keys``, ``periodic``, ``transients``, ``atlas``,
  ``many_ranks``, ``stress``, ``stress_speed``, ``starvation``, ``overrollings``, ``heavy``,
  ``heavy_draw``, ``heavy_refinement``, ``heavy_schemes``, ``peers``, ``peer_runs``,
  ``peer_slippy``, ``threads``, ``heat``, ``heat_map``, ``thinning``: one
  each;
- laws and their errors: ``heat_films``, ``inlet_law``, ``inlet_tables``, ``judged``, ``rolling``.

``command`` is ``scripts/study``, which runs them all. ``section`` holds what a report is made of,
``html`` its page, ``sweeps`` writes and reads sweeps, ``stages`` the files of a full study,
``folds`` has parts of points that are left out of fits, ``work_unit`` the unit of counted work,
``typed_keys`` writes the types of the program's keys.
"""
