"""Mean film of rough surfaces in pure rolling, beyond the second-order rise: theory eq. (Z7).

Both surfaces move at one speed, so the roughness is at rest in their frame and the oil there is
driven by pressure alone. Averaged over the roughness it flows as in a smooth gap H times the flow
factor phi(H) = <h^-3>^(-s) <h^3>^(1-s) / H^3, h = max(H - r, H_b), with the deformed heights r and
a boundary film H_b. This is exact for transverse (s = 1) and longitudinal (s = 0) roughness at
rest in a parallel gap.

The inlet of a heavily loaded contact (Ertel and Grubin) has the gap H + g, where g grows as the
power 3/2 of the distance to the contact. It builds up the same reduced pressure with and without
roughness:

    int (<h>(H + g) - <h>(H)) / ((H + g)^3 phi(H + g)) dx = int g / (H_0 + g)^3 dx

with the smooth film H_0. To second order <h> rises by (7/4 s - 7/12) <r^2>/H_0. Linear responses
give the rise of every component to second order, with elastic deformation in the inlet: s is
chosen so that both agree. The film is hardly sensitive to H_b, as crests lift it.
"""

from ehlwave.duals import Dual, np, root, to_float, valued
from ehlwave.error_bars import bar
from ehlwave.surface.surface import Heights

BINS = 400
"""Classes of heights."""

_LOG_GAPS = np.linspace(-10, 9, 160)
_GAPS = np.exp(_LOG_GAPS)
"""Gaps of the inlet over the smooth film."""

_STRETCH = _GAPS ** (2 / 3)
"""Distance to the contact, dx = x d ln(g) apart from a factor."""

_HIGHEST = 100.0
"""Largest H over the smooth film."""

TRANSVERSE, LONGITUDINAL = 7 / 6, -7 / 12
"""Second-order rise times the smooth film over the mean square of the heights."""

LARGEST_RATIO, HIGHEST_CREST, LARGEST_SHARE = 2.0, 2.1, 1.2
"""Rq before deformation over the smooth film, highest crest over the deformed Rq, and s, up to
which films were compared with marches. Rare high crests of random roughness would lift the film too
much: they pass the inlet only now and then.
"""

SMALL_RISE = 0.1
"""Second-order rise over the smooth film up to which it is used as it is."""

FLOOR = 0.02
"""Boundary film over the smooth film where none is given."""


def averaged_error(rq: float, *, is_line: bool) -> float:
    """Return the relative error of the mean film; `rq` deformed, over the smooth film."""
    shape = "line" if is_line else "point"
    return bar(f"averaged_film.{shape}") + bar(f"averaged_film.{shape}_by_square") * rq**2


def is_covered(ratio: float, crest: float, rq: float, rise: float) -> bool:
    """Return whether such roughness was compared with marches.

    Parameters
    ----------
    ratio : float
        Rq before deformation over the smooth film.
    crest, rq : float
        Highest crest above the mean, and Rq, of the deformed heights over the smooth film.
    rise : float
        Second-order rise of the mean film, over the smooth film.
    """
    return (
        ratio <= LARGEST_RATIO
        and 0 < crest <= HIGHEST_CREST * rq
        and 0 <= _share(rise, rq) <= LARGEST_SHARE
    )


def _share(rise: float, rq: float) -> float:
    return (rise / rq**2 - LONGITUDINAL) / (TRANSVERSE - LONGITUDINAL)


def averaged_film(heights: Heights, rise: float, boundary: float = FLOOR) -> float:
    """Return the mean film <h>(H) over the smooth film.

    Parameters
    ----------
    heights : array
        Deformed heights, over the smooth film; any shape.
    rise : float
        Second-order rise of the mean film, over the smooth film.
    boundary : float
        Boundary film over the smooth film, above 0.
    """
    about_mean = heights - to_float(np.mean(heights, dtype=np.float64))
    share = _share(rise, to_float(np.std(heights, dtype=np.float64)))
    counts, edges = np.histogram(-valued(about_mean), BINS)
    gain, weight = 0.5 * (edges[1:] + edges[:-1]), counts / counts.sum()
    if isinstance(about_mean, Dual):  # a class moves as its heights do on average
        place = np.clip(np.searchsorted(edges, -about_mean.value.ravel(), "right") - 1, 0, BINS - 1)
        moved = [np.bincount(place, -one.ravel(), BINS) for one in about_mean.slopes]
        gain = Dual(gain, np.stack(moved) / np.maximum(counts, 1))
    smooth = float((_GAPS * (1 + _GAPS) ** -3 * _STRETCH).sum())

    def mean_film(film: float) -> float:
        return to_float(np.maximum(film + gain, boundary) @ weight)

    def excess(film: float) -> float:
        gap = np.maximum((film + _GAPS)[:, None] + gain, boundary)
        resistance = (gap**-3.0 @ weight) ** share * (gap**3 @ weight) ** (share - 1)
        wedge = gap @ weight - mean_film(film)
        return to_float(np.log((wedge * resistance * _STRETCH).sum() / smooth))

    return mean_film(root(excess, boundary - gain[-1], _HIGHEST))
