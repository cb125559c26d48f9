"""How much of each harmonic component is left inside the contact.

A transfer is a function of wave numbers that returns the (complex) ratio of the film's component
at the contact centre to the surface's. With the component written as exp(i (qx x + qy y)), x
counted on the surface along its motion, the deformed component is the transfer times the same
exponential. A transfer is even in qy, and its conjugate at (-qx, -qy): it returns real surfaces.
"""

from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.formula import (
    PAPER_C1,
    PAPER_C2,
    RECOMMENDED_RANGES,
    amplitude_ratio_formula,
    f_of_r,
    recommended_ratio,
)
from ehlwave.duals import math, np
from ehlwave.errors import SurfaceError

Waves = NDArray[np.float64]

EXTRAPOLATED = ", extrapolated and included in the error"
"""End of the reason of waves that a law does not cover and nevertheless answers."""


class Transfer:
    """Base of all that judges harmonic components, with the answers of a law that lacks them."""

    @property
    def name(self) -> str:
        """Return its description, for reports."""
        raise NotImplementedError

    @property
    def has_phase(self) -> bool:
        """Whether the phases of waves are known."""
        return True

    @property
    def covers_all(self) -> bool:
        """Whether every component shorter than the contact is covered."""
        return False

    @property
    def outside_reason(self) -> str:
        """Why a component shorter than the contact is not covered."""
        raise NotImplementedError

    @property
    def smooth_from(self) -> float:
        """Waves per metre from which on the transfer is smooth, all covered or none."""
        return math.inf

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[Any]:
        """Return the transfer for waves per metre along x (any sign) and y (not negative)."""
        raise NotImplementedError

    def pressure(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[Any]:
        """Return the pressure transfer, in units of ph/c; NaN where it is not known."""
        shape = np.broadcast_shapes(np.shape(per_length_x), np.shape(per_length_y))
        return np.full(shape, complex(np.nan, np.nan))

    def rise(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return the rise of the mean film by waves, to second order; None if unknown.

        For each wave q in (mean film less smooth film)/film = q (A/film)^2, A its amplitude.
        """

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return the absolute error of the transfer; None if that is not known."""

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether the transfer is known there rather than continued."""
        raise NotImplementedError


class OfTwo(Transfer):
    """Base of laws made of two transfers: both have to cover a component."""

    @property
    def parts(self) -> tuple[Transfer, Transfer]:
        """Return both; the first decides whether phases are known."""
        raise NotImplementedError

    @property
    def has_phase(self) -> bool:
        """Whether the phases of waves are known."""
        return self.parts[0].has_phase

    @property
    def covers_all(self) -> bool:
        """Whether both cover every component shorter than the contact."""
        return all(part.covers_all for part in self.parts)

    @property
    def outside_reason(self) -> str:
        """Why a component is not covered."""
        reasons = (part.outside_reason for part in self.parts)
        return "; ".join(dict.fromkeys(reason for reason in reasons if reason))

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether both transfers are known there."""
        first, second = (part.is_covered(per_length_x, per_length_y) for part in self.parts)
        return np.asarray(first & second)


def orientation_and_wave(per_length_x: Waves, per_length_y: Waves) -> tuple[Waves, Waves]:
    """Return f(r) and min(lambda_x, lambda_y) in m, eq. (15); the mean has lambda infinite.

    Takes waves per metre of either sign. r = lambda_x/lambda_y is the ratio of the wave numbers,
    so an oblique component is judged by its wavelengths along x and along y, as the product of
    cosines is that two oblique components make.
    """
    qx, qy = np.abs(per_length_x), np.abs(per_length_y)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(qy > 0, qy / qx, 0.0)
        return f_of_r(ratio), 1 / np.maximum(qx, qy)


class LawBasis(Transfer):
    """Base of laws, which are linear. They cover all components, or none with a reason."""

    conditions: Conditions

    def reasons(self) -> list[str]:
        """Return why the conditions do not match the law."""
        raise NotImplementedError

    @property
    def covers_all(self) -> bool:
        """Return whether the conditions match the law."""
        return not self.reasons()

    @property
    def outside_reason(self) -> str:
        """Return why components are not covered."""
        return "; ".join(self.reasons())

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether the conditions match the law."""
        shape = np.broadcast_shapes(np.shape(per_length_x), np.shape(per_length_y))
        return np.full(shape, self.covers_all)


class FormulaBasis(LawBasis):
    """Base of formulas for pure rolling."""

    def reasons(self) -> list[str]:
        """Return why the conditions do not match the formula: slip, or a shear-thinning oil."""
        slip = self.conditions.slip_parameter
        if slip != 1:
            return [f"slip (S = {slip:g}): the formula is for pure rolling"]
        thins = math.isinf(self.conditions.film_loss)
        return ["of an oil that thins in the inlet: the formula is for Newtonian oils"] * thins


@dataclass(frozen=True)
class FormulaTransfer(FormulaBasis):
    """Ad/Ai = 1/(1 + c1 f V + c2 (f V)^2), eq. (18): real, no phase, pure rolling.

    The mean, whose wavelength is infinite, does not deform the film: its ratio is 0, because the
    load moves the bodies until it is carried.

    Raises
    ------
    SurfaceError
        If the coefficients make the ratio infinite or negative for some f V.
    """

    conditions: Conditions
    c1: float = PAPER_C1
    c2: float = PAPER_C2
    name: str = "formula of Venner et al. (2000)"

    def __post_init__(self) -> None:
        """Refuse coefficients that are no amplitude reduction."""
        if not (self.c2 > 0 and self.c1 > -2 * np.sqrt(self.c2)):
            raise SurfaceError(
                f"coefficients c1 = {self.c1:g}, c2 = {self.c2:g}: 1 + c1 x + c2 x^2 must be "
                "positive for all x and grow: c2 > 0 and c1 > -2 sqrt(c2)"
            )

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.float64]:
        """Return Ad/Ai for waves per metre along x and y; 0 for the mean."""
        factor, wavelength = orientation_and_wave(per_length_x, per_length_y)
        f_v = factor * wavelength * self.conditions.v_per_wavelength
        return amplitude_ratio_formula(f_v, self.c1, self.c2)


@dataclass(frozen=True)
class RecommendedTransfer(FormulaBasis):
    """Ad/Ai of :func:`ehlwave.contact.formula.recommended_ratio`: real, no phase, pure rolling.

    As with (18), the ratio of the mean is 0.
    """

    conditions: Conditions
    name: str = "recommended formula, (1 + x^n)^(-1/n)"

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.float64]:
        """Return Ad/Ai for waves per metre along x and y; 0 for the mean."""
        contact = self.conditions
        along, across = np.broadcast_arrays(np.abs(per_length_x), np.abs(per_length_y))
        with np.errstate(divide="ignore"):
            # The formula takes zero for an infinite wavelength.
            waves = [np.where(q > 0, 1 / (q * contact.semi_axis_a_m), 0.0) for q in (along, across)]
        ratio = recommended_ratio(contact.m, contact.l, contact.slender_gamma, *waves)
        return np.where((along == 0) & (across == 0), 0.0, ratio)

    def reasons(self) -> list[str]:
        """Return which of M, L and D are outside the fit, and whether there is slip."""
        contact = self.conditions
        values = {"M": contact.m, "L": contact.l, "D": contact.d}
        if contact.is_line:
            return [
                "of a line contact: the formula was fitted to elliptical contacts",
                *super().reasons(),
            ]
        outside = [
            f"{name} = {values[name]:.4g}: the formula was fitted to {low:g} to {high:g}"
            for name, (low, high) in RECOMMENDED_RANGES.items()
            if not low <= values[name] <= high
        ]
        return outside + super().reasons()


def shorter_than_contact(
    conditions: Conditions, per_length_x: Waves, per_length_y: Waves
) -> NDArray[np.bool_]:
    """Return whether lambda_x <= 2a or lambda_y <= 2b: a wave fits in the Hertzian contact.

    In a line contact, whose waves are all across rolling, the former.
    """
    along = np.abs(per_length_x) * 2 * conditions.semi_axis_a_m
    if conditions.is_line:
        return np.asarray(along >= 1 - 1e-9)
    across = np.abs(per_length_y) * 2 * conditions.semi_axis_b_m
    # A wave exactly as long as the contact belongs to it, whatever the rounding.
    return np.maximum(along, across) >= 1 - 1e-9
