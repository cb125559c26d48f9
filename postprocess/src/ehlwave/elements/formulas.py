"""Where each number of a table comes from, for reports."""

FORMULAS = {
    "radius_m": "1/Rx = 1/R1 + 1/R2 along rolling; radii of both bodies: module of the element",
    "radius_y_m": "1/Ry = 1/R1 + 1/R2 across; bearings: 1/Ry = 2/D_w - 1/(f D_w)",
    "speed_1_m_per_s": "speed past the contact: bearings (w_i - w_o) d_m (1 - gamma^2)/4, gears "
    "omega_1 s, cams omega rho",
    "speed_2_m_per_s": "bearings the same, gears omega_2 (N - s), cams omega l''",
    "slide_to_roll_ratio": "(u1 - u2)/((u1 + u2)/2)",
    "load_n": "bearings: equilibrium of ISO 16281; gears: T/r_b1 times the share of ISO/TR "
    "15144-1; cams: spring, rate times lift, mass times acceleration",
    "hertz_pressure_pa": "Hertz: 3 W/(2 pi a b) of ellipses, 2 w/(pi a) of lines",
    "central_film_m": "ehlwave.Contact.film(); its source is in the column source",
    "central_film_error": "95 % of computed contacts; errors of viscosity, alpha and inner "
    "dimensions included",
    "friction": "ehlwave.Contact.film().friction; 0 in pure rolling",
    "rise_mid_film_k": "ehlwave.Contact.film().heated",
    "lambda_ratio": "ehlwave.Contact.deform: mean film over Rq of the deformed roughness",
    "lambda_ratio_before": "mean film over Rq as made",
    "dang_van": "ehlwave.Contact.stress: the larger factor of both bodies",
    "life_ratio": "Ioannides and Harris (1985), over smooth surfaces",
    "rolling_resistance_n": "Biboulet and Houpert (2010), part 1 formula 42, part 2 formula 32, "
    "times the factor of the warm inlet with heat",
    "rolling_power_w": "2 F u",
    "sliding_power_w": "friction times load times |u1 - u2|",
    "iso_film_m": "1600 rho G^0.6 U^0.7 W^-0.13 S^0.22, ISO/TR 15144-1:2010 from memory",
    "iso_specific_film": "ISO/TR 15144-1: film over (Ra1 + Ra2)/2",
    "inside_error": "each estimated inner dimension at its error, formula of Moes, root of squares",
    "film_starved_low_m": "central film at r = 0.3 times the law of starved contacts",
}
