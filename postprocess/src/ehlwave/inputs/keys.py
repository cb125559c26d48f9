"""The keys of input files as types. Written by ``python -m studies.typed_keys``: do not edit."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, Literal, SupportsFloat, SupportsIndex, TypedDict

if TYPE_CHECKING:
    from ehlwave.inputs.surfaces import SurfaceLike, TopographyLike

Text = str | PathLike[str]


class CaseKeys(TypedDict, total=False):
    """Keys of a case."""

    radius_x_m: SupportsFloat
    """reduced radius in the rolling direction, m"""
    radius_y_m: SupportsFloat
    """reduced radius across; none: line contact, m"""
    reduced_modulus_pa: SupportsFloat
    """reduced elastic modulus E': 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2"""
    load_n: SupportsFloat
    """load, N"""
    load_n_per_m: SupportsFloat
    """load per length of a line contact; in place of load_n and radius_y_m, N/m"""
    mean_speed_m_per_s: SupportsFloat
    """mean speed (u1 + u2)/2, m/s"""
    viscosity_pa_s: SupportsFloat
    """viscosity at ambient pressure, Pa s"""
    load_parameter_m: SupportsFloat
    """load parameter M of Moes"""
    lubricant_parameter_l: SupportsFloat
    """lubricant parameter L of Moes; 0: isoviscous"""
    radius_ratio_d: SupportsFloat
    """ratio of the reduced radii D = Rx/Ry"""
    slip_parameter: SupportsFloat
    """slip parameter S = u1/ubar; speed of the wavy surface over the mean speed"""
    slide_to_roll_ratio: SupportsFloat
    """slide-to-roll ratio (u1 - u2)/ubar; in place of slip_parameter, S = 1 + ratio/2"""
    pressure_viscosity_per_pa: SupportsFloat
    """pressure-viscosity coefficient alpha"""
    roelands_index: SupportsFloat
    """index z of Roelands' viscosity"""
    viscosity_law: Literal[
        "roelands",
        "barus",
        "isoviscous",
        "mcewen",
        "yasutomi",
        "doolittle",
        "table",
    ]
    """viscosity against pressure"""
    density_law: Literal["dowson_higginson", "incompressible", "tait"]
    """density against pressure"""
    flow_law: Literal["newtonian", "eyring", "carreau"]
    """shear rate against shear stress; 'eyring': Ree-Eyring, sinh(tau/tau0) tau0/eta"""
    eyring_stress_pa: SupportsFloat
    """Eyring stress tau0, Pa"""
    carreau_modulus_pa: SupportsFloat
    """stress G at which thinning begins, Pa"""
    carreau_exponent: SupportsFloat
    """exponent n of the shear rate; 1: Newtonian"""
    shear_limit_over_pressure: SupportsFloat
    """largest shear stress over pressure, which the stress nears but does not pass; 0: no limit"""
    shear_limit_width: SupportsFloat
    """width of the limit: at (1 - width) times the limit the shear rate is twice the rate of"""
    mcewen_coefficient_per_pa: SupportsFloat
    """coefficient alpha0 of (1 + alpha0 p/q)^q, 1/Pa"""
    mcewen_exponent: SupportsFloat
    """exponent q of (1 + alpha0 p/q)^q"""
    yasutomi_c1: SupportsFloat
    """C1 of the improved Yasutomi law"""
    yasutomi_c2_k: SupportsFloat
    """C2 of the improved Yasutomi law, K"""
    yasutomi_above_glass_k: SupportsFloat
    """temperature of the oil above its glass transition at ambient pressure, T - Tg0, K"""
    yasutomi_a1_k: SupportsFloat
    """A1 of Tg = Tg0 + A1 ln(1 + A2 p), K"""
    yasutomi_a2_per_pa: SupportsFloat
    """A2 of Tg = Tg0 + A1 ln(1 + A2 p), 1/Pa"""
    yasutomi_b1_per_pa: SupportsFloat
    """b1 of F = (1 + b1 p)^b2, 1/Pa"""
    yasutomi_b2: SupportsFloat
    """b2 of F = (1 + b1 p)^b2; below 0"""
    doolittle_factor: SupportsFloat
    """factor B of the Doolittle law"""
    doolittle_occupied_fraction: SupportsFloat
    """occupied volume over the volume at ambient pressure, R0"""
    tait_modulus_pa: SupportsFloat
    """bulk modulus at ambient pressure, K0, Pa"""
    tait_modulus_rate: SupportsFloat
    """rate of change of the bulk modulus with pressure, K0'; near 11"""
    tait_softening_per_k: SupportsFloat
    """bK of the bulk modulus K0 exp(-bK (T - T0)); near 0.006, 1/K"""
    doolittle_occupied_rate_per_k: SupportsFloat
    """e of the occupied volume R0 (1 + e (T - T0)); near -0.001, 1/K"""
    viscosity_table: Text
    """CSV file of measured viscosities"""
    temperature_k: SupportsFloat
    """temperature T0 of the oil; may be left out with a table of one temperature, K"""
    oil_conductivity_w_per_m_k: SupportsFloat
    """conductivity of the oil, W/(m K)"""
    oil_heat_capacity_j_per_kg_k: SupportsFloat
    """heat capacity of the oil, J/(kg K)"""
    oil_density_kg_per_m3: SupportsFloat
    """density of the oil at ambient pressure and T0, kg/m3"""
    oil_expansion_per_k: SupportsFloat
    """thermal expansion of the oil; its density falls and its compression heats by it, 1/K"""
    viscosity_temperature_per_k: SupportsFloat
    """beta"""
    body_conductivity_w_per_m_k: SupportsFloat
    """conductivity of the bodies, W/(m K)"""
    body_density_kg_per_m3: SupportsFloat
    """density of the bodies, kg/m3"""
    body_heat_capacity_j_per_kg_k: SupportsFloat
    """heat capacity of the bodies, J/(kg K)"""
    body2_conductivity_w_per_m_k: SupportsFloat
    """conductivity of the body of surface 2, W/(m K)"""
    body2_density_kg_per_m3: SupportsFloat
    """density of the body of surface 2, kg/m3"""
    body2_heat_capacity_j_per_kg_k: SupportsFloat
    """heat capacity of the body of surface 2, J/(kg K)"""
    levels: SupportsIndex
    """intervals across the film"""
    wave_temperatures: Literal["frozen", "carried"]
    """temperatures in marches; 'frozen': those of the smooth contact"""
    film_m: SupportsFloat
    """boundary film H_b; gap at which solids begin to bear, on which their share depends, m"""
    share: SupportsFloat
    """share of the load that the solids bear"""
    law: Literal["hard", "soft"]
    """pressure of the solids"""
    solid_friction: SupportsFloat
    """friction coefficient of the solids"""
    softness_m: SupportsFloat
    """fall of the gap by which the pressure of the solids grows e times, m"""
    stress_pa: SupportsFloat
    """pressure of the solids at the boundary film, Pa"""
    orientation: Literal["none", "transverse", "isotropic", "longitudinal", "custom"]
    """orientation of the waves"""
    wavelength_over_a: SupportsFloat
    """wavelength lambda/a"""
    wavelength_x_over_a: SupportsFloat
    """wavelength along X over a; 0: no variation along X"""
    wavelength_y_over_a: SupportsFloat
    """wavelength along Y over a; 0: no variation along Y"""
    oblique: bool
    """whether the pattern is one plane wave cos(kx X + ky Y) in place of the product of cosines"""
    amplitude_over_film: SupportsFloat
    """amplitude Ai over the smooth central film thickness"""
    amplitude_m: SupportsFloat
    """amplitude Ai of any size, in place of amplitude_over_film; needs dimensional conditions, m"""
    phase_deg: SupportsFloat
    """phase of waves at rest; 0: smallest gap at X = 0, deg"""
    response: Literal["transient", "periodic", "harmonic", "both"]
    """response to the waves"""
    file: Text | SurfaceLike | TopographyLike
    """surface written by `ehlwave surface`"""
    orientation_2: Literal["none", "transverse", "isotropic", "longitudinal", "custom"]
    """of surface 2, orientation of the waves"""
    wavelength_over_a_2: SupportsFloat
    """of surface 2, wavelength lambda/a"""
    wavelength_x_over_a_2: SupportsFloat
    """of surface 2, wavelength along X over a; 0: no variation along X"""
    wavelength_y_over_a_2: SupportsFloat
    """of surface 2, wavelength along Y over a; 0: no variation along Y"""
    oblique_2: bool
    """of surface 2"""
    amplitude_over_film_2: SupportsFloat
    """of surface 2, amplitude Ai over the smooth central film thickness"""
    amplitude_m_2: SupportsFloat
    """of surface 2, amplitude Ai of any size, in place of amplitude_over_film"""
    file_2: Text | SurfaceLike | TopographyLike
    """measured surface 2"""
    oil_over_flooded: SupportsFloat
    """oil offered over oil that the flooded contact passes"""
    oil_layer_m: SupportsFloat
    """layers of oil on both surfaces together; in place of oil_over_flooded"""
    oil_profile: Text
    """CSV of the layer across"""
    oil_change_factor: SupportsFloat
    """layer in a march after a change over before; 1: no change, 0.001: a gap"""
    oil_change_start: SupportsFloat
    """T at which the change passes x_min"""
    oil_change_length: SupportsFloat
    """length of the changed layer over a; 0: to the end"""
    x_min: SupportsFloat
    """X of the inlet boundary"""
    x_max: SupportsFloat
    """X of the outlet boundary"""
    y_max: SupportsFloat
    """Y of the side boundary"""
    cells_x: SupportsIndex
    """cells along X over the whole domain"""
    cells_y: SupportsIndex
    """cells along Y over the whole domain; as cells_x"""
    largest_cells: SupportsIndex
    """limit of chosen cells"""
    domain: Literal["auto", "whole"]
    """computed domain; 'auto': half of it where the case is even in Y, 'whole': always all of it"""
    edges: Literal["flooded", "truncated"]
    """pressure at the edges of the domain; 'flooded': from the oil farther out"""
    tolerance: SupportsFloat
    """tolerance of steady states: mass residual and load error"""
    step_tolerance: SupportsFloat
    """tolerance of time steps at 20 % amplitude; reduced in proportion for smaller waves"""
    response_tolerance: SupportsFloat
    """tolerance of the linear response: its residual"""
    time_step_over_cell: SupportsFloat
    """time step dT/hX; a whole number or one over a whole number"""
    largest_steps: SupportsIndex
    """largest number of Newton steps, or multigrid cycles, of a solution"""
    settling_periods: SupportsIndex
    """periods to wait before the amplitude is measured"""
    largest_total_steps: SupportsIndex
    """largest number of Newton steps of a case on the finest grid; steps of rescues count"""
    method: Literal["auto", "newton", "fas", "petsc"]
    """method of solution"""
    cycle: Literal["f", "v", "w"]
    """multigrid cycle"""
    deformation: Literal["auto", "fft", "mlmi"]
    """how the deformation is computed; 'auto': the faster method, 'fft'"""
    scheme: Literal["auto", "averaged", "fitted"]
    """differences of the Reynolds equation"""
    error_estimate: Literal["coarse_grid", "model"]
    """estimate of the error of Ad/Ai"""
    accuracy: SupportsFloat
    """requested relative error of Ad/Ai, in smooth contacts of H(0,0)"""
    threads: SupportsIndex
    """threads that share one case; no result depends on them"""
    load_balance: Literal["force_balance", "equation_of_motion"]
    """equation of the mutual approach"""
    natural_frequency: SupportsFloat
    """dimensionless natural frequency Omega"""
    load_factor: SupportsFloat
    """load from T = 0 on over the steady load; a load step"""
    end_time: SupportsFloat
    """T to which is marched; none: until the amplitude is measured"""
    fields: bool
    """whether the last fields are kept even without --output"""
    fields_every: SupportsIndex
    """time steps from one kept set of fields to the next"""
    sensitivities: bool
    """whether results are differentiated by every input"""
    mean_rise: bool
    """whether a linear response includes the change of the mean film by waves, to second order"""


