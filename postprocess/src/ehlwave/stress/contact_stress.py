"""Entry point: the stresses below a contact with measured surfaces."""

from pathlib import Path
from typing import Any, Protocol

import xarray as xr
from numpy.typing import ArrayLike

from ehlwave.choices import FILM_BY, POISSON_RATIO
from ehlwave.contact.conditions import Conditions
from ehlwave.errors import RangeError
from ehlwave.stress.loads import PoissonRatio
from ehlwave.stress.rough import RoughStress, rough_stress
from ehlwave.surface.pair import DeformedPair
from ehlwave.surface.predict import Deformed
from ehlwave.surface.raw_surface import SurfaceSource
from ehlwave.surface.surface import Surface

UNKNOWN_FRICTION = (
    "friction is not known for this oil and slip: stresses are without it; give friction=, the "
    "traction over the pressure"
)


class SmoothFilm(Protocol):
    """A film with a friction, if known; :class:`ehlwave.Film` is an example."""

    @property
    def friction(self) -> float | None:
        """Friction coefficient."""


class OperatingPoint(Protocol):
    """Interface of a contact for stresses, as :class:`ehlwave.Contact`."""

    @property
    def conditions(self) -> Conditions:
        """Operating conditions of the contact."""

    def deform(self, surface: Surface | SurfaceSource, **options: Any) -> Deformed:  # noqa: ANN401
        """Return a measured surface as it is inside the contact."""

    def deform_pair(
        self,
        surface: Surface | SurfaceSource,
        second: Surface | SurfaceSource,
        **options: Any,  # noqa: ANN401
    ) -> DeformedPair:
        """Return two measured surfaces as they are inside the contact."""

    def film(self, by: str | None = None) -> SmoothFilm:
        """Return the film of the smooth contact."""


def stress_of_contact(
    contact: OperatingPoint,
    surface: Surface | SurfaceSource,
    second: Surface | SurfaceSource | None = None,
    *,
    friction: float | None = None,
    cycles: float = 1e8,
    poisson_ratio: PoissonRatio = POISSON_RATIO,
    depths_m: ArrayLike | None = None,
    smooth: xr.Dataset | str | Path | None = None,
    **deforming: Any,  # noqa: ANN401
) -> RoughStress:
    """Return the stresses below both bodies of a contact with one or two measured surfaces.

    Parameters
    ----------
    contact : Contact
        Its slip parameter belongs to the first surface.
    surface, second : Surface, path, array or topography
        Rough surface of the first body, and of the second, which is smooth by default.
    friction : float, optional
        Traction over pressure; otherwise the atlas value where known.
    cycles, poisson_ratio, depths_m, smooth
        As of :func:`ehlwave.stress.rough.rough_stress`.
    **deforming
        As of :meth:`ehlwave.Contact.deform`.
    """
    if second is None:
        deformed = [contact.deform(surface, **deforming)]
    else:
        pair = contact.deform_pair(surface, second, **deforming)
        deformed = [pair.first, pair.second]
    notes = []
    if friction is None:
        friction = _friction(contact, deforming.get("by"))
        if friction is None:
            notes.append(UNKNOWN_FRICTION)
    result = rough_stress(
        deformed, 0.0 if friction is None else friction, cycles, poisson_ratio, depths_m, smooth
    )
    result.warnings.extend(notes)
    return result


def _friction(contact: OperatingPoint, by: str | None) -> float | None:
    """Return the friction coefficient by the law asked for; 0 in pure rolling, None: not known."""
    if contact.conditions.rolls:
        return 0.0
    try:
        return contact.film(by if by in FILM_BY else None).friction
    except RangeError:
        return None
