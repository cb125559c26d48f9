"""Modules of this project's own studies: not installed, ``scripts/`` puts them on the path.

``programs`` runs the programs of the build, for the tests too; each other module is a study:

- ``paper``: cases, formulas and report of ``scripts/reproduce --full``, with ``experiment`` and
  ``two_waves``;
- accuracy and cost: ``accuracy``, ``all_keys``, ``answered``, ``budget``, ``calibrate``,
  ``elements``, ``error_time``, ``identified``, ``line_work``, ``speed``, ``threads``,
  ``stability``, ``touching``, ``touching_films``, ``touching_map``, ``touching_pair``,
  ``touching_steady``, ``peers`` with ``peer_runs`` and ``peer_slippy``;
- shipped data: ``atlas``, ``starvation``, ``heat``, ``heat_ends``, ``heat_films``,
  ``heated_contacts``, ``inlet_law``, ``inlet_tables``, ``judged``;
- published values that tests compare: ``published``, ``rolling``.

``command`` is ``scripts/study``, which runs them all. ``section`` holds the parts of a report,
``html`` its page, ``sweeps`` writes and reads sweeps, ``stages`` the files of a full study,
``folds`` has parts of points that are left out of fits, ``work_unit`` the unit of counted work,
``typed_keys`` writes the types of the program's keys, ``error_bars`` the errors of laws that follow
from records.
"""
