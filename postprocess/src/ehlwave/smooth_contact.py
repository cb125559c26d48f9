"""A smooth contact: its conditions, the atlas that answers for it, and its film."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlwave.contact.bodies import Body
from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.data_sheet import Oil as DataSheetOil
from ehlwave.contact.heat_data import Heat, heat_of
from ehlwave.contact.two_bodies import contact_keys
from ehlwave.errors import RangeError
from ehlwave.laws.answers import Film
from ehlwave.laws.atlas.atlas import Atlas, atlas_for, chart_of, load_atlas
from ehlwave.laws.atlas.chart import Chart
from ehlwave.laws.atlas_transfer import with_atlas_film, with_heated_film
from ehlwave.laws.film_answer import film_of
from ehlwave.laws.heated_contact import check_heat
from ehlwave.quantities import number
from ehlwave.shown import html_table, within

if TYPE_CHECKING:
    from typing_extensions import Self, Unpack

    from ehlwave.inputs.keys import ContactKeys
    from ehlwave.stress.loads import PoissonRatio


class SmoothContact:
    """What :class:`ehlwave.Contact` knows of its smooth bodies; its parameters are said there."""

    def __init__(
        self,
        *,
        atlas: str | Path | None = None,
        heat: Heat | None = None,
        **keys: Unpack[ContactKeys],
    ) -> None:
        """Check the keys and find M, L and D."""
        self.conditions: Conditions = conditions_from_keys(keys, "Contact", needs_lengths=False)
        self._atlas = None if atlas is None else Path(atlas)
        self._charts: dict[float, Chart] = {}
        stress = keys.get("eyring_stress_pa")
        self._eyring_stress_pa = None if stress is None else number(stress, "eyring_stress_pa")
        self._poisson_ratio: PoissonRatio | None = None
        self.heat = heat
        if heat is not None:
            check_heat(self.conditions, heat)

    @classmethod
    def from_bodies(
        cls,
        body1: Body,
        body2: Body,
        *,
        oil: DataSheetOil | None = None,
        atlas: str | Path | None = None,
        heat: Heat | bool | None = None,
        **keys: Any,  # noqa: ANN401
    ) -> Self:
        """Return the contact of two bodies, the rough one first.

        Reduced radii, reduced modulus, mean speed and slip follow from them (``src/theory.md``,
        section 1). Where both bodies are flat across rolling it is a line contact.

        Parameters
        ----------
        body1, body2 : Body
            The rough body, and the other one.
        oil : Oil, optional
            In place of ``viscosity_pa_s``, ``pressure_viscosity_per_pa`` and other keys of an oil.
        atlas : path, optional
            As of :class:`Contact`.
        heat : Heat or bool, optional
            True: film and friction with heat, by the own data of the oil and both bodies.
        **keys
            ``load_n``, of a line contact with ``length_m``, or ``load_n_per_m``;
            ``speeds_m_per_s``, those of both surfaces (u1, u2), or ``mean_speed_m_per_s`` with
            ``slide_to_roll_ratio``; the keys of the oil.

        Raises
        ------
        SurfaceError
            If something is missing, given twice, or makes no contact that the model has.

        Examples
        --------
        A steel ball on a glass disc, slide-to-roll ratio 0:

        >>> import ehlwave
        >>> ball = ehlwave.Body.ball(19.05e-3, material="steel")
        >>> disc = ehlwave.Body(material="glass")
        >>> oil = ehlwave.Oil.from_grade(iso_vg=100, viscosity_index=95, temperature_k=313.15)
        >>> contact = ehlwave.Contact.from_bodies(ball, disc, oil=oil, load_n=20,
        ...     speeds_m_per_s=(0.2, 0.2))
        >>> contact
        Contact(M=141.13, L=6.1412, D=1, S=1)

        A pair of rollers, sliding, with heat:

        >>> roller = ehlwave.Body(radius_x_m=0.02, material="steel")
        >>> oil = ehlwave.Oil.from_grade(iso_vg=46, temperature_k=333.15, eyring_stress_pa=5e6)
        >>> contact = ehlwave.Contact.from_bodies(roller, roller, oil=oil, load_n_per_m=4e5,
        ...     speeds_m_per_s=(11, 9), heat=True)
        >>> found = contact.film().heated
        >>> print(f"friction {found.friction:.3f} in place of {found.isothermal_friction:.3f}")
        friction 0.019 in place of 0.038
        """
        found, names = contact_keys(body1, body2, oil, keys)
        if heat is True:
            heat = heat_of(oil, (body1, body2))
        contact = cls(atlas=atlas, heat=None if heat is False else heat, **found)
        contact.conditions = replace(contact.conditions, names=tuple(names))
        contact._poisson_ratio = body1.poisson_ratio, body2.poisson_ratio  # type: ignore[assignment]
        return contact

    def __repr__(self) -> str:
        """Return M, L, D and S, of a starved contact r."""
        c = self.conditions
        r = f", r={c.oil_over_flooded:g}" if c.is_starved else ""
        return f"Contact(M={c.m:.5g}, L={c.l:.5g}, D={c.d:.5g}, S={c.slip_parameter:g}{r})"

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled: charts are looked up anew where they are needed."""
        return vars(self) | {"_charts": {}}

    def _shown_rows(self) -> dict[str, str]:
        """Return conditions, and the film where the atlas has it."""
        c = self.conditions
        rows = {"M, L, D, S": f"{c.m:.5g}, {c.l:.5g}, {c.d:.5g}, {c.slip_parameter:g}"}
        rows["oil"] = c.oil.name
        try:
            film = self.film()
        except RangeError as error:
            return rows | {"film": str(error)}
        if film.central_m is not None:
            rows["central film"] = within(film.central_m * 1e6, film.central_error, " um")
            if film.minimum_m is not None:
                rows["smallest film"] = within(film.minimum_m * 1e6, film.minimum_error, " um")
        else:
            rows["central film, Moes"] = within(film.central_moes, film.central_error)
            if math.isfinite(film.minimum_moes):
                rows["smallest film, Moes"] = within(film.minimum_moes, film.minimum_error)
        return rows | {"source": film.source}

    def _repr_html_(self) -> str:
        return html_table("Contact", self._shown_rows())

    def atlas(self) -> Atlas:
        """Return the atlas that answers are from.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...     radius_ratio_d=1)
        >>> contact.atlas().kind.name
        'rolling'
        """
        return atlas_for(self.conditions, self._own_atlas())

    def _own_atlas(self) -> Atlas | None:
        return None if self._atlas is None else load_atlas(self._atlas)

    def _chart(self, slip: float | None = None) -> Chart:
        """Return the responses of the contact, with another slip parameter where one is given."""
        own = self.conditions.slip_parameter if slip is None else slip
        if own not in self._charts:
            conditions = replace(self.conditions, slip_parameter=own)
            self._charts[own] = chart_of(conditions, self._own_atlas())
        return self._charts[own]

    def film(self) -> Film:
        """Return central and smallest film of the smooth contact, from the atlas.

        The central film of a starved contact is that of the atlas times R; the law knows no
        smallest film.

        With heat films and friction are those with heat; `Film.heated` says what heat does.

        A given film, ``central_film_m``, is that of the contact as it runs: it is returned as it
        is.

        Raises
        ------
        RangeError
            A ValueError: the contact lies outside the atlas, or with heat outside its laws.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
        ...     reduced_modulus_pa=2.26e11, load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
        >>> film = contact.film()
        >>> print(f"{film.central_m * 1e6:.2f} um within {film.central_error:.0%}")
        0.83 um within 1%
        """
        return film_of(self.conditions, self._chart, self.heat, self._eyring_stress_pa)


def conditions_with_film(contact: SmoothContact, *, or_formula: bool) -> Conditions:
    """Return conditions with the film of the atlas, with heat that of :meth:`SmoothContact.film`.

    Outside the atlas, without heat, the film is that of a formula where `or_formula`; otherwise
    raises RangeError there, and outside the laws of heat.
    """
    if contact.heat is not None:
        return with_heated_film(contact.conditions, contact.film())
    try:
        return with_atlas_film(contact.conditions, contact.atlas())
    except RangeError:
        if or_formula:
            return contact.conditions
        raise
