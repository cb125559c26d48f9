"""Published measurements and computations beside this program: ``scripts/study validation``.

``published`` reads the data. ``page`` puts together the sections ``dimple_section``,
``line_section``, ``film_section`` and ``printed``; each runs in a folder what is not there yet.
"""
