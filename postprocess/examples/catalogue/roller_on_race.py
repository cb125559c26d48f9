"""A roller on the inner race of a bearing: a line contact, its load over its length."""

import ehlwave

roller = ehlwave.Body(radius_x_m=5e-3, material="steel")
race = ehlwave.Body.inner_race(10e-3, pitch_diameter_m=60e-3, material="steel")
oil = ehlwave.Oil.from_grade(iso_vg=68, viscosity_index=95, temperature_k=343.15)
load = {"load_n": 1000, "length_m": 10e-3}
contact = ehlwave.Contact.from_bodies(roller, race, oil=oil, speeds_m_per_s=(3, 3), **load)
found = contact.deform("ground.csv").statistics
print(f"lambda ratio {found.lambda_ratio_after:.2f} within {100 * found.lambda_error:.0f} %")
