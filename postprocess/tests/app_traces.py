"""Four surfaces of typical users, their answers to the page, and the equivalent commands."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Example:
    """A surface."""

    path: Path
    """Its file."""
    kind: str
    """How the contact is entered."""
    typed: Mapping[str, str]
    chosen: Mapping[str, str]
    """`typed`, `chosen`: texts of fields and of choices by their labels, in the units that the page
    begins with."""
    command: Sequence[str]
    """Arguments of ``ehlwave deform`` besides the file, in SI."""


def words(text: str) -> list[str]:
    return text.split()


def examples(folder: Path) -> list[Example]:
    """Return them, their files written."""
    generator = np.random.default_rng(7)
    x = np.arange(600) * 1.5
    height = 40 * np.cos(2 * np.pi * x / 73) + 15 * generator.standard_normal(x.size)
    plain, german, packed = (folder / name for name in ("heights.txt", "deutsch.csv", "map.npz"))
    np.savetxt(plain, height, fmt="%.6f")
    rows = (f"{a:.4f};{b:.6f}".replace(".", ",") for a, b in zip(x / 1e3, height, strict=True))
    german.write_text("Weg [mm];Hoehe [nm]\n" + "\n".join(rows) + "\n")
    y = np.arange(64)[:, None] * 4e-6
    waves = 30e-9 * np.cos(2 * np.pi * (np.arange(200) * 2e-6 / 60e-6 + y / 90e-6))
    np.savez_compressed(packed, height=waves, x=np.arange(200) * 2e-6, y=y[:, 0])
    trace = folder / "sputtered_profile.csv"
    trace.write_bytes((ROOT / "inputs/full/sputtered_profile.csv").read_bytes())
    return [
        Example(
            trace,
            "Reduced",
            {
                "Reduced radius along rolling": "12.52",
                "Reduced radius across": "12.52",
                "Reduced modulus E'": "117",
                "Load": "39.2",
                "Mean speed": "0.024",
                "Viscosity": "1220",
                "Pressure coefficient": "22.5",
            },
            {},
            words(
                "--conditions radius_x_m=12.52e-3 radius_y_m=12.52e-3 "
                "reduced_modulus_pa=1.17e11 load_n=39.2 mean_speed_m_per_s=0.024 "
                "viscosity_pa_s=1.22 pressure_viscosity_per_pa=2.25e-8 roelands_index=0.68 "
                "slide_to_roll_ratio=0"
            ),
        ),
        Example(
            plain,
            "M, L, D",
            {
                "Load parameter M": "150",
                "Lubricant parameter L": "8",
                "Ratio D = Rx/Ry": "0.5",
                "Hertz semi-axis a": "0.21",
                "Reduced radius along rolling": "11.3",
                "Step, if not in the file": "1.5",
            },
            {
                "Unit of lengths": "um",
                "Unit of heights": "nm",
                "Measured": "across rolling",
                "Form removed": "quadratic",
            },
            words(
                "--length-unit um --height-unit nm --step 1.5 --rolling-axis y --form "
                "quadratic --conditions load_parameter_m=150 lubricant_parameter_l=8 "
                "radius_ratio_d=0.5 semi_axis_a_m=0.21e-3 radius_x_m=11.3e-3 "
                "pressure_viscosity_per_pa=2.2e-8 roelands_index=0.68 slide_to_roll_ratio=0"
            ),
        ),
        Example(
            german,
            "Line",
            {
                "Reduced radius along rolling": "5",
                "Load per length": "150",
                "Mean speed": "2",
                "Viscosity": "30",
                "Filter: longest wave": "250",
            },
            {"Ends": "taper", "Judged by": "Atlas of computed responses"},
            words(
                "--cutoff 250 --ends taper --conditions radius_x_m=5e-3 "
                "reduced_modulus_pa=2.26e11 load_n_per_m=1.5e5 mean_speed_m_per_s=2 "
                "viscosity_pa_s=0.03 pressure_viscosity_per_pa=2.2e-8 roelands_index=0.68 "
                "slide_to_roll_ratio=0"
            ),
        ),
        Example(
            packed,
            "Reduced",
            {"Slide-to-roll ratio": "0.3", "Eyring stress": "6"},
            {"Flow law": "Ree-Eyring", "Unit of lengths": "m", "Unit of heights": "m"},
            words(
                "--length-unit m --height-unit m --conditions radius_x_m=0.0127 "
                "radius_y_m=0.0127 reduced_modulus_pa=2.26e11 load_n=40 mean_speed_m_per_s=4 "
                "viscosity_pa_s=0.05 pressure_viscosity_per_pa=2.2e-8 roelands_index=0.68 "
                "slide_to_roll_ratio=0.3 eyring_stress_pa=6e6"
            ),
        ),
    ]
