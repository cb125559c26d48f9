"""Derivatives of the lambda ratio by a contact's data: of its film, its responses and its rises.

Deformed heights are linear in the responses. Their derivatives are a sum of the same components
times the derivatives of the responses.
"""

import copy
from collections.abc import Sequence
from typing import Any

from ehlwave.duals import Dual, np
from ehlwave.laws.transfer import Transfer
from ehlwave.surface.averaged_film import FLOOR, averaged_film
from ehlwave.surface.pair import pair_statistics
from ehlwave.surface.predict import Deformed
from ehlwave.surface.prepare import judged_part
from ehlwave.surface.superposition import blocks_of, components_of


def lambda_with_slopes(
    found: Sequence[Deformed],
    film: Any,  # noqa: ANN401 - a Dual
    transfers: Sequence[Transfer],
) -> Any:  # noqa: ANN401
    """Return the lambda ratio with its derivatives.

    Parameters
    ----------
    found : sequence of Deformed
        The surface, or both, deformed.
    film : Dual
        Smooth film of the contact, m.
    transfers : sequence of Transfer
        Of the same contact, with derivatives.
    """
    both = [_roughness_and_rise(*one, film) for one in zip(found, transfers, strict=True)]
    rises = [rise for _, rise in both]
    if len(found) > 1 and pair_statistics(found[0], found[1]).extrapolated:
        rises = []
    return (film + sum(rises)) / np.sqrt(sum(rq**2 for rq, _ in both))


def _roughness_and_rise(found: Deformed, transfer: Transfer, film: Any) -> tuple[Any, Any]:  # noqa: ANN401
    """Return Rq of the deformed heights and the rise of the mean film, m, with derivatives."""
    flat, window, count = found.surface, found.window, len(film.slopes)
    parts = components_of(flat.height, flat, window)
    changed = [copy.deepcopy(parts) for _ in range(count)]
    mean_square, risen = 0.0, 0.0
    for block in blocks_of(parts):
        along, across = parts.qx[block, None], parts.qy[None, :]
        ratio: Any = transfer.ratio(along, across)
        for k, one in enumerate(changed):
            one.multiply(block, ratio.slopes[k] if isinstance(ratio, Dual) else 0 * ratio)
        before = parts.mean_squares(block)
        if block.start == 0:
            before[0, 0] = 0
        mean_square += before.sum()
        if found.statistics.mean_rise_by:
            risen = risen + 2 * (transfer.rise(along, across) * before).sum()
    part = judged_part(flat.height.shape, window)
    after = Dual(found.height[part], np.stack([one.total()[part] for one in changed]))
    statistics = found.statistics
    rise = risen / (mean_square or 1.0) * (statistics.rq_before_m / film) ** 2
    if statistics.mean_rise_by == "averaged flow":
        boundary = (statistics.boundary_film_m or 0.0) / film
        rise = averaged_film(after / film, rise, boundary or FLOOR) - 1
    return np.sqrt(np.square(after - after.mean()).mean()), rise * film
