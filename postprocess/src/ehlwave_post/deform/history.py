"""The complex transfer of one wave from its simulated history at the contact centre."""

import numpy as np
from numpy.typing import NDArray

from ehlwave_post.errors import SurfaceError

Floats = NDArray[np.float64]


def transfer_of_history(
    time: Floats, film: Floats, amplitude: float, wavelength_x: float, start: float, slip: float
) -> complex:
    """Return the transfer of a wave from H(0,0,T), least squares over the last whole periods.

    The wave on the surface is ``amplitude`` cos(2 pi Xhat/lambda), Xhat = X - start - slip T its
    coordinate on the surface (eq. (12)); the film at the centre is then Re(transfer amplitude
    exp(2 pi i Xhat/lambda)) about its mean.

    Parameters
    ----------
    time, film : ndarray
        T and H(0,0,T), from when they are periodic.
    amplitude : float
        Ai, in the units of ``film``.
    wavelength_x, start, slip : float
        lambda_x/a, Xs and S of the case.

    Raises
    ------
    SurfaceError
        If the history is shorter than a period or has fewer than 4 samples in it.
    """
    period = wavelength_x / slip
    step = time[-1] - time[-2]
    periods = np.floor((time[-1] - time[0] + 1.5 * step) / period + 1e-6)
    if periods < 1 or period < 4 * step:
        raise SurfaceError("the history is shorter than a period, or has under 4 samples in one")
    chosen = time > time[-1] - periods * period + 1e-6 * step
    phase = 2 * np.pi * (-start - slip * time[chosen]) / wavelength_x
    basis = np.column_stack((np.ones(phase.size), np.cos(phase), -np.sin(phase)))
    _, real, imag = np.linalg.lstsq(basis, film[chosen] - film[chosen].mean(), rcond=None)[0]
    return complex(real, imag) / amplitude
