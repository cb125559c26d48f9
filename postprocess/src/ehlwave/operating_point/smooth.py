"""A smooth contact: its conditions, the atlas that answers for it, and its film."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlwave.choices import FILM_BY, HOW, LAWS, chosen_or_none
from ehlwave.contact.bodies import Body
from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.data_sheet import Oil as DataSheetOil
from ehlwave.contact.heat_data import Heat, heat_of
from ehlwave.contact.two_bodies import contact_keys
from ehlwave.errors import RangeError
from ehlwave.inputs.slip import RATIO, SLIP
from ehlwave.laws.answers import Film
from ehlwave.laws.asked import Asked
from ehlwave.laws.atlas.atlas import Atlas, load_atlas
from ehlwave.laws.film_answer import with_film
from ehlwave.laws.heated_contact import check_heat
from ehlwave.laws.law_list import film_for, transfer_for
from ehlwave.laws.notices import warn
from ehlwave.laws.transfer import Transfer
from ehlwave.operating_point.shown_rows import shown_rows
from ehlwave.quantities import number
from ehlwave.shown import Shown

if TYPE_CHECKING:
    import pandas as pd
    from typing_extensions import Self, Unpack

    from ehlwave.inputs.keys import ContactKeys
    from ehlwave.laws.table import HarmonicTable
    from ehlwave.stress.loads import PoissonRatio


class SmoothContact(Shown):
    """Smooth bodies of :class:`ehlwave.Contact`, whose documentation lists its parameters."""

    def __init__(
        self,
        *,
        atlas: str | Path | None = None,
        heat: Heat | None = None,
        table: str | Path | pd.DataFrame | HarmonicTable | None = None,
        **keys: Unpack[ContactKeys],
    ) -> None:
        """Check the keys and find M, L and D."""
        self._keys = dict(keys)
        self._given: Conditions = conditions_from_keys(keys, "Contact", needs_lengths=False)
        self._atlas = None if atlas is None else Path(atlas)
        stress = keys.get("eyring_stress_pa")
        self._eyring_stress_pa = None if stress is None else number(stress, "eyring_stress_pa")
        self._poisson_ratio: PoissonRatio | None = None
        self._heat = heat
        self._table: HarmonicTable | None = None
        if table is not None:
            from ehlwave.laws.table import harmonic_table_of

            self._table = harmonic_table_of(table)
        self._questions: dict[float | None, Asked] = {}
        self._transfers: dict[tuple[float | None, str | None], Transfer] = {}
        if heat is not None:
            check_heat(self._given, heat)

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse changes: results of a contact would remain beside data of another."""
        if not name.startswith("_"):
            raise AttributeError(
                f"Contact.{name} = {value!r}: a contact does not change; "
                f"contact.replace({name}=...) returns a new contact"
            )
        super().__setattr__(name, value)

    @property
    def heat(self) -> Heat | None:
        """Thermal data of oil and bodies; None: isothermal.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...     radius_ratio_d=1)
        >>> contact.heat is None
        True
        """
        return self._heat

    @property
    def conditions(self) -> Conditions:
        """Operating conditions, with the central film that :meth:`film` returns.

        Where no law holds the film is unknown, None, until :meth:`film` has computed it.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...     radius_ratio_d=1)
        >>> contact.conditions.m
        100.0
        """
        if self._given.has_given_film or self._given.metres_per_moes is None:
            return self._given
        films = self._asked().films
        known = films.get(None) or films.get("computed")
        try:
            return with_film(self._given, known or self._film("laws"))
        except RangeError:
            return replace(
                self._given,
                central_film_m=None,
                film_source="no law holds: film() computes it",
                central_film_error=None,
            )

    def replace(self, **changes: Any) -> Self:  # noqa: ANN401
        """Return another contact, with some keys changed.

        Parameters
        ----------
        **changes
            Keys as of :class:`ehlwave.Contact`, ``heat``, ``atlas`` or ``table``; None removes
            a key.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...     radius_ratio_d=1)
        >>> contact.replace(load_parameter_m=200)
        Contact(M=200, L=10, D=1, S=1)
        """
        own: dict[str, Any] = {"heat": self._heat, "atlas": self._atlas}
        own |= {"table": self._table, **self._keys}
        if RATIO in changes:
            own.pop(SLIP, None)
        if SLIP in changes:
            own.pop(RATIO, None)
        found = type(self)(**{k: v for k, v in (own | changes).items() if v is not None})
        found._poisson_ratio = self._poisson_ratio
        return found

    @classmethod
    def from_bodies(
        cls,
        body1: Body,
        body2: Body,
        *,
        oil: DataSheetOil | None = None,
        atlas: str | Path | None = None,
        heat: Heat | bool | None = None,
        table: str | Path | pd.DataFrame | HarmonicTable | None = None,
        **keys: Any,  # noqa: ANN401
    ) -> Self:
        """Return the contact of two bodies, the rough body first.

        Reduced radii, reduced modulus, mean speed and slip follow from them (``src/theory.md``,
        section 1). Where both bodies are flat across rolling it is a line contact.

        Parameters
        ----------
        body1, body2 : Body
            The rough body, and the second.
        oil : Oil, optional
            In place of ``viscosity_pa_s``, ``pressure_viscosity_per_pa`` and other keys of an oil.
        atlas : path, optional
            As of :class:`Contact`.
        heat : Heat or bool, optional
            True: film and friction with heat, by the own data of the oil and both bodies.
        table : path or DataFrame, optional
            Harmonic table that answers for waves, as of :class:`Contact`.
        **keys
            ``load_n``, for a line contact with ``length_m``, or ``load_n_per_m``;
            ``speeds_m_per_s``, of both surfaces (u1, u2), or ``mean_speed_m_per_s`` with
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
        contact = cls(atlas=atlas, heat=None if heat is False else heat, table=table, **found)
        contact._given = replace(contact._given, names=tuple(names))
        contact._poisson_ratio = body1.poisson_ratio, body2.poisson_ratio  # type: ignore[assignment]
        return contact

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for pickling, without values that are recomputed when needed."""
        return vars(self) | {"_questions": {}, "_transfers": {}}

    def __repr__(self) -> str:
        """Return M, L, D and S, of a starved contact r."""
        c = self._given
        r = f", r={c.oil_over_flooded:g}" if c.is_starved else ""
        return f"Contact(M={c.m:.5g}, L={c.l:.5g}, D={c.d:.5g}, S={c.slip_parameter:g}{r})"

    def _shown_rows(self) -> dict[str, str]:
        """Return conditions, and the film where the atlas has it."""
        try:
            return shown_rows(self._given, self._film("laws"))
        except RangeError as error:
            return shown_rows(self._given, None) | {"film": str(error)}

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
        return self._asked().atlas()

    def _asked(self, slip: float | None = None) -> Asked:
        """Return the contact as input of laws, optionally at another slip."""
        if slip not in self._questions:
            c = self._given if slip is None else replace(self._given, slip_parameter=slip)
            atlas = None if self._atlas is None else load_atlas(self._atlas)
            own = atlas, self._eyring_stress_pa, self._table
            self._questions[slip] = Asked(c, self._heat, *own)
        return self._questions[slip]

    def _transfer(self, slip: float | None, by: str | None) -> Transfer:
        chosen_or_none(by, "by", (*LAWS, *HOW))
        key = slip, by
        if key not in self._transfers:
            self._transfers[key] = transfer_for(self._asked(slip), by)
        return self._transfers[key]

    def _film(self, by: str | None) -> Film:
        return film_for(self._asked(), by)

    def film(self, by: str | None = None) -> Film:
        """Return central and smallest film of the smooth contact, and its friction.

        The first law that holds answers: the atlas, with the laws of heat and of starved contacts.
        Where none holds, ``ehlwave-case`` computes the contact, if it is installed. A given film,
        ``central_film_m``, is returned as it is.

        Parameters
        ----------
        by : {"laws", "computed"}, optional
            "laws": nothing is computed; "computed": the program answers.

        Raises
        ------
        RangeError
            A ValueError: no law holds, and the program is not installed or not asked.

        Warns
        -----
        ExtrapolationWarning
            If the inlet warms and the contact has no heat data, or an error exceeds 30 %.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
        ...     reduced_modulus_pa=2.26e11, load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
        >>> film = contact.film()
        >>> print(f"{film.central_m * 1e6:.2f} um within {film.central_error:.0%}")
        0.83 um within 1%
        """
        chosen_or_none(by, "by", FILM_BY)
        found = self._film(by)
        warn(found.warnings)
        return found
