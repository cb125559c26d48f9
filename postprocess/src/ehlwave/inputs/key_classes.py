"""Groups of the keys of the programs by subject; the groups do not overlap.

A key of a group that no law has, and one of how a contact is solved or what is written, is sorted
by its group. A test holds all to ``ehlwave-case --keys``.
"""

from ehlwave.inputs.key_table import GROUP_OF


def _names(text: str) -> tuple[str, ...]:
    return tuple(text.split())


def _in_groups(*groups: str) -> frozenset[str]:
    return frozenset(key for key, group in GROUP_OF.items() if group in groups)


OF_WAVES = frozenset(
    _names("orientation wavelength_over_a wavelength_x_over_a wavelength_y_over_a oblique")
)

IN_COLUMNS = OF_WAVES | frozenset(
    _names(
        """
    radius_x_m radius_y_m load_n load_n_per_m mean_speed_m_per_s viscosity_pa_s load_parameter_m
    lubricant_parameter_l radius_ratio_d slip_parameter slide_to_roll_ratio
    """
    )
)
"""Keys that the columns M, L, D, slip_parameter and the wavelengths of a table give."""

OF_THE_OIL = _names(
    """
    pressure_viscosity_per_pa roelands_index viscosity_law density_law flow_law eyring_stress_pa
    carreau_modulus_pa carreau_exponent reduced_modulus_pa mcewen_coefficient_per_pa
    mcewen_exponent yasutomi_c1 yasutomi_c2_k yasutomi_above_glass_k yasutomi_a1_k
    yasutomi_a2_per_pa yasutomi_b1_per_pa yasutomi_b2 doolittle_factor
    doolittle_occupied_fraction tait_modulus_pa tait_modulus_rate shear_limit_over_pressure
    shear_limit_width temperature_k viscosity_table
    """
)
"""The oil at a given M, L and D; the reduced modulus where a stress is compared with it."""

OF_THE_EDGES = ("edges",)

OF_THE_INLET = ("oil_over_flooded", "oil_layer_m", "oil_profile")
"""The oil offered to a starved contact; none of a flooded one."""

OF_MARCHES = _names(
    """
    amplitude_over_film amplitude_m load_balance natural_frequency load_factor end_time
    oil_change_factor oil_change_start oil_change_length
    """
)
"""Further keys of a response in time; the linear response does not depend on them."""

OF_THE_SOLUTION = _in_groups("grid", "solver") - {*OF_THE_EDGES} | {"response"}
"""Quality of a response, not its value."""

WITHOUT_EFFECT = _in_groups("surface", "waviness2", "surface2", "output") | {"phase_deg"}
"""On the linear response to waves of the first surface."""

IN_LAWS = frozenset(
    _names(
        """
    conditions lubricant waviness waviness2 surface surface2 inlet heat grid solver dynamics output
    """
    )
)
"""Groups of input files that laws and tables understand; others are effects they do not have."""

OF_OTHER_EFFECTS = frozenset(GROUP_OF) - _in_groups(*IN_LAWS)
"""Keys of effects that have neither laws nor a linear response, as surfaces that touch."""

HEAT_DATA = _names(
    """
    oil_conductivity_w_per_m_k oil_heat_capacity_j_per_kg_k oil_density_kg_per_m3
    oil_expansion_per_k viscosity_temperature_per_k body_conductivity_w_per_m_k
    body_density_kg_per_m3 body_heat_capacity_j_per_kg_k body2_conductivity_w_per_m_k
    body2_density_kg_per_m3 body2_heat_capacity_j_per_kg_k
    """
)
"""Keys of heat of a contact, besides `temperature_k`."""

OF_THE_HEAT = frozenset(
    (
        *HEAT_DATA,
        *_names(
            "levels wave_temperatures tait_softening_per_k doolittle_occupied_rate_per_k",
        ),
    )
)
"""With them a response depends on size and speed of the contact."""
