"""Form removal, and treatment of the ends of a measured piece of surface.

A Fourier series repeats the piece without end. Where its ends do not match, the jump between them
adds components that the surface does not have. Three ways to deal with that:

``mirror``
    The piece is followed by its mirror image, so that the ends match. Nothing of the surface is
    changed; within about one Hertz semi-axis of an end the prediction applies to the mirrored
    neighbourhood.
``taper``
    The outer tenth at each end is faded to the mean by a cosine (Tukey window). Results of that
    margin mean nothing and are left out of the statistics.
``none``
    For surfaces that do repeat: synthetic surfaces, or a whole number of periods.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ehlwave.choices import FORMS, WINDOWS, Form, Window, chosen
from ehlwave.surface.surface import Heights, Surface

TAPERED_SHARE = 0.1
"""Share of the length, at each end."""


def remove_form(surface: Surface, form: Form) -> Surface:
    """Return the surface less its least-squares polynomial of total degree 0, 1 or 2.

    ``mean``, ``plane`` and ``quadratic`` remove an offset, a tilt and the curvature of a ball or
    roller. The macroscopic shape is in the conditions already (Rx, Ry), so it must not be in the
    roughness too. ``none`` changes nothing.

    Raises SurfaceError if there is no such form.
    """
    degree = FORMS[chosen(form, "form", FORMS)]  # type: ignore[index]
    if degree is None:
        return surface
    if np.ptp(surface.height) == 0:
        return replace(surface, height=np.zeros_like(surface.height))
    nx, ny = surface.height.shape
    basis_x, basis_y = _orthonormal(nx, degree), _orthonormal(ny, degree)
    # Products of orthonormal polynomials on a full grid are orthonormal: no system to solve.
    weights = basis_x.T @ (surface.height @ basis_y.astype(surface.height.dtype))
    order = np.add.outer(np.arange(basis_x.shape[1]), np.arange(basis_y.shape[1]))
    weights = np.where(order <= degree, weights, 0)
    fitted = (basis_x @ weights).astype(surface.height.dtype)
    left = fitted @ basis_y.T.astype(surface.height.dtype)
    np.subtract(surface.height, left, out=left)
    return replace(surface, height=left)


def extended(height: Heights, window: Window) -> Heights:
    """Return heights ready for a Fourier transform: mirrored, tapered or as they are.

    Raises SurfaceError if there is no such treatment of the ends.
    """
    chosen(window, "window", WINDOWS)
    if window == "none":
        return height
    if window == "taper":
        nx, ny = height.shape
        factors = taper(nx), taper(ny)
        mean = height.mean(dtype=np.float64).astype(height.dtype)
        return mean + (height - mean) * np.outer(*factors).astype(height.dtype)
    pieces = height
    for axis in (0, 1):
        if height.shape[axis] > 1:
            pieces = np.concatenate((pieces, np.flip(pieces, axis)), axis)
    return pieces


def taper(count: int) -> NDArray[np.float64]:
    """Return a Tukey window: 1, faded to 0 by half a cosine over a tenth of the length each end."""
    if count == 1:
        return np.ones(1)
    width = max(1.0, TAPERED_SHARE * (count - 1))
    distance = np.minimum(np.arange(count), np.arange(count)[::-1]) / width
    return np.asarray(0.5 - 0.5 * np.cos(np.pi * np.minimum(distance, 1)))


def judged_part(shape: tuple[int, int], window: Window) -> tuple[slice, slice]:
    """Return the part of the surface that statistics are made of."""
    if window != "taper":
        return slice(None), slice(None)
    margins = [int(np.ceil(TAPERED_SHARE * (count - 1))) if count > 1 else 0 for count in shape]
    return slice(margins[0], shape[0] - margins[0]), slice(margins[1], shape[1] - margins[1])


def _orthonormal(count: int, degree: int) -> NDArray[np.float64]:
    """Return orthonormal polynomials on equidistant points, shape (count, degree + 1)."""
    degree = min(degree, count - 1)
    powers = np.polynomial.legendre.legvander(np.linspace(-1, 1, count), degree)
    return np.linalg.qr(powers)[0]
