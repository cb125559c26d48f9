"""A contact with small waves on a body: its responses."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ehlwave.contact.line_contact import TRANSVERSE_ALONE
from ehlwave.errors import RangeError
from ehlwave.inputs.slip import slip_given
from ehlwave.laws.answers import Response
from ehlwave.laws.response_answer import response_of
from ehlwave.operating_point.smooth import SmoothContact
from ehlwave.quantities import number

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike


class WavyContact(SmoothContact):
    """Small waves of :class:`ehlwave.Contact`."""

    def response(
        self,
        wavelength_over_a: float,
        angle_deg: float = 0.0,
        slip_parameter: float | None = None,
        slide_to_roll_ratio: float | None = None,
        by: str | None = None,
    ) -> Response:
        """Return the response at the contact centre to small waves.

        The list of laws chooses who answers, as for a surface: see :meth:`transfer`.

        Parameters
        ----------
        wavelength_over_a : float
            Wavelength along the wave vector over the Hertz semi-axis a, 0.1 to 4.
        angle_deg : float
            Between wave vector and rolling direction, in metres: 0 transverse, 90 longitudinal.
            Line contacts answer for 0 alone.
        slip_parameter : float, optional
            S of the surface that carries the waves, 0 to 2; by default S of the contact.
        slide_to_roll_ratio : float, optional
            In place of `slip_parameter`, S = 1 + ratio/2.
        by : str, optional
            As in :meth:`transfer`.

        Raises
        ------
        RangeError
            A ValueError: no law holds for the contact, the wave and the slip; nothing is
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
        if not wavelength_over_a > 0:
            raise RangeError(f"wavelength_over_a = {wavelength_over_a:.5g} must be above 0")
        if not -1e-9 <= angle_deg <= 90 + 1e-9:
            raise RangeError(
                f"angle_deg = {angle_deg:.5g} lies outside 0 to 90 (waves at -angle are the same)"
            )
        c = self._given
        if c.is_line and angle_deg > 1e-9:
            raise RangeError(TRANSVERSE_ALONE)
        return response_of(self._transfer(slip_parameter, by), c, wavelength_over_a, angle_deg)

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
        from ehlwave.laws.responses import response_table

        waves, angles = wavelength_over_a, angle_deg
        slip_parameter = slip_given(slip_parameter, slide_to_roll_ratio, "responses")
        return response_table(self.response, self._given, waves, angles, slip_parameter)

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
        from ehlwave.laws.responses import responses_figure

        slip_parameter = slip_given(slip_parameter, slide_to_roll_ratio, "plot")
        return responses_figure(self.responses(wavelength_over_a, angle_deg, slip_parameter))
