"""A steel ball rolls on a glass disc: from catalogue data to the lambda ratio."""

import ehlwave

ball = ehlwave.Body.ball(19.05e-3, material="steel")  # 3/4 inch; the rough body comes first
disc = ehlwave.Body(material="glass")  # a radius left out is flat
oil = ehlwave.Oil.from_grade(iso_vg=100, viscosity_index=95, temperature_k=313.15)
contact = ehlwave.Contact.from_bodies(ball, disc, oil=oil, load_n=30, speeds_m_per_s=(0.5, 0.5))
found = contact.deform("ground.csv").statistics
print(f"lambda ratio {found.lambda_ratio_after:.2f} within {100 * found.lambda_error:.0f} %")
