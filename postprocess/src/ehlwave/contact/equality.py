"""Equality of frozen dataclasses whose numbers may be unknown (NaN)."""

from dataclasses import fields


def equal_fields(self: object, other: object) -> bool:
    """Return whether two objects of a dataclass have equal fields, the same NaN included.

    From Python 3.13 on, the method that ``dataclass`` makes compares field by field, so that an
    object with NaN differs from its copy, and from itself.
    """
    if other.__class__ is not self.__class__:
        return NotImplemented
    names = [one.name for one in fields(self) if one.compare]  # type: ignore[arg-type]
    mine, others = ([getattr(one, name) for name in names] for one in (self, other))
    return mine == others
