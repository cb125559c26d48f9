"""From points to the atlas: networks of films, responses and their errors."""

import json
from collections.abc import Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import replace
from itertools import repeat

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.laws.atlas.atlas import FORMAT_NAME, ranges_text
from ehlwave.laws.atlas.chart import with_contacts
from ehlwave.laws.atlas.committee import Committee
from ehlwave.laws.atlas.kinds import KINDS, Kind
from ehlwave.laws.atlas.sliding_shape import SlidingShape
from studies.atlas.losses import Errors, Films, Task, Waves, part
from studies.atlas.points import contact_of, film_numbers, waves_of
from studies.atlas.store import variables_of
from studies.atlas.train import Recipe, fitted, joined

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]
Rows = NDArray[np.intp]

FOLDS = 5
"""Parts of the contacts that are left out in turn."""

JUDGED_NETWORKS = 2
"""Where contacts are left out: bars come from fewer networks than the answer, which err more."""

COVERED = 0.975
"""Share of held-out predictions within error bars."""

LEAST_MISS = 1e-5
"""Smaller misses are no better: they are within the error of the computation."""

OF_WAVES = {
    "rolling": Recipe(networks=5, hidden=64, steps=3000, decay=1e-6),
    "rolling_wide": Recipe(networks=5, hidden=64, steps=2000, decay=1e-6),
    "sliding": Recipe(networks=7, hidden=64, steps=3000, decay=1e-5),
    "sliding_wide": Recipe(networks=3, hidden=44, steps=1500, decay=1e-5),
    "line": Recipe(networks=5, hidden=32, steps=3000, decay=1e-6),
    "line_sliding": Recipe(networks=5, hidden=32, steps=2500, decay=1e-5),
    "line_newtonian": Recipe(networks=3, hidden=32, steps=2500, decay=1e-5),
}
OF_FILMS = {
    "sliding_wide": Recipe(networks=3, hidden=24, steps=1500, decay=1e-6),
    "line_sliding": Recipe(networks=4, hidden=32, steps=2500, decay=1e-6),
    "line_newtonian": Recipe(networks=3, hidden=12, steps=500, decay=1e-6),
}
"""Newtonian films of lines equal films in rolling: only the pressure is learned."""
OF_OTHER_FILMS = Recipe(networks=5, hidden=24, steps=1500, decay=1e-6)
OF_ERRORS = Recipe(networks=5, hidden=12, steps=200, decay=1e-4)
FEWER_ERRORS = {"sliding_wide": 3, "line": 3, "line_sliding": 3, "line_newtonian": 3}
"""Networks of errors of files that have to be small."""


def finished(data: xr.Dataset, workers: int = 1) -> xr.Dataset:
    """Return the atlas of points of :func:`studies.atlas.points.read_points`.

    Networks are fitted by `workers` processes.
    """
    kind = KINDS[data.attrs["kind"]]
    of_contact = contact_of(data)
    # Anchors are no measure of errors.
    own = data.get("is_computed", xr.ones_like(data["responses"])).values.astype(bool)
    own_points = own[of_contact]
    discretised = [f"{name}_discretisation" for name in kind.films]
    fold = np.random.default_rng(11).permutation(data.sizes["contact"]) % FOLDS
    of_films = OF_FILMS.get(kind.name, OF_OTHER_FILMS)
    of_errors = replace(OF_ERRORS, networks=FEWER_ERRORS.get(kind.name, OF_ERRORS.networks))
    films = Films(kind.coordinates(data), film_numbers(data, kind.films))
    with ProcessPoolExecutor(workers) as pool:
        predicted = _left_out(pool, films, of_films, fold)
        film_misses = np.abs(predicted - films.numbers)
        waves = waves_in(data, kind, films, predicted)
        numbers = _left_out(pool, waves, OF_WAVES[kind.name], fold[of_contact])
        wave_misses = np.abs(waves.missed(numbers))
        found = {
            "films": _of_all(pool, films, of_films),
            "waves": _of_all(pool, waves, OF_WAVES[kind.name]),
        }
        found["film_errors"], film_factors = _bars(
            pool,
            films.inputs[own],
            np.hypot(film_misses, film_numbers(data, discretised))[own],
            fold[own],
            of_errors,
        )
        found["wave_errors"], of_waves = _bars(
            pool,
            waves.inputs[own_points],
            np.hypot(wave_misses, data["discretisation"].values)[own_points, None],
            fold[of_contact][own_points],
            of_errors,
        )
    rises = np.abs(numbers[:, -1] - waves.rise)[own_points]
    judged = {
        "cross_validated": wave_misses[own_points],
        "film_cross_validated": film_misses[own, 0],
        "rise_cross_validated": rises[np.isfinite(rises)],
    }
    attributes = {name: json.dumps(_quantiles(values)) for name, values in judged.items()}
    data = xr.Dataset(
        attrs=attributes
        | {
            "format": FORMAT_NAME,
            "kind": kind.name,
            "ranges": ranges_text(kind),
            "contacts": int(own.sum()),
            "responses": int(own_points.sum()),
            "film_errors_factors": json.dumps(film_factors),
            "wave_errors_factors": json.dumps(of_waves),
            "program": "ehlwave {program_version}, revision {git_revision}".format(**data.attrs),
        }
    )
    for name, committee in found.items():
        data = data.assign(variables_of(name, committee))
    return data


