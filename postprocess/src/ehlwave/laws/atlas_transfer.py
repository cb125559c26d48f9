"""Transfer from the atlas: amplitude and phase, and their errors, of each harmonic component."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.formula import recommended_ratio
from ehlwave.contact.line_contact import ROLLS_ALONE
from ehlwave.duals import Dual, count_of, np, part_of, placed, spline, to_float, valued
from ehlwave.errors import RangeError
from ehlwave.laws.atlas.atlas import Atlas, atlas_for, chart_of
from ehlwave.laws.atlas.chart import Chart
from ehlwave.laws.atlas.ranges import WAVE_RANGE
from ehlwave.laws.transfer import EXTRAPOLATED, Transfer, Waves

Complex = NDArray[np.complex128]

WAVES, ANGLES = 72, 61
"""Nodes of the chart that is interpolated for maps, over ln wavelength and angle."""

REFINED = 4
"""Times as fine is the chart made by splines, so that lines between its points do for millions of
waves: they are off the splines by less than 1e-4."""

SHORT_WAVE_POWER = 1.5
"""Waves below the atlas: 1 - response falls with this power of the wavelength, as it does above."""


@dataclass(frozen=True)
class Found:
    """Responses to some waves, arrays of their shape."""

    ratio: Complex
    error: Waves
    rise: Waves
    is_covered: NDArray[np.bool_]


class AtlasTransfer(Transfer):
    """Film responses of the atlas for a contact that rolls, or slides in a Ree-Eyring oil.

    Waves shorter than the atlas have nearly their whole amplitude: 1 - T continues with the power
    3/2 of the wavelength. Longer waves have almost none: T falls as the recommended formula does.
    For both the error is as large as the continuation, so that the total error includes them.
    """

    def __init__(self, conditions: Conditions, atlas: Atlas | None = None) -> None:
        """Draw the chart of the contact.

        Raises RangeError (a ValueError) if the contact lies outside the atlas, slides in an oil
        that is not Ree-Eyring's, or the oil has laws of viscosity or density that the atlas does
        not.
        """
        if conditions.is_line and not conditions.has_atlas:
            raise RangeError(ROLLS_ALONE)
        if not conditions.has_atlas:
            raise RangeError(
                f"slip_parameter = {conditions.slip_parameter:g}: the atlas holds sliding contacts "
                "with Ree-Eyring oils only: give eyring_stress_pa, name the law of the two waves, "
                "or give a harmonic table of this slip"
            )
        self._conditions = conditions
        self._atlas = atlas_for(conditions, atlas)
        self._chart: Chart = chart_of(conditions, atlas)
        self._lookups: dict[str, Callable[[Waves, Waves], Waves]] = {}
        """Film, real and imaginary, its error, and the rise of the mean film."""
        self._asked: tuple[Waves, Waves] | None = None

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for pickling, without caches."""
        kept = {name: value for name, value in vars(self).items() if name != "_found"}
        return kept | {"_lookups": {}, "_asked": None}

    @property
    def name(self) -> str:
        """Return its description."""
        return self._atlas.name

    @property
    def outside_reason(self) -> str:
        """Why components are not covered."""
        low, high = WAVE_RANGE
        return f"outside {low:g} to {high:g} a{EXTRAPOLATED}"

    @property
    def smooth_from(self) -> float:
        """Waves per metre of the shortest waves of the atlas."""
        return 1 / (WAVE_RANGE[0] * self._conditions.semi_axis_a_m)

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> Complex:
        """Return the transfer for waves per metre along x (any sign) and y; 0 for the mean."""
        return self._find(per_length_x, per_length_y).ratio.copy()

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves:
        """Return the error of the transfer, absolute, in units of the amplitude before."""
        return self._find(per_length_x, per_length_y).error

    def pressure(self, per_length_x: Waves, per_length_y: Waves) -> Complex:
        """Return the pressure over Ai in units of ph/c, for waves within the atlas."""
        wave, angle, shape = self._polar(per_length_x, per_length_y)
        found: Complex = self._chart.responses(wave, angle).pressure.reshape(shape)
        return found

    def rise(self, per_length_x: Waves, per_length_y: Waves) -> Waves:
        """Return the rise of the mean film by waves, to second order.

        Shorter waves than the atlas' add as much as its shortest; longer waves less, as the square
        of their response.
        """
        return self._find(per_length_x, per_length_y).rise

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether a wave lies within the wavelengths of the atlas."""
        return self._find(per_length_x, per_length_y).is_covered

    def _find(self, per_length_x: Waves, per_length_y: Waves) -> Found:
        """Return everything at once; the last arrays are cached."""
        asked = per_length_x, per_length_y
        if not (self._asked and all(a is b for a, b in zip(asked, self._asked, strict=True))):
            self._found = self._evaluate(*asked)
            self._asked = asked
        return self._found

    def _evaluate(self, per_length_x: Waves, per_length_y: Waves) -> Found:
        wave, angle, shape = self._polar(per_length_x, per_length_y)
        lowest, highest = WAVE_RANGE
        inside = np.clip(wave, lowest, highest)
        real, imaginary, error, rise = self._lookup(angle)(np.log(inside), angle)
        error = np.maximum(valued(error), 0)
        short, long = wave < lowest, wave > highest
        if np.any(short):
            kept = np.minimum(wave / lowest, 1.0) ** SHORT_WAVE_POWER
            real, imaginary = 1 - (1 - real) * kept, imaginary * kept
            error += np.where(short, np.abs(1 - valued(real) + 1j * valued(imaginary)), 0.0)
        if np.any(long):
            fall = self._fall(wave, inside, angle)
            real, imaginary, rise = fall * real, fall * imaginary, fall**2 * rise
            error += np.where(long, np.abs(valued(real) + 1j * valued(imaginary)), 0.0)
            error[~np.isfinite(valued(wave))] = 0  # the mean is not deformed
        turn = np.sign(per_length_x)
        return Found(
            real.reshape(shape) + 1j * (imaginary.reshape(shape) * turn),
            error.reshape(shape),
            rise.reshape(shape),
            ~(short | long).reshape(shape),
        )

    def _polar(
        self, per_length_x: Waves, per_length_y: Waves
    ) -> tuple[Waves, Waves, tuple[int, ...]]:
        """Return wavelengths over a and angles, degrees, of flattened waves, and their shape."""
        qx, qy = np.broadcast_arrays(np.abs(per_length_x), np.abs(per_length_y))
        with np.errstate(divide="ignore"):
            wave = 1 / (np.sqrt(qx**2 + qy**2) * self._conditions.semi_axis_a_m)
        wave, angle = wave.ravel(), np.degrees(np.arctan2(valued(qy), valued(qx))).ravel()
        angle[~np.isfinite(valued(wave))] = angle[-1]  # the mean has no direction
        return wave, angle, qx.shape

    def _fall(self, wave: Waves, inside: Waves, angle: Waves) -> Waves:
        """Return by how much less than at the end of the atlas is left of longer waves."""
        long = wave > inside
        if not np.any(long):
            return np.ones(wave.shape)
        wave, inside = wave[long], inside[long]
        c, theta = self._conditions, np.radians(angle[long])
        shares = np.cos(theta), np.sin(theta)
        at, end = (
            recommended_ratio(
                c.m,
                c.l,
                c.slender_gamma,
                *(np.where(s > 1e-9, w / np.maximum(s, 1e-9), 0) for s in shares),
            )
            for w in (np.minimum(wave, 1e9), inside)
        )
        return placed(long, np.where(np.isfinite(wave), at / end, 0), 1.0)

    def _lookup(self, angle: Waves) -> Callable[[Waves, Waves], Waves]:
        """Return the parts of the chart over ln wavelength and angle, or along a single angle."""
        one = to_float(angle[-1]) if np.all(angle == angle[-1]) else None
        key = "map" if one is None else f"{one:g}"
        if key not in self._lookups:
            logs = np.linspace(*np.log(WAVE_RANGE), WAVES)
            angles = np.linspace(0, 90, ANGLES) if one is None else np.array([one])
            waves = np.exp(logs)[:, None], angles[None, :]
            found = self._chart.responses(*waves)
            parts = [found.film.real, found.film.imag, found.error, found.rise]
            if one is None:
                self._lookups[key] = _between(logs, angles, parts)
            else:
                fine = np.linspace(logs[0], logs[-1], REFINED * (WAVES - 1) + 1)
                curves = [spline(logs, part[:, 0], fine) for part in parts]
                self._lookups[key] = lambda log, _: [
                    np.interp(log, fine, curve) for curve in curves
                ]
        return self._lookups[key]


def _between(logs: Waves, angles: Waves, parts: list[Waves]) -> Callable[[Waves, Waves], Waves]:
    """Return interpolation in tables over ln wavelength (rows) and angle, both evenly spaced."""
    rows, columns = (np.linspace(a[0], a[-1], REFINED * (a.size - 1) + 1) for a in (logs, angles))
    step, count = rows[1] - rows[0], count_of(parts)
    every = [*map(valued, parts), *(part_of(part, k) for k in range(count) for part in parts)]
    along, across = (_spline_weights(nodes.size) for nodes in (logs, angles))
    tables = [along @ part @ across.T for part in every]

    def interpolate(log: Waves, angle: Waves) -> Waves:
        u, v = (valued(log) - rows[0]) / step, angle / (columns[1] - columns[0])
        i = np.clip(np.floor(u), 0, rows.size - 2)
        j = np.clip(np.floor(v), 0, columns.size - 2)
        first = (i * columns.size + j).astype(np.intp)
        u -= i
        v -= j
        found = _along_rows(tables, first, v)
        if not count and not np.any(u):  # all on a row, as waves shorter than the atlas
            return found
        rise = _along_rows(tables, first + columns.size, v) - found
        if not count:
            rise *= u
            found += rise
            return found
        slopes = (found + rise * u).reshape(1 + count, len(parts), -1)
        by_log = rise[: len(parts)] / step
        return Dual(slopes[0], slopes[1:]) + by_log * (log - valued(log))  # type: ignore[return-value]

    return interpolate


def _spline_weights(count: int) -> Waves:
    """Return weights of values at even nodes in their cubic spline, `REFINED` times as fine.

    The third derivative is continuous at the nodes next to the ends. Plain arrays: the import of
    splines takes as long as a large map.
    """
    second = np.diff(np.eye(count), 2, axis=0)
    system = np.eye(count) * 4 + np.eye(count, k=1) + np.eye(count, k=-1)
    system[[0, -1]] = 0
    system[0, :3] = system[-1, -3:] = 1, -2, 1
    curvature = np.linalg.solve(system, np.pad(6 * second, ((1, 1), (0, 0))))
    share = np.arange(REFINED * (count - 1) + 1) / REFINED
    left = np.minimum(share.astype(int), count - 2)
    v = (share - left)[:, None]
    u, node = 1 - v, np.eye(count)
    return np.asarray(
        u * node[left]
        + v * node[left + 1]
        + ((u**3 - u) * curvature[left] + (v**3 - v) * curvature[left + 1]) / 6
    )


def _along_rows(tables: list[Waves], first: NDArray[np.intp], share: Waves) -> Waves:
    """Return values between neighbours of the flattened tables, shape (tables, places)."""
    found, second = np.empty((len(tables), first.size)), first + 1
    for table, own in zip(tables, found, strict=True):
        flat = table.ravel()
        low = flat.take(first)
        np.subtract(flat.take(second), low, out=own)
        own *= share
        own += low
    return found
