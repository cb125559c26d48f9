"""Response of a contact to a wave: a surface with a single component."""

from ehlwave.contact.conditions import Conditions
from ehlwave.duals import np, to_complex, to_float
from ehlwave.errors import RangeError
from ehlwave.laws.answers import Response
from ehlwave.laws.transfer import EXTRAPOLATED, Transfer, Waves


def response_of(
    transfer: Transfer, conditions: Conditions, wavelength_over_a: float, angle_deg: float
) -> Response:
    """Return the response to a wave by a transfer.

    Parameters
    ----------
    transfer : Transfer
        From the list of laws, for a contact with these conditions.
    conditions : Conditions
        Its semi-axis a is the unit of length; 1 m where it is unknown.
    wavelength_over_a, angle_deg : float
        Wavelength along the wave vector over a; angle between wave vector and rolling, 0 to 90.

    Raises
    ------
    RangeError
        If the wave lies outside the range of the law.
    """
    a_m = conditions.semi_axis_a_m
    qx, qy = one_wave(wavelength_over_a * (a_m if np.isfinite(a_m) else 1.0), angle_deg)
    if not bool(transfer.is_covered(qx, qy)[0]):
        reason = transfer.outside_reason.partition(EXTRAPOLATED)[0]
        raise RangeError(
            f"wavelength_over_a = {wavelength_over_a:.5g} at angle_deg = {angle_deg:.5g}: the law "
            f"leaves out waves {reason}"
        )
    error = transfer.error(qx, qy)
    return Response(
        film=to_complex(transfer.ratio(qx, qy)[0]),
        pressure=to_complex(transfer.pressure(qx, qy)[0]),
        error=float("nan") if error is None else to_float(error[0]),
        source=transfer.name,
        has_phase=transfer.has_phase,
    )


def one_wave(wavelength_m: float, angle_deg: float) -> tuple[Waves, Waves]:
    """Return waves per metre along x and y of a wave, as arrays of a single number."""
    angle = np.radians(angle_deg)
    along = 0.0 if angle_deg >= 90 else to_float(np.cos(angle))
    across = 0.0 if angle_deg == 0 else to_float(np.sin(angle))
    return np.array([along / wavelength_m]), np.array([across / wavelength_m])
