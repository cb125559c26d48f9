"""Results for one body: criteria, Dang Van's factor, life, and their errors."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.error_bars import bar
from ehlwave.shown import Shown
from ehlwave.stress.criteria import CRITERIA, largest_shear
from ehlwave.stress.dang_van import Path, dang_van_factor, dang_van_path
from ehlwave.stress.history import Histories
from ehlwave.stress.life import life_integral_ratio, life_ratio, share_at_risk
from ehlwave.stress.removal import RiskBand

Floats = NDArray[np.float64]

INNER = 0.5
"""In semi-axes: the ripple is judged where it matches the centre, short of edges and spike."""

EDGE_SHARE = bar("stress.edge_share")
"""Relative error of the ripple's share of Dang Van's factor: passages begin and end at the edges of
the contact, where it is unknown. Marches of 12 traces (D of 0.25 to 1, S of 0.7 to 1.5, amplitudes
of 0.15 to 0.3 of the film) had 0.4 at most, beside the error of the smooth factor.
"""


@dataclass(frozen=True)
class Peak:
    """A largest stress."""

    value_pa: float
    """The stress."""
    depth_m: float
    place_m: float
    point_m: float
    """`depth_m`, `place_m`, `point_m`: its depth, where in the contact (0 the centre), and which
    point of the body."""
    smooth_pa: float = 0.0
    """The largest of the smooth contact; 0 of the ripple."""


@dataclass(frozen=True, repr=False)
class BodyStress(Shown):
    """Stresses of a body."""

    name: str
    """Which one."""
    slip: float
    """S of the body."""
    is_rough: bool
    """Whether it has a roughness of its own."""
    peaks: dict[str, Peak]
    """By criterion, of the whole stress."""
    ripple_shear: Peak
    """Largest shear of the ripple alone within half a semi-axis of the centre."""
    ripple_shear_error_pa: float
    """Its error."""
    dang_van: float
    dang_van_smooth: float
    dang_van_error: float
    """`dang_van`, `dang_van_smooth`, `dang_van_error`: largest factor over the body; of the smooth
    contact; error of the former."""
    dang_van_depth_m: float
    dang_van_point_m: float
    """`dang_van_depth_m`, `dang_van_point_m`: where it is."""
    near_m: float
    dang_van_near: float
    dang_van_near_smooth: float
    """`near_m`, `dang_van_near`, `dang_van_near_smooth`: depth that the ripple reaches, and the
    largest factors down to it, relevant to micropitting. The largest of all is often the smooth
    contact's, deeper."""
    share_at_risk: float
    """Share of the surface where the factor is 1 or more down to that depth."""
    life_ratio: float
    """Life over the smooth contact's life, by Ioannides and Harris."""
    risk: xr.DataArray
    """Dang Van's factor over depth and points, of even numbers only."""
    smooth_over_depth: Floats
    ripple_over_depth_pa: Floats
    """`smooth_over_depth`, `ripple_over_depth_pa`: factor of the smooth contact, and largest shear
    of the ripple, over the depths of ``risk``."""
    path: Path
    """Path of the point of the largest factor, over its passage."""
    bands: list[RiskBand]
    """Waves by their exponents in the largest factor near the surface, largest first."""

    def _shown_rows(self) -> dict[str, str]:
        """Return the largest stresses, Dang Van's factor and the life."""
        peaks = {key: f"{peak.value_pa * 1e-6:.4g} MPa" for key, peak in self.peaks.items()}
        return {
            "body": self.name,
            **peaks,
            "Dang Van's factor": f"{self.dang_van:.3g} within {self.dang_van_error:.2g}",
            "life over smooth": f"{self.life_ratio:.3g}",
        }


