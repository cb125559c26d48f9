"""Published measurements and computations that tests compare: ``data``, read by ``values``.

``dimple`` runs the rolling dimple of Mourier and others (2006).
``films`` fits alpha to films of Dao (2018).
"""
