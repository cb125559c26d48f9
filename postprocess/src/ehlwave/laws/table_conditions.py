"""Which operating conditions of a harmonic table represent a contact, and their weights."""

import numpy as np
import pandas as pd
import scipy
from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.errors import SurfaceError
from ehlwave.laws.table_matching import LARGEST_DIFFERENCE, matching_rows
from ehlwave.laws.table_read import CONDITION_COLUMNS

Floats = NDArray[np.float64]


def weighted_conditions(
    rows: pd.DataFrame, conditions: Conditions, name: str
) -> list[tuple[float, pd.DataFrame]]:
    """Return rows of the conditions to interpolate between, and their weights, which add up to 1.

    The contact's own condition alone, if the table has it to 1 per cent. Otherwise linear
    interpolation in (log M, log L, log D), in as many directions as the table's conditions span: a
    table of a contact at several speeds spans one.

    Raises SurfaceError if the contact does not lie among the table's conditions of the same slip
    and oil; line contacts.
    """
    if conditions.is_line:
        raise SurfaceError(f"{name}: harmonic tables are for elliptical contacts, D of 0.005 to 1")
    same_slip = np.abs(rows["slip_parameter"] - conditions.slip_parameter) < 1e-6
    columns = list(CONDITION_COLUMNS)
    chosen = matching_rows(rows[same_slip], conditions, name) if same_slip.any() else rows[:0]
    groups = [part for _, part in chosen.groupby(columns, sort=True)]
    points = np.log([part[columns].iloc[0].to_numpy(float) for part in groups]).reshape(-1, 3)
    target = np.log([conditions.m, conditions.l, conditions.d])
    if groups:
        distance = np.abs(points - target).max(axis=1)
        nearest = int(np.argmin(distance))
        if distance[nearest] <= LARGEST_DIFFERENCE:
            return [(1.0, groups[nearest])]
    found = _barycentric(points, target)
    if found is None:
        raise SurfaceError(_message(rows, conditions, name, points, target))
    return [(weight, groups[index]) for index, weight in found]


def _barycentric(points: Floats, target: Floats) -> list[tuple[int, float]] | None:
    """Return indices and weights of the simplex about the target; None outside all of them."""
    if len(points) < 2:
        return None
    centre = points.mean(axis=0)
    _, sizes, directions = np.linalg.svd(points - centre, full_matrices=False)
    rank = int(np.sum(sizes > LARGEST_DIFFERENCE))
    basis = directions[:rank]
    flat, place = (points - centre) @ basis.T, basis @ (target - centre)
    if np.abs(target - centre - place @ basis).max() > LARGEST_DIFFERENCE or rank == 0:
        return None
    if rank == 1:
        order = np.argsort(flat[:, 0])
        index = int(np.searchsorted(flat[order, 0], place[0]))
        if not 0 < index < len(points):
            return None
        low, high = int(order[index - 1]), int(order[index])
        share = float((place[0] - flat[low, 0]) / (flat[high, 0] - flat[low, 0]))
        return [(low, 1 - share), (high, share)]
    mesh = scipy.spatial.Delaunay(flat)
    simplex = int(mesh.find_simplex(place))
    if simplex < 0:
        return None
    transform = mesh.transform[simplex]
    weights = transform[:rank] @ (place - transform[rank])
    corners = mesh.simplices[simplex]
    shares = [*weights, 1 - weights.sum()]
    return [(int(corner), float(share)) for corner, share in zip(corners, shares, strict=True)]


def _message(
    rows: pd.DataFrame, conditions: Conditions, name: str, points: Floats, target: Floats
) -> str:
    wanted = (
        f"M = {conditions.m:.5g}, L = {conditions.l:.5g}, D = {conditions.d:.5g}, "
        f"S = {conditions.slip_parameter:g}"
    )
    if len(points) == 0:
        slips = ", ".join(f"{slip:g}" for slip in sorted(set(rows["slip_parameter"])))
        return f"{name}: does not hold {wanted}: its slip parameters are {slips or 'none'}"
    near = np.exp(points[np.argmin(np.abs(points - target).max(axis=1))])
    return (
        f"{name}: {wanted} does not lie among its {len(points)} condition(s), the nearest being "
        f"M = {near[0]:.5g}, L = {near[1]:.5g}, D = {near[2]:.5g}: compute a table for this "
        "contact, or use the formula"
    )
