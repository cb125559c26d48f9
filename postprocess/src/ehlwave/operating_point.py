"""The one call: a contact, its film, its responses to waves, surfaces inside it."""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlwave.answers import Film, Response
from ehlwave.atlas.atlas import Atlas, atlas_for, chart_of, load_atlas
from ehlwave.atlas.chart import Chart
from ehlwave.choices import WINDOWS, chosen
from ehlwave.contact.bodies import Body
from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.conditions_read import Given
from ehlwave.contact.data_sheet import Oil as DataSheetOil
from ehlwave.contact.heat_data import Heat, heat_of
from ehlwave.contact.two_bodies import contact_keys
from ehlwave.deform.atlas_transfer import with_atlas_film, with_heated_film
from ehlwave.deform.pair import DeformedPair
from ehlwave.deform.predict import Cutoffs, Deformed, deform_surface
from ehlwave.deform.prepare import Form, Window
from ehlwave.deform.raw_surface import SurfaceSource
from ehlwave.deform.read import ReadOptions, read_surface
from ehlwave.deform.sliding import second_conditions
from ehlwave.deform.surface import Surface
from ehlwave.deform.transfer import Transfer
from ehlwave.deform.transfer_choice import transfer_of
from ehlwave.errors import ExtrapolationWarning, RangeError, SurfaceError
from ehlwave.film_answer import film_of
from ehlwave.heat_laws import check_heat
from ehlwave.quantities import number
from ehlwave.response_answer import response_of
from ehlwave.responses import response_table, responses_figure
from ehlwave.shown import html_table, within
from ehlwave.slip import slip_given

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ehlwave.keys import ContactKeys
    from ehlwave.stress.loads import PoissonRatio
    from ehlwave.stress.rough import RoughStress


