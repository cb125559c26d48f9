"""A ball on a steel disc at a slide-to-roll ratio of 0.3: the oil needs a flow law."""

import ehlwave

ball, disc = ehlwave.Body.ball(19.05e-3, material="steel"), ehlwave.Body(material="steel")
grade = {"iso_vg": 100, "viscosity_index": 95, "eyring_stress_pa": 5e6}
oil = ehlwave.Oil.from_grade(**grade, temperature_k=313.15)
speeds = {"mean_speed_m_per_s": 0.5, "slide_to_roll_ratio": 0.3}
contact = ehlwave.Contact.from_bodies(ball, disc, oil=oil, load_n=30, **speeds)
found = contact.deform("ground.csv").statistics
print(f"lambda ratio {found.lambda_ratio_after:.2f} within {100 * found.lambda_error:.0f} %")
