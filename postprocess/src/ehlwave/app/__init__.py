"""A page for people without Python: ``ehlwave app``.

:mod:`ehlwave.app.task` answers without a page; everything that shows something needs Panel, the
extra ``app`` of this package.
"""
