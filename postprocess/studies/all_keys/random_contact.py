"""A random contact, and files of its surface and oil: several keys of an input follow from it."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ehlwave.writing import Writer

MODULUS_PA = 2.26e11
AMBIENT_K = 313.15


@dataclass
class Contact:
    """Random choices before the keys, because several keys follow from them."""

    rng: np.random.Generator
    folder: Path
    """Where measured surfaces are put."""

    def __post_init__(self) -> None:
        """Draw the contact."""
        self.m = self.power(6, 300)
        self.l = 0.0 if self.chance(0.03) else self.between(1, 18)
        self.is_line = self.chance(0.12)
        self.d = 0.0 if self.is_line else self.power(0.01 if self.chance(0.1) else 0.05, 1)
        self.has_surface = self.chance(0.04) and not self.is_line
        self.is_dimensional = self.has_surface or (self.l > 0 and self.chance(0.25))
        self.alpha = self.power(5e-9, 4e-8) if self.chance(0.4) else 2.2e-8
        if self.is_dimensional:
            self.m, self.l = self.power(20, 300), self.between(3, 15)
        self.accuracy = self.power(0.01, 0.2) if self.chance(0.35) else None
        self.is_warm = self.is_dimensional and not self.has_surface and self.chance(0.3)
        # from a stream of its own, so that it changes no other key
        scheme = self.rng.spawn(1)[0].integers(10)
        self.scheme = {0: "auto", 1: "averaged", 2: "fitted", 3: "fitted"}.get(int(scheme))
        warm = self.rng.spawn(1)[0].integers(0, 6, 3)
        self.has_warm_waves = self.is_warm and warm[0] < 3
        self.warm_law = "doolittle" if self.is_warm and warm[1] == 0 else None
        self.carries_heat = self.has_warm_waves and warm[2] < 3

    def chance(self, share: float) -> bool:
        """Return True in that share of the calls."""
        return bool(self.rng.random() < share)

    def between(self, low: float, high: float) -> float:
        """Return a number of four digits."""
        return float(f"{low + (high - low) * self.rng.random():.4g}")

    def power(self, low: float, high: float) -> float:
        """Return a number whose logarithm is uniform."""
        return float(f"{low * (high / low) ** self.rng.random():.4g}")

    def one_of(self, *choices: Any) -> Any:  # noqa: ANN401 - a choice
        """Return a random choice."""
        return choices[int(self.rng.integers(len(choices)))]

    def data(self) -> dict[str, float]:
        """Return dimensional data of the contact: Rx = 10 mm, eta0 = 0.04 Pa s."""
        radius, viscosity = 0.01, 0.04
        speed = 0.5 * (self.l / (self.alpha * MODULUS_PA)) ** 4
        u2 = 2 * speed
        data = {"radius_x_m": radius, "viscosity_pa_s": viscosity}
        data["mean_speed_m_per_s"] = speed * MODULUS_PA * radius / viscosity
        if self.is_line:
            data["load_n_per_m"] = self.m * MODULUS_PA * radius * u2**0.5
        else:
            data["radius_y_m"] = radius / self.d
            data["load_n"] = self.m * MODULUS_PA * radius**2 * u2**0.75
        return {name: float(f"{value:.6g}") for name, value in data.items()}

    def surface(self) -> str:
        """Write a measured surface about 1.5 a long and return its path."""
        path = self.folder / f"surface-{self.rng.integers(1 << 31)}.h5"
        data = self.data()
        half_width = (1.5 * data["load_n"] * 0.01 / MODULUS_PA) ** (1 / 3)
        points = 24
        step = 1.5 * half_width / points
        phase = 2 * np.pi * np.arange(points) / points
        height = sum(np.cos(n * phase + 6 * self.rng.random()) / n for n in (1, 2, 3))
        height *= np.sin(np.pi * np.arange(points) / (points - 1)) ** 2  # nothing enters as a step
        heights = 1e-9 * self.power(1, 20) * np.array([height])
        surface = xr.Dataset(
            {"height": (("y", "x"), heights)}, coords={"x": step * np.arange(points), "y": [0.0]}
        )
        return str(Writer().dataset(path, surface))

    def viscosities(self) -> str:
        """Write a table of viscosities, close to Roelands' law, and return its path."""
        z, coefficient = self.between(0.5, 0.7), self.power(0.02, 0.05)
        rows = ["pressure_pa,temperature_k,viscosity_pa_s"]
        for rise in (0.0, 25.0, 50.0):
            for pressure in np.concatenate([[0, 2e7, 5e7], np.linspace(1e8, 4e9, 30)]):
                grown = self.alpha * 1.96e8 / z * ((1 + pressure / 1.96e8) ** z - 1)
                viscosity = 0.04 * np.exp(grown - coefficient * rise)
                rows.append(f"{pressure:.6g},{AMBIENT_K + rise},{viscosity:.6g}")
        name = f"viscosities-{self.rng.integers(1 << 31)}.csv"
        return str(Writer().text(self.folder / name, "\n".join(rows) + "\n"))

    def layers(self) -> str:
        """Write a layer of oil that varies across and return its path."""
        rows = ["y_over_b,layer_over_given"]
        rows += [f"{y},{self.between(0.3, 1)}" for y in (0.0, 0.5, 1.0, 1.5)]
        name = f"layers-{self.rng.integers(1 << 31)}.csv"
        return str(Writer().text(self.folder / name, "\n".join(rows) + "\n"))