class StudyKeys(CaseKeys, total=False):
    """Shared by all of a study."""

    unresolved: Literal["run", "skip"]
    largest_case_seconds: SupportsFloat
    checkpoint_seconds: SupportsFloat
    case_file: Text
    output: Text


class ContactKeys(TypedDict, total=False):
    """Keys of :class:`ehlwave.Contact`."""

    radius_x_m: SupportsFloat
    """reduced radius in the rolling direction, m"""
    radius_y_m: SupportsFloat
    """reduced radius across; none: line contact, m"""
    reduced_modulus_pa: SupportsFloat
    """reduced elastic modulus E': 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2"""
    load_n: SupportsFloat
    """load, N"""
    mean_speed_m_per_s: SupportsFloat
    """mean speed (u1 + u2)/2, m/s"""
    viscosity_pa_s: SupportsFloat
    """viscosity at ambient pressure, Pa s"""
    load_n_per_m: SupportsFloat
    """load per length of a line contact; in place of load_n and radius_y_m, N/m"""
    load_parameter_m: SupportsFloat
    """load parameter M of Moes"""
    lubricant_parameter_l: SupportsFloat
    """lubricant parameter L of Moes; 0: isoviscous"""
    radius_ratio_d: SupportsFloat
    """ratio of the reduced radii D = Rx/Ry"""
    semi_axis_a_m: SupportsFloat
    central_film_m: SupportsFloat
    pressure_viscosity_per_pa: SupportsFloat
    """pressure-viscosity coefficient alpha"""
    roelands_index: SupportsFloat
    """index z of Roelands' viscosity"""
    eyring_stress_pa: SupportsFloat
    """Eyring stress tau0, Pa"""
    carreau_modulus_pa: SupportsFloat
    """stress G at which thinning begins, Pa"""
    carreau_exponent: SupportsFloat
    """exponent n of the shear rate; 1: Newtonian"""
    viscosity_error: SupportsFloat
    pressure_viscosity_error: SupportsFloat
    load_error: SupportsFloat
    speed_error: SupportsFloat
    radius_x_error: SupportsFloat
    radius_y_error: SupportsFloat
    modulus_error: SupportsFloat
    roelands_error: SupportsFloat
    eyring_stress_error: SupportsFloat
    slip_parameter: SupportsFloat
    """slip parameter S = u1/ubar; speed of the wavy surface over the mean speed"""
    slide_to_roll_ratio: SupportsFloat
    """slide-to-roll ratio (u1 - u2)/ubar; in place of slip_parameter, S = 1 + ratio/2"""
    oil_over_flooded: SupportsFloat
    """oil offered over oil that the flooded contact passes"""