class Contact:
    """A lubricated contact of smooth bodies, one of which is rough or wavy.

    Parameters
    ----------
    atlas : path, optional
        Another atlas file than that of the package.
    heat : Heat, optional
        How oil and bodies conduct and store heat: film and friction are those with heat, by the
        laws of :mod:`ehlwave.heat_laws`. Waves stay isothermal, over the film with heat.
    **keys
        Keys of the input files of ``ehlwave-case``: dimensional data (``radius_x_m``,
        ``radius_y_m``, ``reduced_modulus_pa``, ``load_n``, ``mean_speed_m_per_s``,
        ``viscosity_pa_s``; of a line contact ``load_n_per_m`` in place of ``radius_y_m`` and
        ``load_n``), or ``load_parameter_m``, ``lubricant_parameter_l`` and ``radius_ratio_d`` (0:
        line contact), then with ``semi_axis_a_m`` (Hertz semi-axis along rolling) and
        ``radius_x_m`` where metres are asked for;
        ``pressure_viscosity_per_pa`` (2.2e-8) and ``roelands_index`` (0.68) of the oil;
        ``slip_parameter`` (1) of the rough surface, or ``slide_to_roll_ratio`` (0); of a Ree-Eyring
        oil ``eyring_stress_pa``; relative errors of the oil, ``viscosity_error`` and
        ``pressure_viscosity_error``, which films carry. ``oil_over_flooded``, r, of a starved
        contact that rolls: film and waves by the laws of :mod:`ehlwave.starvation`. Plain numbers
        are SI; quantities of pint are converted. From two bodies: :meth:`from_bodies`.

    Raises
    ------
    SurfaceError
        If a key is unknown, missing or makes no sense.
    RangeError
        A ValueError: a starved contact lies outside the range of its law.

    Examples
    --------
    >>> import ehlwave
    >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1)
    >>> response = contact.response(wavelength_over_a=0.5)
    >>> print(f"Ad/Ai = {abs(response.film):.2f} within {response.error:.2f}")
    Ad/Ai = 0.92 within 0.01

    Half the oil that the flooded contact passes:

    >>> starved = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
    ...     radius_ratio_d=1, oil_over_flooded=0.5)
    >>> film, response = starved.film(), starved.response(wavelength_over_a=0.5)
    >>> print(f"Hc = {film.central_moes:.2f} within {film.central_error:.0%}")
    Hc = 1.89 within 4%
    >>> print(f"Ad/Ai = {abs(response.film):.2f} within {response.error:.2f}")
    Ad/Ai = 0.54 within 0.11
    """

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
    ) -> Contact:
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
        friction 0.018 in place of 0.038
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
        return self._atlas_for(self.conditions)

    def _atlas_for(self, conditions: Conditions) -> Atlas:
        return atlas_for(conditions, self._own_atlas())

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

    def response(
        self,
        wavelength_over_a: float,
        angle_deg: float = 0.0,
        slip_parameter: float | None = None,
        slide_to_roll_ratio: float | None = None,
    ) -> Response:
        """Return the response at the contact centre to small waves, from the atlas.

        Parameters
        ----------
        wavelength_over_a : float
            Wavelength along the wave vector over the Hertz semi-axis a, 0.1 to 4.
        angle_deg : float
            Between wave vector and rolling direction, in metres: 0 transverse, 90 longitudinal.
            Line contacts answer for 0 alone.
        slip_parameter : float, optional
            S of the surface that carries the waves, 0 to 2; that of the contact if absent. Other
            than 1 the atlas has it for a Ree-Eyring oil, of ``eyring_stress_pa``. Outside that, for
            a Carreau oil (``carreau_modulus_pa``, ``carreau_exponent``) and for a Newtonian one the
            law of the two waves answers for S of 0.5 to 1.5 in the contacts of its fit, with an
            error to match and without pressure (NaN); of line contacts the atlas alone answers.
            Longitudinal waves stand still: the atlas of pure rolling answers. Starved contacts
            roll; their law answers without phase and without pressure.
        slide_to_roll_ratio : float, optional
            In place of `slip_parameter`, S = 1 + ratio/2.

        Raises
        ------
        RangeError
            A ValueError: the contact, the wave or the slip lies outside the atlas; nothing is
            extrapolated.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...     radius_ratio_d=1)
        >>> for angle in (0, 45, 90):
        ...     print(angle, f"{abs(contact.response(0.5, angle_deg=angle).film):.2f}")
        0 0.92
        45 0.78
        90 0.65
        """
        slip_parameter = slip_given(slip_parameter, slide_to_roll_ratio, "response")
        wavelength_over_a = number(wavelength_over_a, "wavelength_over_a")
        angle_deg = number(angle_deg, "angle_deg")
        if not -1e-9 <= angle_deg <= 90 + 1e-9:
            raise RangeError(
                f"angle_deg = {angle_deg:.5g} lies outside 0 to 90 (waves at -angle are the same)"
            )
        if slip_parameter is None:
            slip_parameter = self.conditions.slip_parameter
        conditions = replace(self.conditions, slip_parameter=slip_parameter)
        wave = wavelength_over_a, angle_deg
        return response_of(conditions, *wave, self._chart, self._own_atlas())

    def responses(
        self,
        wavelength_over_a: ArrayLike | None = None,
        angle_deg: ArrayLike | None = None,
        slip_parameter: float | None = None,
        slide_to_roll_ratio: float | None = None,
    ) -> xr.Dataset:
        """Return the responses to every combination of wavelengths and angles, with their errors.

        Parameters
        ----------
        wavelength_over_a : array_like, optional
            As of :meth:`response`; 41 from 0.1 to 4 if absent.
        angle_deg : array_like, optional
            As of :meth:`response`; 0, 45 and 90 if absent.
        slip_parameter, slide_to_roll_ratio : float, optional
            As of :meth:`response`.

        Returns
        -------
        xarray.Dataset
            Over ``wavelength`` and ``angle``: ``film_real``, ``film_imag``, ``film_amplitude``,
            ``film_phase``, ``film_error``, ``pressure_real``, ``pressure_imag``, with units and
            long names. ``is_inside`` is False where a wave lies outside the atlas, or the law of
            starved contacts; there is NaN. Of starved contacts amplitude and error alone are known.

        Raises
        ------
        RangeError
            A ValueError: the contact or the slip lies outside the atlas.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...     radius_ratio_d=1)
        >>> found = contact.responses([0.5, 1, 9], angle_deg=[0, 90])
        >>> found["film_amplitude"].values.round(2).tolist()
        [[0.92, 0.65], [0.68, 0.39], [nan, nan]]
        >>> found["is_inside"].values.all(axis=1).tolist()
        [True, True, False]
        """
        waves, angles = wavelength_over_a, angle_deg
        slip_parameter = slip_given(slip_parameter, slide_to_roll_ratio, "responses")
        return response_table(self.response, self.conditions, waves, angles, slip_parameter)

    def plot(
        self,
        wavelength_over_a: ArrayLike | None = None,
        angle_deg: ArrayLike | None = None,
        slip_parameter: float | None = None,
        slide_to_roll_ratio: float | None = None,
    ) -> Figure:
        """Draw the responses against wavelength, a curve an angle; bands are errors.

        Parameters
        ----------
        wavelength_over_a, angle_deg, slip_parameter, slide_to_roll_ratio
            As of :meth:`responses`.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...     radius_ratio_d=1)
        >>> figure = contact.plot()
        >>> [axes.get_ylabel() for axes in figure.axes][1]
        'lag of the film [degrees]'
        """
        slip_parameter = slip_given(slip_parameter, slide_to_roll_ratio, "plot")
        return responses_figure(self.responses(wavelength_over_a, angle_deg, slip_parameter))

    def transfer(self, by: str = "atlas") -> Transfer:
        """Return what gives the response of each component of a surface.

        Parameters
        ----------
        by : {"atlas", "two-waves", "recommended", "paper"}
            The atlas, or a law. Under slip the law of the two waves stands for the atlas where the
            oil is not Ree-Eyring's. That of starved contacts stands for all of them where
            ``oil_over_flooded`` is given; naming another one is an error then.

        Raises
        ------
        RangeError
            A ValueError: the contact lies outside the atlas.
        SurfaceError
            If there is no such law, or that of the two waves were to judge a line contact.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...     radius_ratio_d=1)
        >>> contact.transfer("paper").name
        'formula of Venner et al. (2000)'
        """
        return transfer_of(self.conditions, by, self._own_atlas())

    def deform(
        self,
        surface: Surface | SurfaceSource,
        by: str = "atlas",
        form: Form = "plane",
        ends: Window = "mirror",
        cutoffs_m: Cutoffs = (None, None),
        **reading: Any,  # noqa: ANN401
    ) -> Deformed:
        """Predict the shape of a measured surface inside the contact, and the film over it.

        Parameters
        ----------
        surface : Surface, path, array or topography
            As :func:`ehlwave.read_surface` reads it; of an array give ``step``, in metres.
        by : {"atlas", "two-waves", "recommended", "paper"}
            What components are judged by. The film is the atlas' where the contact lies in it, with
            heat that of :meth:`film`.
        form, ends, cutoffs_m
            See :func:`ehlwave.deform.deform_surface`; ``cutoffs_m`` is (lambda_c, lambda_s).
        **reading
            Of :class:`ehlwave.deform.ReadOptions`, for what the surface does not say.

        Raises
        ------
        RangeError
            A ValueError: the contact lies outside the atlas and `by` is ``"atlas"``, or outside the
            laws of heat.
        SurfaceError
            If the surface cannot be used, or the contact was given without lengths.

        Warns
        -----
        ExtrapolationWarning
            If the amplitude lies above those that predictions were compared with, or the surfaces
            touch.

        Examples
        --------
        >>> import numpy as np
        >>> import ehlwave
        >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
        ...     reduced_modulus_pa=2.26e11, load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
        >>> x = np.arange(0, 2e-3, 2e-6)
        >>> height = 50e-9 * np.cos(2 * np.pi * x / 1e-4)
        >>> trace = ehlwave.deform.trace_surface(height, step_m=2e-6, axis="x", name="waves")
        >>> found = contact.deform(trace)
        >>> before, after = found.statistics.rq_before_m, found.statistics.rq_after_m
        >>> print(f"Rq {before * 1e9:.0f} nm as measured, {after * 1e9:.0f} nm in the contact")
        Rq 35 nm as measured, 34 nm in the contact
        """
        found = self._deformed(surface, by, form, ends, cutoffs_m, **reading)
        _warn(found.doubts)
        return found

    def deform_pair(
        self,
        surface: Surface | SurfaceSource,
        second: Surface | SurfaceSource,
        **options: Any,  # noqa: ANN401
    ) -> DeformedPair:
        """Predict the shapes of two measured surfaces inside the contact, and the film between.

        Parameters
        ----------
        surface, second : Surface, path, array or topography
            Of the body that moves with S, and of the other one, which moves with 2 - S. Their
            phases are free: mean squares of their heights add.
        **options
            As of :meth:`deform`, for both.

        Raises
        ------
        RangeError
            A ValueError: the contact lies outside the atlas.
        SurfaceError
            If a surface cannot be used, or the contact was given without lengths.

        Warns
        -----
        ExtrapolationWarning
            As :meth:`deform`, of either and of both together.

        Examples
        --------
        >>> import numpy as np
        >>> import ehlwave
        >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
        ...     reduced_modulus_pa=2.26e11, load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
        >>> x = np.arange(0, 2e-3, 2e-6)
        >>> ball, disc = (30e-9 * np.cos(2 * np.pi * x / wave) for wave in (1e-4, 7e-5))
        >>> pair = contact.deform_pair(ball, disc, step=2e-6)
        >>> print(f"lambda ratio {pair.statistics.lambda_ratio_after:.0f}")
        lambda ratio 29
        """
        other = copy(self)
        other.conditions = second_conditions(self.conditions)
        other.heat = None if self.heat is None else self.heat.exchanged()
        found = DeformedPair(self._deformed(surface, **options), other._deformed(second, **options))
        _warn(found.doubts)
        return found

    def _deformed(
        self,
        surface: Surface | SurfaceSource,
        by: str = "atlas",
        form: Form = "plane",
        ends: Window = "mirror",
        cutoffs_m: Cutoffs = (None, None),
        **reading: Any,  # noqa: ANN401
    ) -> Deformed:
        """Return what :meth:`deform` does, and warn of nothing."""
        if not math.isfinite(self.conditions.semi_axis_a_m):
            raise SurfaceError(
                "Contact: a surface in metres needs semi_axis_a_m and radius_x_m besides M, L and D"
            )
        chosen(ends, "ends", WINDOWS)
        measured = read_surface(surface, ReadOptions(**reading))
        transfer = self.transfer(by)
        conditions = conditions_with_film(self, or_formula=by != "atlas")
        return deform_surface(measured, conditions, transfer, form, ends, cutoffs_m)

    def stress(
        self,
        surface: Surface | SurfaceSource,
        second: Surface | SurfaceSource | None = None,
        **options: Any,  # noqa: ANN401
    ) -> RoughStress:
        """Return the stresses below both bodies with a measured surface, or one on each.

        Parameters
        ----------
        surface, second : Surface, path, array or topography
            Of the first body, whose slip parameter is that of the contact, and of the other one;
            without, that one is smooth.
        **options
            ``friction``, ``cycles``, ``poisson_ratio``, ``depths_m`` and ``smooth`` of
            :func:`ehlwave.stress.stress_of_contact`; those of :meth:`deform`. Without
            ``poisson_ratio`` bodies of :meth:`from_bodies` have their own, others 0.3.

        Examples
        --------
        >>> import numpy as np
        >>> import ehlwave
        >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
        ...     reduced_modulus_pa=2.26e11, load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
        >>> x = np.arange(0, 2e-3, 2e-6)
        >>> height = 50e-9 * np.cos(2 * np.pi * x / 1e-4)
        >>> trace = ehlwave.deform.trace_surface(height, step_m=2e-6, axis="x", name="waves")
        >>> found = contact.stress(trace)
        >>> print(f"Hertz pressure {found.hertz_pa / 1e9:.2f} GPa")
        Hertz pressure 0.85 GPa
        """
        from ehlwave.stress.contact_stress import stress_of_contact

        if self._poisson_ratio is not None:
            options.setdefault("poisson_ratio", self._poisson_ratio)
        return stress_of_contact(self, surface, second, **options)

    def lambda_ratio(
        self,
        surface: Surface | SurfaceSource,
        second: Surface | SurfaceSource | None = None,
        **options: Any,  # noqa: ANN401
    ) -> float:
        """Return the mean film over Rq of the deformed surface, or of both.

        Its error is ``deform(...).statistics.lambda_error``, that of both
        ``deform_pair(...).statistics.lambda_error``.

        Parameters
        ----------
        surface : Surface, path, array or topography
            As :func:`ehlwave.read_surface` reads it; of an array give ``step``, in metres.
        second : Surface, path, array or topography, optional
            Of the other body, which is smooth without; see :meth:`deform_pair`.
        **options
            Other arguments of :meth:`deform`.

        Warns
        -----
        ExtrapolationWarning
            If the amplitude lies above those that predictions were compared with.

        Examples
        --------
        >>> import numpy as np
        >>> import ehlwave
        >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
        ...     reduced_modulus_pa=2.26e11, load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
        >>> x = np.arange(0, 2e-3, 2e-6)
        >>> height = 50e-9 * np.cos(2 * np.pi * x / 1e-4)
        >>> trace = ehlwave.deform.trace_surface(height, step_m=2e-6, axis="x", name="waves")
        >>> print(f"{contact.lambda_ratio(trace):.0f}")
        24
        """
        found = (
            self.deform(surface, **options)
            if second is None
            else self.deform_pair(surface, second, **options)
        )
        if found.statistics.lambda_ratio_after is None:
            raise SurfaceError(
                "Contact: the film in metres needs radius_x_m besides semi_axis_a_m, M, L and D"
            )
        return found.statistics.lambda_ratio_after


def conditions_with_film(contact: Contact, *, or_formula: bool) -> Conditions:
    """Return conditions with the film of the atlas, with heat that of :meth:`Contact.film`.

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


def contact_of(given: Given) -> Contact:
    """Return the contact of an input file, or of words of a command line."""
    contact = Contact(heat=given.heat, **given.keys)
    contact.conditions = given.conditions
    return contact


def _warn(doubts: Sequence[str]) -> None:
    for doubt in doubts:
        warnings.warn(doubt, ExtrapolationWarning, stacklevel=_callers())


def _callers() -> int:
    """Return the stack level, for a warning, of the line outside this module that led here."""
    level, frame = 1, sys._getframe(1)
    while frame is not None and frame.f_globals.get("__name__") == __name__:
        level, frame = level + 1, frame.f_back
    return level