def judge_body(
    name: str,
    slip: float,
    is_rough: bool,
    histories: Histories,
    semi_axis_m: float,
    fatigue_pa: float,
    near_m: float,
    errors: tuple[float, float],
    cycle_power: float,
    bands_at: Callable[[int, int], list[RiskBand]],
) -> BodyStress:
    """Return the results of the histories of a body.

    Parameters
    ----------
    name, slip, is_rough
        As of :class:`BodyStress`.
    histories : Histories
        Of its points.
    semi_axis_m : float
        Of the contact along rolling.
    fatigue_pa, near_m : float
        tau_f of Dang Van's criterion; depth that the ripple reaches.
    errors : pair of float
        Relative errors of the ripple, and of the smooth stress.
    cycle_power : float
        e of Ioannides and Harris.
    bands_at : callable
        Waves by their exponents in the factor at indices of depth and point.
    """
    total, smooth = histories.total, histories.smooth
    fields = {key: criterion(total) for key, criterion in CRITERIA.items()}
    smooth_fields = {key: criterion(smooth) for key, criterion in CRITERIA.items()}
    peaks = {
        key: _peak(field, histories, float(smooth_fields[key].max()))
        for key, field in fields.items()
    }
    inner = np.abs(histories.places_m) <= INNER * semi_axis_m
    ripple = {key: values * inner[:, None, None] for key, values in histories.ripple.items()}
    sheared = largest_shear(ripple)
    shear = _peak(sheared, histories)
    factor = dang_van_factor(total, fatigue_pa)
    smooth_factor = np.asarray(dang_van_factor(smooth, fatigue_pa))
    near = histories.depths_m <= near_m
    z, point = _worst(factor)
    worst = {key: values[:, z, point] for key, values in total.items()}
    larger = {key: worst[key] + errors[0] * histories.ripple[key][:, z, point] for key in worst}
    change = abs(float(dang_van_factor(larger, fatigue_pa)) - float(factor[z, point]))
    added = EDGE_SHARE * abs(float(factor[z, point]) - float(smooth_factor.max()))
    risk = _even(factor, histories)
    passed, passed_smooth = (
        _even(one["largest_shear"].max(axis=0), histories) for one in (fields, smooth_fields)
    )
    return BodyStress(
        name=name,
        slip=slip,
        is_rough=is_rough,
        peaks=peaks,
        ripple_shear=shear,
        ripple_shear_error_pa=errors[0] * shear.value_pa,
        dang_van=float(factor[z, point]),
        dang_van_smooth=float(smooth_factor.max()),
        dang_van_error=float(max(change, added) + errors[1] * smooth_factor.max()),
        dang_van_depth_m=float(histories.depths_m[z]),
        dang_van_point_m=float(histories.points_m[point]),
        near_m=float(histories.depths_m[near].max()),
        dang_van_near=float(factor[near].max()),
        dang_van_near_smooth=float(smooth_factor[near].max()),
        share_at_risk=share_at_risk(risk.isel(z=np.flatnonzero(near))),
        life_ratio=life_ratio(life_integral_ratio(passed, passed_smooth), cycle_power),
        risk=risk,
        smooth_over_depth=smooth_factor[:, 0],
        ripple_over_depth_pa=sheared.max(axis=(0, 2)),
        path=dang_van_path(worst),
        bands=bands_at(*_worst(np.where(near[:, None], factor, 0.0))),
    )


def _worst(factor: Floats) -> tuple[int, int]:
    """Return the indices of depth and point of the largest factor."""
    z, point = np.unravel_index(int(np.argmax(factor)), factor.shape)
    return int(z), int(point)


def _peak(field: Floats, histories: Histories, smooth_pa: float = 0.0) -> Peak:
    time, z, point = np.unravel_index(int(np.argmax(field)), field.shape)
    return Peak(
        value_pa=float(field[time, z, point]),
        depth_m=float(histories.depths_m[z]),
        place_m=float(histories.places_m[time]),
        point_m=float(histories.points_m[point]),
        smooth_pa=smooth_pa,
    )


def _even(values: Floats, histories: Histories) -> xr.DataArray:
    """Return values over depth and the evenly spread points."""
    coordinates: Mapping[str, Floats] = {"z": histories.depths_m}
    return xr.DataArray(values[:, : histories.even], coords=coordinates, dims=("z", "point"))
