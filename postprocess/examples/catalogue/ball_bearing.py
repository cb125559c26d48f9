"""A lightly loaded ball bearing (6204, 3000/min, outer ring at rest): its outer race."""

import ehlwave

d, dm, turns_per_s = 7.94e-3, 33.5e-3, 50
race = ehlwave.Body.outer_race(d, dm, osculation=0.53, material="steel")
ball = ehlwave.Body.ball(d, material="steel")
oil = ehlwave.Oil.from_grade(iso_vg=68, viscosity_index=95, temperature_k=343.15)
speed = 3.1416 * turns_per_s * dm / 2 * (1 - (d / dm) ** 2)  # speed of both surfaces
contact = ehlwave.Contact.from_bodies(race, ball, oil=oil, load_n=15, speeds_m_per_s=(speed,) * 2)
found = contact.deform("ground.csv").statistics
print(f"lambda ratio {found.lambda_ratio_after:.2f} within {100 * found.lambda_error:.0f} %")