def waves_in(data: xr.Dataset, kind: Kind, films: Films, predicted: Floats) -> Waves:
    """Return responses as the atlas sees them, where films of contacts are those `predicted`."""
    of_contact, waves = contact_of(data), waves_of(data)
    names = dict(zip(kind.films, predicted.T, strict=True))
    columns = {name: data[name].values for name in kind.ranges}
    shape = kind.shape(kind.state(columns, data["references"].values, names))[of_contact]
    if isinstance(shape, SlidingShape):
        shape = shape.with_rolling(shape.rolling_responses(*waves))
    seen, film = shape.seen(*waves), data["film"].values
    return Waves(
        with_contacts(films.inputs[of_contact], seen.coordinates),
        seen,
        film,
        seen.pressure_left(film, data["pressure"].values),
        data["mean_rise"].values,
    )


def _left_out(pool: Executor, task: Task, recipe: Recipe, fold: Rows) -> Floats:
    """Return numbers, each predicted by networks that have not seen its contact."""
    left = [fold == one for one in range(FOLDS)]
    parts = (part(task, ~out) for out in left)
    seeds = repeat(range(JUDGED_NETWORKS))
    committees = pool.map(_of_part, parts, repeat(task.scales), repeat(recipe), seeds)
    found = np.empty((fold.size, task.scales.size))
    for out, committee in zip(left, committees, strict=True):
        found[out] = committee(task.inputs[out])
    return found


def _of_all(pool: Executor, task: Task, recipe: Recipe) -> Committee:
    """Return the networks of all points."""
    seeds = ([seed] for seed in range(recipe.networks))
    return joined(*pool.map(_of_part, repeat(task), repeat(task.scales), repeat(recipe), seeds))


def _of_part(task: Task, scales: Floats, recipe: Recipe, seeds: Sequence[int]) -> Committee:
    return fitted(task.inputs, task.loss, scales, recipe, seeds)


def _bars(
    pool: Executor, inputs: Floats, misses: Floats, fold: Rows, recipe: Recipe
) -> tuple[Committee, list[float]]:
    """Return networks of ln of some misses, and the factor of bars that cover the given share.

    The factors are of misses of contacts whose bars are found from others.
    """
    task = Errors(inputs, np.maximum(misses, LEAST_MISS))
    logs = _left_out(pool, task, recipe, fold)
    factors = np.quantile(misses / np.exp(logs), COVERED, axis=0)
    return _of_all(pool, task, recipe), [round(float(factor), 3) for factor in factors]


def _quantiles(misses: Floats) -> dict[str, float]:
    """Return median, 95th percentile and largest of some misses."""
    shares = {"median": 0.5, "95 %": 0.95, "all": 1.0}
    return {name: float(f"{np.quantile(misses, share):.3g}") for name, share in shares.items()}
