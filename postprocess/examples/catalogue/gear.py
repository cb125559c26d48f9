"""A pair of spur gears between pitch point and tip: a line contact that slides."""

import ehlwave

pinion = ehlwave.Body(radius_x_m=14e-3, material="steel")  # radii at this point of the flanks
wheel = ehlwave.Body(radius_x_m=20e-3, material="steel")
oil = ehlwave.Oil.from_grade(
    iso_vg=100, viscosity_index=95, eyring_stress_pa=5e6, temperature_k=343.15
)
load = {"load_n": 2000, "length_m": 20e-3}
contact = ehlwave.Contact.from_bodies(pinion, wheel, oil=oil, speeds_m_per_s=(3.5, 2.5), **load)
found = contact.deform("ground.csv").statistics
print(f"lambda ratio {found.lambda_ratio_after:.2f} within {100 * found.lambda_error:.0f} %")
