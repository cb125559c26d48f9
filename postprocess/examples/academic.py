"""A small study with the built programs: responses against wavelength, beside the atlas.

    python academic.py [RESULTS.h5]

Needs ehlwave-case and ehlwave-sweep: on PATH, in the build tree, or in the folder EHLWAVE_PROGRAMS.
"""

import sys
from pathlib import Path

import ehlwave

moes = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}
case = ehlwave.Case(**moes, orientation="transverse", wavelength_over_a=1, accuracy=0.01)
plan = case.plan()
print(f"for 1 % the program would take {plan['cells_x']} x {plan['cells_y']} cells")

study = ehlwave.Study(
    {"wavelength_over_a": [0.5, 1.0, 2.0]},
    **moes,
    orientation="transverse",
    response="harmonic",
    accuracy=0.01,
)
results = study.run(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
contact = ehlwave.Contact(**moes)
print("lambda/a   computed          error    atlas             error    difference   status")
for one in range(results.sizes["case"]):
    row = results.isel(case=one)
    wave = float(row["wavelength_x_over_a"])
    computed = complex(row["harmonic_extrapolated_real"], row["harmonic_extrapolated_imaginary"])
    own_error = float(row["error_estimate"]) * abs(computed)  # the estimate is relative
    atlas = contact.response(wavelength_over_a=wave)
    print(
        f"{wave:8g}   {computed:.4f}    {own_error:.4f}   {atlas.film:.4f}    {atlas.error:.4f}"
        f"   {abs(computed - atlas.film):.4f}   {row['status'].item()}"
    )
