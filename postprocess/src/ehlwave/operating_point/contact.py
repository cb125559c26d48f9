"""A contact: its keys, its law for waves, and what errors of its data do."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlwave.contact.conditions_read import Given
from ehlwave.laws.transfer import Transfer
from ehlwave.operating_point.rough import RoughContact

if TYPE_CHECKING:
    import pandas as pd

    from ehlwave.surface.raw_surface import SurfaceSource
    from ehlwave.surface.surface import Surface


class Contact(RoughContact):
    """A lubricated contact of smooth bodies with a rough or wavy surface.

    Parameters
    ----------
    atlas : path, optional
        An atlas file in place of the package's.
    heat : Heat, optional
        How oil and bodies conduct and store heat: film and friction are those with heat, by the
        laws of :mod:`ehlwave.laws.heat_laws`.
    table : path or DataFrame, optional
        Harmonic table that answers for waves in place of the other laws, from ``ehlwave
        harmonics``.
    **keys
        Keys of the input files of ``ehlwave-case``: dimensional data (``radius_x_m``,
        ``radius_y_m``, ``reduced_modulus_pa``, ``load_n``, ``mean_speed_m_per_s``,
        ``viscosity_pa_s``; of a line contact ``load_n_per_m`` in place of ``radius_y_m`` and
        ``load_n``), or ``load_parameter_m``, ``lubricant_parameter_l`` and ``radius_ratio_d`` (0:
        line contact), then with ``semi_axis_a_m`` (Hertz semi-axis along rolling) and
        ``radius_x_m`` where metres are asked for;
        ``pressure_viscosity_per_pa`` (2.2e-8) and ``roelands_index`` (0.68) of the oil;
        ``slip_parameter`` (1) of the rough surface, or ``slide_to_roll_ratio`` (0); of a Ree-Eyring
        oil ``eyring_stress_pa``; relative standard errors of
        data, which films carry (:meth:`error_budget` has friction, too): ``viscosity_error``,
        ``pressure_viscosity_error``, ``load_error``, ``speed_error``, ``radius_x_error``,
        ``radius_y_error``, ``modulus_error``, ``roelands_error``, ``eyring_stress_error``.
        ``oil_over_flooded``, r, of a starved
        contact that rolls: film and waves by the laws of :mod:`ehlwave.contact.starvation`. Plain
        numbers are SI; quantities of pint are converted. From two bodies: :meth:`from_bodies`.

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

    def transfer(self, by: str | None = None) -> Transfer:
        """Return the transfer that gives the response of each component of a surface.

        Parameters
        ----------
        by : str, optional
            A law's name: "table", "atlas", "starved", "two-waves", "computed", "recommended" or
            "paper". By default a given table answers, else the first law that holds; where none
            does, the programs compute the responses, if they are installed. "laws": nothing is
            computed.

        Raises
        ------
        RangeError
            A ValueError: no law holds, or not the law named.
        SurfaceError
            If there is no such law.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...     radius_ratio_d=1)
        >>> contact.transfer("paper").name
        'formula of Venner et al. (2000)'
        """
        return self._transfer(None, by)

    def sensitivities(self, by: str | None = None) -> pd.DataFrame:
        """Return d ln(result)/d ln(key) of film and friction by every key of the contact.

        Parameters
        ----------
        by : {"laws", "computed"}, optional
            As of :meth:`film`: the laws, which are differentiated exactly within the law and the
            chart of the atlas that answer, or the gradients of ``ehlwave-case``.

        Returns
        -------
        pandas.DataFrame
            A row for each key; columns ``central_film``, ``minimum_film`` and ``friction``. NaN:
            the result is not known. Films of M, L and D without lengths are in the Moes scale.

        Raises
        ------
        RangeError
            A ValueError: no law holds, and the contact has heat or is not to be computed.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
        ...     reduced_modulus_pa=2.26e11, load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
        >>> print(f"{contact.sensitivities().central_film['mean_speed_m_per_s']:.2f}")
        0.67
        """
        from ehlwave.operating_point.gradients import sensitivities

        return sensitivities(self, by)

    def error_budget(
        self,
        surface: Surface | SurfaceSource | None = None,
        by: str | None = None,
        **options: Any,  # noqa: ANN401
    ) -> pd.DataFrame:
        """Return what the errors of the data do to film, friction and lambda ratio.

        Parameters
        ----------
        surface : Surface, path, array or topography, optional
            With it, the lambda ratio of :meth:`lambda_ratio` is among the results, by the laws.
        by : {"laws", "computed"}, optional
            As of :meth:`sensitivities`.
        **options
            Of :meth:`deform`.

        Returns
        -------
        pandas.DataFrame
            A row for each key with an error, the most important one for the first result first,
            and a last one, ``total``. Columns: ``error``, the relative standard error of the data;
            for each result its relative standard error by it, and ``RESULT_share``, the share of
            its variance. Errors are independent: squares add.

        Raises
        ------
        SurfaceError
            If no error of data is given.
        RangeError
            A ValueError: as of :meth:`sensitivities`, or no law has the lambda ratio.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
        ...     reduced_modulus_pa=2.26e11, load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05,
        ...     pressure_viscosity_error=0.15, viscosity_error=0.05, load_error=0.1)
        >>> budget = contact.error_budget()
        >>> print(f"{budget.central_film['total']:.2f}, most by {budget.index[0]}")
        0.10, most by pressure_viscosity_per_pa
        """
        from ehlwave.operating_point.gradients import error_budget

        return error_budget(self, surface, by, options)


def contact_of(given: Given, table: Path | None = None) -> Contact:
    """Return the contact of an input file, or of words of a command line; waves by a table."""
    contact = Contact(heat=given.heat, table=table, **given.keys)
    contact._given = given.conditions
    return contact
