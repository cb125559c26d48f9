"""Rough surfaces in a contact: their shapes, stresses and lambda ratios."""

from __future__ import annotations

import math
from copy import copy
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ehlwave.choices import FILM_BY, WINDOWS, chosen
from ehlwave.contact.conditions import Conditions
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.laws.film_answer import with_film
from ehlwave.laws.notices import warn
from ehlwave.laws.transfer import Transfer
from ehlwave.operating_point.wavy import WavyContact

if TYPE_CHECKING:
    from typing_extensions import Self

    from ehlwave.stress.rough import RoughStress
    from ehlwave.surface.pair import DeformedPair
    from ehlwave.surface.predict import Cutoffs, Deformed
    from ehlwave.surface.prepare import Form, Window
    from ehlwave.surface.raw_surface import SurfaceSource
    from ehlwave.surface.surface import Surface


class RoughContact(WavyContact):
    """Measured surfaces of :class:`ehlwave.Contact`."""

    def deform(
        self,
        surface: Surface | SurfaceSource,
        by: str | None = None,
        form: Form = "plane",
        ends: Window = "mirror",
        cutoffs_m: Cutoffs = (None, None),
        transfer: Transfer | None = None,
        boundary_film_m: float | None = None,
        **reading: Any,  # noqa: ANN401
    ) -> Deformed:
        """Predict the shape of a measured surface inside the contact, and the film over it.

        Parameters
        ----------
        surface : Surface, path, array or topography
            As :func:`ehlwave.read_surface` reads it; of an array give ``step``, in metres.
        by : str, optional
            Law that judges components, as in :meth:`transfer`. The film is the result of
            :meth:`film`.
        form, ends, cutoffs_m
            See :func:`ehlwave.surface.deform_surface`; ``cutoffs_m`` is (lambda_c, lambda_s).
        transfer : Transfer, optional
            In place of a law of the list.
        boundary_film_m : float, optional
            Film at which solids begin to bear, to decide whether the surfaces touch in rolling.
        **reading
            Of :class:`ehlwave.surface.ReadOptions`, for data that the surface lacks.

        Raises
        ------
        RangeError
            A ValueError: no law holds, or not the law named.
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
        >>> trace = ehlwave.surface.trace_surface(height, step_m=2e-6, axis="x", name="waves")
        >>> found = contact.deform(trace)
        >>> before, after = found.statistics.rq_before_m, found.statistics.rq_after_m
        >>> print(f"Rq {before * 1e9:.0f} nm as measured, {after * 1e9:.0f} nm in the contact")
        Rq 35 nm as measured, 34 nm in the contact
        """
        found = self._deformed(
            surface, by, form, ends, cutoffs_m, transfer, boundary_film_m, **reading
        )
        warn(found.doubts)
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
            Surfaces of the body that moves with S, and of the second, which moves with 2 - S. Their
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
        from ehlwave.surface.pair import DeformedPair

        other = self.exchanged()
        found = DeformedPair(self._deformed(surface, **options), other._deformed(second, **options))
        warn(found.doubts)
        return found

    def stress(
        self,
        surface: Surface | SurfaceSource,
        second: Surface | SurfaceSource | None = None,
        **options: Any,  # noqa: ANN401
    ) -> RoughStress:
        """Return the stresses below both bodies with a measured surface, or a surface on each.

        Parameters
        ----------
        surface, second : Surface, path, array or topography
            Surface of the first body, whose slip parameter is the contact's, and of the second,
            which is smooth by default.
        **options
            ``friction``, ``cycles``, ``poisson_ratio``, ``depths_m`` and ``smooth`` of
            :func:`ehlwave.stress.stress_of_contact`; options of :meth:`deform`. Without
            ``poisson_ratio`` bodies of :meth:`from_bodies` have their own, others 0.3.

        Examples
        --------
        >>> import numpy as np
        >>> import ehlwave
        >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
        ...     reduced_modulus_pa=2.26e11, load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
        >>> x = np.arange(0, 2e-3, 2e-6)
        >>> height = 50e-9 * np.cos(2 * np.pi * x / 1e-4)
        >>> trace = ehlwave.surface.trace_surface(height, step_m=2e-6, axis="x", name="waves")
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

        Its error is ``deform(...).statistics.lambda_error``, for both
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
        >>> trace = ehlwave.surface.trace_surface(height, step_m=2e-6, axis="x", name="waves")
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

    def exchanged(self) -> Self:
        """Return the same contact with the other body first, which moves with 2 - S.

        Examples
        --------
        >>> import ehlwave
        >>> ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1,
        ...     slip_parameter=1.1).exchanged()
        Contact(M=100, L=10, D=1, S=0.9)
        """
        from ehlwave.surface.film_profile import second_conditions

        other = copy(self)
        other._given = second_conditions(self._given)
        other._heat = None if self.heat is None else self.heat.exchanged()
        other._questions, other._transfers = {}, {}
        # The film is the same.
        other._questions[None] = replace(other._asked(), films=self._asked().films)
        return other

    def _deformed(
        self,
        surface: Surface | SurfaceSource,
        by: str | None = None,
        form: Form = "plane",
        ends: Window = "mirror",
        cutoffs_m: Cutoffs = (None, None),
        transfer: Transfer | None = None,
        boundary_film_m: float | None = None,
        **reading: Any,  # noqa: ANN401
    ) -> Deformed:
        """Return the result of :meth:`deform`, without warnings."""
        from ehlwave.surface.predict import deform_surface
        from ehlwave.surface.read import ReadOptions, read_surface

        if not math.isfinite(self._given.semi_axis_a_m):
            raise SurfaceError(
                "Contact: a surface in metres needs semi_axis_a_m and radius_x_m besides M, L and D"
            )
        chosen(ends, "ends", WINDOWS)
        measured = read_surface(surface, ReadOptions(**reading))
        film_by = by if by in FILM_BY else None
        conditions, notices = self._filmed(film_by)
        transfer = transfer or self._transfer(None, by)
        found = deform_surface(
            measured, conditions, transfer, form, ends, cutoffs_m, boundary_film_m
        )
        found.warnings.extend(notices)
        return found

    def _filmed(self, by: str | None) -> tuple[Conditions, list[str]]:
        """Return conditions with their film and the warnings about it.

        Where no law holds and nothing computes it, a formula applies, with its error.
        """
        c = self._given
        if c.has_given_film or c.metres_per_moes is None:
            return c, []
        try:
            film = self._film(by)
        except RangeError as error:
            if self.heat is not None:
                raise
            return c, [f"the film is the result of a formula: {error}"]
        return with_film(c, film), list(film.warnings)
