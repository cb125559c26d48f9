"""The contact that a law is asked about."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from ehlwave.laws.atlas.atlas import Atlas, atlas_for, chart_of

if TYPE_CHECKING:
    from ehlwave.contact.conditions import Conditions
    from ehlwave.contact.heat_data import Heat
    from ehlwave.laws.answers import Film
    from ehlwave.laws.atlas.chart import Chart
    from ehlwave.laws.table import HarmonicTable


@dataclass(frozen=True)
class Asked:
    """A contact with everything that laws depend on.

    Attributes
    ----------
    conditions : Conditions
        Operating point; S belongs to the surface that carries the waves.
    heat : Heat or None
        Thermal data of oil and bodies; None: isothermal.
    own_atlas : Atlas or None
        An atlas in place of the shipped atlas.
    eyring_stress_pa : float or None
        Eyring stress of a Ree-Eyring oil, Pa.
    table : HarmonicTable or None
        Harmonic table that answers for waves.
    coefficients : tuple or None
        c1, c2 and name of the formula of the paper with coefficients of its own.
    films : dict
        Films that were found, by the law asked for: a question is asked once.
    """

    conditions: Conditions
    heat: Heat | None = None
    own_atlas: Atlas | None = None
    eyring_stress_pa: float | None = None
    table: HarmonicTable | None = None
    coefficients: tuple[float, float, str] | None = None
    films: dict[str | None, Film] = field(default_factory=dict, compare=False, repr=False)

    def at_slip(self, slip: float) -> Asked:
        """Return the same contact with another slip parameter."""
        return self.of(replace(self.conditions, slip_parameter=slip))

    def of(self, conditions: Conditions) -> Asked:
        """Return the same question about other conditions."""
        return replace(self, conditions=conditions, films={})

    def cold(self) -> Asked:
        """Return the same question without heat."""
        return self if self.heat is None else replace(self, heat=None, films={})

    def chart(self, slip: float | None = None) -> Chart:
        """Return the chart of the atlas, optionally at another slip parameter.

        Raises RangeError outside the atlas.
        """
        c = self.conditions
        return _chart(replace(c, slip_parameter=c.slip_parameter if slip is None else slip), self)

    def atlas(self) -> Atlas:
        """Return the atlas for the contact, which need not hold it."""
        return atlas_for(self.conditions, self.own_atlas)


def _chart(conditions: Conditions, asked: Asked) -> Chart:
    return _known_chart(conditions, conditions.names, conditions.given, asked.own_atlas)


@lru_cache(maxsize=32)
def _known_chart(
    conditions: Conditions, names: object, given: object, own_atlas: Atlas | None
) -> Chart:
    """Return a chart; names and given keys count, because messages use them."""
    return chart_of(conditions, own_atlas)
