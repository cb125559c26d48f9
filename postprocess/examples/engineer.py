"""A ball on a disc and a stylus trace: film, lambda ratio, and how far they can be trusted.

    python engineer.py [TRACE]

Without a trace, it makes one with the preamble of a roughness tester. It needs this package alone.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

import ehlwave
from ehlwave.surface import report_text

contact = ehlwave.Contact(
    radius_x_m=12.52e-3,
    radius_y_m=12.52e-3,
    reduced_modulus_pa=1.17e11,
    load_n=39.2,
    mean_speed_m_per_s=0.096,
    viscosity_pa_s=1.22,
    pressure_viscosity_per_pa=2.25e-8,
    roelands_index=0.484,
)
film = contact.film()
print(contact)
for name in ("central", "minimum"):
    height, error = getattr(film, f"{name}_m"), getattr(film, f"{name}_error")
    print(f"{name} film {1e6 * height:.3f} um within {100 * error:.1f} %")
print()

for length in (0.25, 0.5, 1.0):
    wave = contact.response(wavelength_over_a=length)
    print(
        f"waves of {length:g} a keep {abs(wave.film):.3f} of their height, error {wave.error:.3f}"
    )

if len(sys.argv) > 1:
    trace = Path(sys.argv[1])
else:
    x = np.arange(0, 1.2, 0.5e-3)
    height = 0.03 * np.cos(2 * np.pi * x / 0.06) + 0.004 * np.cos(2 * np.pi * x / 0.017 + 1)
    lines = [
        f"{a:.4f}\t{b + 0.1 * a:.5f}".replace(".", ",") for a, b in zip(x, height, strict=True)
    ]
    trace = Path(tempfile.mkdtemp(), "trace.txt")
    head = "Roughness tester\nDate\t22.11.2026\n\nPosition\tProfile\n[mm]\t[um]\n"
    trace.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")

found = contact.deform(trace)
ratio, error = found.statistics.lambda_ratio_after, found.statistics.lambda_error
print(
    f"\nlambda ratio {ratio:.3g} within {100 * error:.2g} %, by the paper's formula "
    f"{contact.lambda_ratio(trace, by='paper'):.3g}\n"
)
print(report_text(found))
