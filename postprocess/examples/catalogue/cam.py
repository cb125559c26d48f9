"""A cam on a roller follower at its nose: a line contact in pure rolling."""

import ehlwave

cam = ehlwave.Body(radius_x_m=15e-3, material="cast iron")
roller = ehlwave.Body(radius_x_m=9e-3, material="steel")
oil = ehlwave.Oil.from_grade(
    viscosity_40c_mm2_per_s=68, viscosity_100c_mm2_per_s=11, temperature_k=363.15
)
load = {"load_n": 1200, "length_m": 12e-3}
contact = ehlwave.Contact.from_bodies(cam, roller, oil=oil, speeds_m_per_s=(2, 2), **load)
found = contact.deform("ground.csv").statistics
print(f"lambda ratio {found.lambda_ratio_after:.2f} within {100 * found.lambda_error:.0f} %")
