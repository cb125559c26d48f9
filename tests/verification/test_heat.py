"""Contacts with heat: the exact local problem, an independent solver, limits in which heat does nothing, the balance of heat."""

import cmath
import math
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import IS_LONG, TestCase, report, run, solve
from reference_values import rows
from studies.programs import last_line, namelist

try:
    import h5py
    import numpy as np
except ImportError:
    h5py = None

OIL = {"oil_conductivity_w_per_m_k": 0.14, "oil_heat_capacity_j_per_kg_k": 2000.0, "oil_density_kg_per_m3": 870.0,
       "oil_expansion_per_k": 7e-4}
# Measured against the independent solver, whose rows have errors of 0.3 % (films, friction) and 1 % (rises)
FILM_BAND, RISE_BAND = 0.007, 0.03
SOLVED = {"tolerance": 1e-8, "response_tolerance": 1e-11}
OBLIQUE = {"wavelength_x_over_a": 1.0, "wavelength_y_over_a": 0.8, "oblique": True}
SPIKED = 0.2  # least slide-to-roll ratio; below it, largest rises sit in the pressure spike and grow with every grid
NAMES = {"central_film_um": ("central_film_m", 1e6), "minimum_film_um": ("minimum_film_m", 1e6),
         "friction_coefficient": ("friction_coefficient", 1)}
RISES = ("largest_rise_mid_film_k", "largest_rise_wall_1_k", "largest_rise_wall_2_k")


def groups(row, cells, has_heat=True, **more):
    """Input of a row of the reference, on its domain."""
    conditions = {key: row[key] for key in ("radius_x_m", "reduced_modulus_pa", "load_n_per_m", "mean_speed_m_per_s",
                                            "viscosity_pa_s")}
    conditions["slip_parameter"] = 1 + row["slide_to_roll_ratio"]/2
    lubricant = {key: row[key] for key in ("pressure_viscosity_per_pa", "roelands_index", "eyring_stress_pa")}
    lubricant["flow_law"] = "eyring"
    found = {"conditions": conditions, "lubricant": lubricant,
             "grid": {"x_min": -4.0, "x_max": 1.6, "edges": "truncated", "cells_x": cells}}
    if has_heat:
        lubricant["temperature_k"] = row["temperature_k"]
        found["heat"] = {**OIL, "viscosity_temperature_per_k": row["viscosity_temperature_per_k"]}
    for group, keys in more.items():
        found[group] = {**found.get(group, {}), **keys}
    return found


def read_rows():
    """Rows of the reference, whose first line is a comment."""
    path = Path(__file__).parent / "reference" / "heat_line.csv"
    with tempfile.TemporaryDirectory() as folder:
        bare = Path(folder) / "heat_line.csv"
        bare.write_text("\n".join(path.read_text().splitlines()[1:]) + "\n")
        return rows(bare)


def local_problem(stress, rate_at, sliding, film, beta, conductivity):
    """A of the exact film under a stress, and the difference of the speeds that it then has to that asked for."""
    product = beta*stress*sliding*film/conductivity/8
    a = math.sqrt(product)
    for _ in range(60):
        a -= (a*math.tanh(a) - product)/(math.tanh(a) + a/math.cosh(a)**2)
    return a, film*rate_at(stress)*math.sinh(a)*math.cosh(a)/a - sliding


def free_volume(row, lubricant=None, heat=None, **more):
    """A row of the reference with an oil of free volume."""
    given = groups(row, 128, lubricant={"viscosity_law": "doolittle", "doolittle_factor": 4.7, "doolittle_occupied_fraction": 0.66,
                                        "tait_modulus_pa": 1.7e9, "tait_modulus_rate": 11.0, **(lubricant or {})},
                   heat={"viscosity_temperature_per_k": 0.0, **(heat or {})}, **more)
    for key in ("pressure_viscosity_per_pa", "roelands_index"):
        del given["lubricant"][key]
    return given


def wavy_line(flow, waves, heat):
    """Transverse waves, or those given, on a line contact; `heat` None: without."""
    extra = {"waviness": {"orientation": "transverse", "wavelength_over_a": 1.0, "response": "harmonic", **waves},
             "solver": dict(SOLVED)}
    given = groups(read_rows()[7], 256, has_heat=heat is not None, **extra, **({"heat": heat} if heat else {}))
    return with_flow(given, flow)


def wavy_point(flow, waves, heat):
    """Input of a point contact with waves."""
    given = {
        "conditions": {"radius_x_m": 0.01, "radius_y_m": 0.01, "reduced_modulus_pa": 2.26e11, "load_n": 100.0,
                       "mean_speed_m_per_s": 2.0, "viscosity_pa_s": 0.08, "slip_parameter": 1.15},
        "lubricant": {"pressure_viscosity_per_pa": 2e-8, "roelands_index": 0.6, "eyring_stress_pa": 6e6},
        "grid": {"cells_x": 64, "cells_y": 64},
        "waviness": {"orientation": "transverse", "wavelength_over_a": 1.0, "response": "harmonic", **waves},
        "solver": dict(SOLVED),
    }
    if "wavelength_x_over_a" in waves:
        del given["waviness"]["wavelength_over_a"]
    if heat is not None:
        given["lubricant"]["temperature_k"] = 313.0
        given["heat"] = {**OIL, "viscosity_temperature_per_k": 0.045, **heat}
    return with_flow(given, flow)


def with_flow(given, flow):
    """An input with a law of flow; a Newtonian oil slides little, of which it bears no more."""
    given["lubricant"]["flow_law"] = flow
    if flow == "newtonian":
        del given["lubricant"]["eyring_stress_pa"]
        given["conditions"]["slip_parameter"] = 1.02
    return given


def warm_ball(slip, cells):
    """Input of a sliding ball on a plane."""
    given = wavy_point("eyring", {}, {})
    given["conditions"]["slip_parameter"] = slip
    given["grid"] = {"cells_x": cells, "cells_y": cells}
    del given["waviness"]
    return given


def walls_by_sum(file, speeds, a):
    """Rises of both surfaces of a ball on half a domain: heat of all cells times the kernel of a moving source, K."""
    x, y = file["x"][:], file["y"][:]
    h, k = (x[1] - x[0])*a, (y[1] - y[0])*a
    conductivity, capacity = 46.0, 7850.0*470.0
    rises = []
    for wall, speed in enumerate(speeds, 1):
        heat = file[f"heat_into_{wall}_w_per_m2"][...]
        heat = heat if heat.shape == (len(y), len(x)) else heat.T
        heat = np.concatenate([heat[:0:-1], heat])
        kernel = np.empty((2*len(y) - 1, 2*len(x) - 1))
        for n in range(kernel.shape[0]):
            for m in range(1 - len(x), len(x)):
                points = 400 if max(abs(m), n) == 0 else 60 if max(abs(m), n) < 4 else 6
                centre = (np.arange(points) + 0.5)/points - 0.5
                along, aside = np.meshgrid((m + centre)*h, (n + centre)*k)
                far = np.hypot(along, aside)
                kernel[n, m + len(x) - 1] = np.mean(np.exp(-speed*capacity/(2*conductivity)*(far - along))/far)
        kernel *= h*k/(2*math.pi*conductivity)
        rise = np.zeros((len(y), len(x)))
        for j in range(len(y)):
            for i in range(len(x)):
                rows = np.abs(np.arange(1 - len(y), len(y)) - j)
                rise[j, i] = np.sum(kernel[np.ix_(rows, i - np.arange(len(x)) + len(x) - 1)]*heat)
        rises.append(rise)
    return rises


class Heat(TestCase):
    def test_independent_solver(self):
        """Extrapolated from 48 and 96 cells a half width: the reference is from 24 and 48."""
        worst = {}
        for row in (row for row in read_rows() if row["thermal"] == 1):
            coarse, fine = (solve(**groups(row, cells)) for cells in (268, 536))
            what = f"{row['mean_speed_m_per_s']} m/s, slide-to-roll ratio {row['slide_to_roll_ratio']}"
            for name, (theirs, unit) in NAMES.items():
                if row[theirs] == 0:   # in pure rolling the friction is round-off, whose error no grid shows
                    self.assertLess(abs(fine[name] or 0), 1e-6, f"{what}: {name}")
                else:
                    value = fine[name] + (fine[name] - coarse[name])/3
                    worst[name] = max(worst.get(name, 0), self.check_close(value, row[theirs]*unit, FILM_BAND, f"{what}: {name}"))
            for name in RISES:
                if row["slide_to_roll_ratio"] >= SPIKED and (name != RISES[0] or row["slide_to_roll_ratio"] > SPIKED):
                    value = fine[name] + (fine[name] - coarse[name])/3
                    worst[name] = max(worst.get(name, 0), self.check_close(value, row[name], RISE_BAND, f"{what}: {name}"))
            self.assertLess(fine["heat_balance_error"], 1e-3, what)
        report(", ".join(f"{name} within {value:.1%}" for name, value in worst.items()))

    @unittest.skipIf(h5py is None, "no h5py: set EHLWAVE_PYTHON")
    def test_exact_local_problem(self):
        """Barus, an oil that stores no heat, bodies that conduct without limit: the film at X = 0 is known in closed form."""
        beta, conductivity, mean_speed = 0.05, 0.14, 1.0
        found = []
        for ratio, load in ((0.3, 2e5), (1.0, 2e5), (1.6, 1.5e5)):
            given = {
                "conditions": {"radius_x_m": 0.02, "reduced_modulus_pa": 2.26e11, "load_n_per_m": load,
                               "mean_speed_m_per_s": mean_speed, "viscosity_pa_s": 0.05, "slip_parameter": 1 + ratio/2},
                "lubricant": {"viscosity_law": "barus", "pressure_viscosity_per_pa": 1.5e-8, "flow_law": "eyring",
                              "eyring_stress_pa": 5e6, "temperature_k": 313.0},
                "heat": {"oil_conductivity_w_per_m_k": conductivity, "oil_heat_capacity_j_per_kg_k": 1e-3,
                         "oil_density_kg_per_m3": 870.0, "viscosity_temperature_per_k": beta,
                         "body_conductivity_w_per_m_k": 1e12},
                "grid": {"x_min": -4.0, "x_max": 1.6, "cells_x": 1120},
            }
            with tempfile.TemporaryDirectory() as folder:
                path, output = Path(folder) / "case.nml", Path(folder) / "case.h5"
                path.write_text(namelist(given))
                result = last_line(run("case", str(path), "--json", "--output", str(output)))
                with h5py.File(output) as file:
                    i = int(abs(file["x"][:]).argmin())
                    self.assertLess(abs(file["x"][i]), 1e-9)
                    pressure = float(file["pressure"][...].ravel()[i])*result["hertz_pressure_pa"]
                    film = float(file["film"][...].ravel()[i])*result["hertz_approach_c_m"]
                    stress = float(file["mean_shear_stress_pa"][...].ravel()[i])
                    rise = float(file["rise_mid_film_k"][...].ravel()[i])
            viscosity = 0.05*math.exp(1.5e-8*pressure)
            low, high = 1.0, 3e8
            for _ in range(200):
                middle = (low + high)/2
                _, excess = local_problem(middle, lambda tau: 5e6/viscosity*math.sinh(tau/5e6), ratio*mean_speed, film, beta,
                                          conductivity)
                low, high = (low, middle) if excess > 0 else (middle, high)
            a, _ = local_problem(low, lambda tau: 5e6/viscosity*math.sinh(tau/5e6), ratio*mean_speed, film, beta, conductivity)
            off = (self.check_close(stress, low, 1e-3, "stress"),
                   self.check_close(rise, 2/beta*math.log(math.cosh(a)), 1e-3, "rise"))
            found.append(f"ratio {ratio}: G = {8*a*a/math.cosh(a)**2:.2f}, stress {off[0]:.0e}, rise {off[1]:.0e}")
        report("; ".join(found))

    def test_without_effect(self):
        """An oil with constant viscosity and density over temperature: the isothermal numbers at any temperatures."""
        row = read_rows()[7]
        for flow in ("eyring", "newtonian"):
            inert = groups(row, 256, heat={"oil_expansion_per_k": 0.0, "viscosity_temperature_per_k": 0.0})
            cold = groups(row, 256, has_heat=False)
            for one in (inert, cold):
                if flow == "newtonian":
                    del one["lubricant"]["eyring_stress_pa"]
                    one["lubricant"]["flow_law"] = "newtonian"
            inert, cold = solve(**inert), solve(**cold)
            for name in ("central_film", "minimum_film", "max_pressure", "friction_coefficient"):
                self.check_close(inert[name], cold[name], 1e-10, f"{flow}: {name}")
            self.assertGreater(inert["largest_rise_mid_film_k"], 20)
            for name in ("inlet_temperature_rise_k", "contact_temperature_rise_k"):   # estimates of results of &heat
                self.assertIn(name, cold)
                self.assertNotIn(name, inert)

    def test_levels_and_mesh(self):
        """Twice the levels and half the mesh move film and friction by less than their errors."""
        row = read_rows()[7]
        usual, levels, mesh = (solve(**groups(row, cells, heat={"levels": count})) for cells, count in
                               ((256, 16), (256, 32), (512, 16)))
        for name, error in (("central_film", "central_film_error"), ("friction_coefficient", "friction_error")):
            for other in (levels, mesh):
                self.check_close(other[name], usual[name], usual[error], name)
            self.check_close(levels[name], usual[name], 1e-3, name)

    def test_friction_over_slip(self):
        """Friction with heat has a largest value over slip; without, it rises on. With a limit it stays below that."""
        row = read_rows()[7]
        ratios = (0.02, 0.1, 0.3, 0.6, 1.2, 1.8)
        warm, limited = [], []
        for ratio in ratios:
            warm.append(solve(**groups({**row, "slide_to_roll_ratio": ratio}, 256)))
            limited.append(solve(**groups({**row, "slide_to_roll_ratio": ratio}, 256, has_heat=False,
                                          lubricant={"shear_limit_over_pressure": 0.05}))["friction_coefficient"])
        friction = [one["friction_coefficient"] for one in warm]
        cold = [one["isothermal_friction_coefficient"] for one in warm]
        self.assertEqual(cold, sorted(cold))
        self.assertNotIn(friction.index(max(friction)), (0, len(ratios) - 1))
        self.assertEqual(limited, sorted(limited))
        self.assertLess(limited[-1], 0.05)
        report(f"over the slide-to-roll ratios {ratios}: {friction}; limit 0.05, no heat: {limited}")

    def test_point_contact(self):
        """The balance closes, and no surface gets heat that shear and compression did not make."""
        result = solve(
            conditions={"radius_x_m": 0.01, "radius_y_m": 0.01, "reduced_modulus_pa": 2.26e11, "load_n": 100.0,
                        "mean_speed_m_per_s": 2.0, "viscosity_pa_s": 0.08, "slip_parameter": 1.15},
            lubricant={"pressure_viscosity_per_pa": 2e-8, "roelands_index": 0.6, "flow_law": "eyring", "eyring_stress_pa": 6e6,
                       "temperature_k": 313.0},
            heat={**OIL, "viscosity_temperature_per_k": 0.045}, grid={"cells_x": 64, "cells_y": 64})
        self.assertLess(result["heat_balance_error"], 1e-3)
        self.assertLess(result["friction_coefficient"], result["isothermal_friction_coefficient"])
        sliding = 0.3*2.0*100*result["friction_coefficient"]
        self.assertGreater(result["heat_of_shear"], sliding)      # the flow along the pressure makes heat, too
        self.check_close(result["heat_of_shear"], sliding, 0.1, "power of shear")

    @unittest.skipIf(h5py is None, "no h5py: set EHLWAVE_PYTHON")
    def test_walls_by_direct_sum(self):
        """Surfaces that are fast, slow and at rest against conduction: the sum over all cells, computed apart."""
        for slip in (1.15, 1.99, 1.999, 2.0) if IS_LONG else (1.99, 2.0):
            with tempfile.TemporaryDirectory() as folder:
                path, output = Path(folder) / "case.nml", Path(folder) / "case.h5"
                path.write_text(namelist(warm_ball(slip, 48)))
                result = last_line(run("case", str(path), "--json", "--output", str(output)))
                with h5py.File(output) as file:
                    apart = walls_by_sum(file, (2*slip, 2*(2 - slip)), result["semi_axis_a_m"])
                    found = [file[f"rise_wall_{wall}_k"][...] for wall in (1, 2)]
            off = []
            for wall in (0, 1):
                inner = np.s_[1:-1, 1:-1]
                rise = found[wall] if found[wall].shape == apart[wall].shape else found[wall].T
                off.append(np.max(np.abs(rise[inner] - apart[wall][inner]))/np.max(apart[wall]))
                self.assertLess(off[wall], 0.01, f"slip {slip}, surface {wall + 1}")
            report(f"S = {slip}: rises up to {np.max(apart[0]):.1f} and {np.max(apart[1]):.1f} K, "
                   f"at most {off[0]:.2%} and {off[1]:.2%} of these apart")

    def test_slow_surfaces_in_marches(self):
        """Marches that carry temperatures warn of slow surfaces; steady states have no such limit."""
        for heat, warns in (({"wave_temperatures": "carried"}, True), ({}, False)):
            given = wavy_line("eyring", {"response": "transient", "amplitude_over_film": 0.01}, heat)
            given["conditions"]["slip_parameter"] = 1.97
            given["grid"]["cells_x"] = 128
            given["solver"] = {"step_tolerance": 1e-4}
            result = solve(**given)
            self.assertEqual("is slow, Peclet number" in result["warning"], warns, heat)

    def test_walls_over_mesh(self):
        """Rises of slow surfaces converge at least as fast as 2.5 a halving of the mesh size."""
        meshes = (48, 96, 192) if IS_LONG else (32, 64, 128)
        rises = [solve(**warm_ball(1.99, cells))["central_rise_wall_2_k"] for cells in meshes]
        ratio = (rises[1] - rises[0])/(rises[2] - rises[1])
        report(f"S = 1.99, central rise on {meshes} cells: {rises}, ratio of differences {ratio:.2f}")
        self.assertGreater(ratio, 2.5)

    def test_balance_under_heavy_load(self):
        """The balance covers the film under pressure alone: single nodes where it is cavitated keep some pressure."""
        found = []
        for cells in (256, 512):
            result = solve(**groups({**read_rows()[7], "load_n_per_m": 1.2e6, "slide_to_roll_ratio": 1.8}, cells))
            self.assertLess(result["heat_balance_error"], 2e-4, cells)
            found.append(f"{result['heat_balance_error']:.0e}")
        report(f"1.47 GPa, slide-to-roll ratio 1.8: heat balance {', '.join(found)}")

    def test_waves_without_effect(self):
        """Linear responses: transverse, longitudinal and oblique waves, on lines and points."""
        inert = {"oil_expansion_per_k": 0.0, "viscosity_temperature_per_k": 0.0}
        for make, flow, waves in ((wavy_line, "eyring", {}), (wavy_line, "eyring", {"orientation": "isotropic"}),
                                  (wavy_point, "eyring", {}), (wavy_point, "newtonian", {}),
                                  (wavy_point, "eyring", {"orientation": "longitudinal"}),
                                  (wavy_point, "eyring", {"orientation": "custom", **OBLIQUE})):
            warm, cold = (solve(**make(flow, waves, heat)) for heat in (inert, None))
            what = f"{make.__name__}, {flow}, {waves}"
            names = ["central_film", "harmonic_ratio", "harmonic_extrapolated"]
            if flow != "newtonian":      # its linear solve, to 1e-6, takes another way through the faces
                names += ["mean_film_rise", "smallest_film"]
            for name in names:
                if cold[name] is not None:
                    self.check_close(warm[name], cold[name], 1e-10, f"{what}: {name}")
            self.assertAlmostEqual(warm["harmonic_phase"], cold["harmonic_phase"], delta=1e-10, msg=what)
            self.assertGreater(warm["largest_rise_mid_film_k"], 1)

    def test_marches_and_responses(self):
        """Small waves in time and their linear response, both at the temperatures of the smooth contact."""
        found = []
        for make, waves in ((wavy_line, {}), (wavy_point, {}), (wavy_point, {"orientation": "longitudinal"})):
            given = make("eyring", {**waves, "response": "both", "amplitude_over_film": 0.01}, {})
            given["grid"]["cells_x"] = given["grid"].get("cells_y", 128)
            result = solve(**given)
            march, response = (cmath.rect(result[ratio], result[phase] or 0) for ratio, phase in
                               (("amplitude_ratio_fit", "phase_fit"), ("harmonic_ratio", "harmonic_phase")))
            self.assertLess(abs(march - response), 0.005, f"{make.__name__}, {waves}")
            self.assertIn("temperatures stay those of the smooth contact", result["warning"])
            self.assertEqual(result["wave_temperatures"], "frozen")
            found.append(f"{abs(march - response):.1e}")
        report("marches differ from responses by " + ", ".join(found) + " of Ai")

    def test_temperatures_carried(self):
        """Temperatures that march: waves of no height leave the contact unchanged, an oil independent of temperature
        marches as without heat, and the effect of frozen temperatures on Ad/Ai is within the estimate.
        """
        inert = {"oil_expansion_per_k": 0.0, "viscosity_temperature_per_k": 0.0}
        waves = {"response": "both", "amplitude_over_film": 0.01}
        for make in (wavy_line, wavy_point):
            found = []
            runs = [(0.01, {}), (1e-6, {}), (0.01, inert), (0.01, None)]
            for height, heat in runs if make is wavy_line else runs[:1]:
                given = make("eyring", {**waves, "amplitude_over_film": height},
                             None if heat is None else {**heat, "wave_temperatures": "carried"})
                given["grid"]["cells_x"] = given["grid"].get("cells_y", 128)
                given["solver"] = {"step_tolerance": 1e-6}
                found.append(solve(**given))
            warm = found[0]
            if make is wavy_line:
                _, still, without, cold = found
                self.check_close(still["mean_film"], still["central_film"], 1e-5, "film under waves of no height")
                self.check_close(without["amplitude_ratio_fit"], cold["amplitude_ratio_fit"], 1e-5, "without effect")
            march, frozen = (cmath.rect(warm[ratio], warm[phase]) for ratio, phase in
                             (("amplitude_ratio_fit", "phase_fit"), ("harmonic_ratio", "harmonic_phase")))
            if make is wavy_line:   # the value in src/waves/README.md, on 128 cells
                self.check_close(abs(march), 0.786, 2e-3, "carried")
            self.assertGreater(abs(march - frozen), 0.02)
            self.assertLess(abs(march - frozen), warm["frozen_heat_error"])
            self.assertEqual(warm["wave_temperatures"], "carried")
            report(f"{make.__name__}: Ad/Ai {abs(march):.3f} carried, {abs(frozen):.3f} frozen, as complex numbers "
                   f"{abs(march - frozen):.3f} apart, estimate {warm['frozen_heat_error']:.3f}")

    def test_response_levels_and_mesh(self):
        """Twice the levels and half the mesh move Ad/Ai by less than its error."""
        for make in (wavy_line, wavy_point):
            usual = make("eyring", {}, {})
            levels, mesh = make("eyring", {}, {"levels": 24}), make("eyring", {}, {})
            for key in ("cells_x", "cells_y"):
                if key in mesh["grid"]:
                    mesh["grid"][key] *= 2
            usual, levels, mesh = solve(**usual), solve(**levels), solve(**mesh)
            self.check_close(mesh["harmonic_ratio"], usual["harmonic_ratio"], usual["harmonic_error"], make.__name__)
            self.check_close(levels["harmonic_ratio"], usual["harmonic_ratio"], usual["heat_levels_error"], make.__name__)

    @unittest.skipIf(h5py is None, "no h5py: set EHLWAVE_PYTHON")
    def test_steady_states_of_a_sweep(self):
        """Waves share a warm steady state, but not over slip, by which a Newtonian oil warms: the numbers of single cases."""
        given = wavy_point("newtonian", {}, {})
        given["grid"]["edges"] = "truncated"
        slips, waves = [1.0, 1.02], [1.0, 0.5]
        del given["conditions"]["slip_parameter"], given["waviness"]["wavelength_over_a"], given["solver"]
        lists = {"slip_parameter": slips, "wavelength_over_a": waves, "output": "results.h5"}
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "sweep.nml").write_text(namelist({"sweep": lists, **given}))
            outcome = run("sweep", "sweep.nml", folder=folder)
            self.check_status(outcome)
            with h5py.File(Path(folder, "results.h5")) as file:
                found = {(s, w): ratio for s, w, ratio in zip(file["slip_parameter"][:], file["wavelength_x_over_a"][:],
                                                              file["harmonic_ratio"][:], strict=True)}
        for slip, wave in ((slip, wave) for slip in slips for wave in waves):
            given["conditions"]["slip_parameter"], given["waviness"]["wavelength_over_a"] = slip, wave
            self.assertEqual(found[slip, wave], solve(**given)["harmonic_ratio"], (slip, wave))

    def test_free_volume(self):
        """Doolittle's law takes its temperature from the occupied volume and from the volume of Tait's equation: at
        ambient pressure -d ln(eta)/dT = B R0 (aV - e)/(1 - R0)^2, and a modulus that softens thins the film further.
        """
        row = {**read_rows()[7], "slide_to_roll_ratio": 0.2}
        waves = {"waviness": {"orientation": "transverse", "wavelength_over_a": 1.0, "response": "harmonic"}}
        films = []
        for softening in (0.0, 6e-3):
            result = solve(**free_volume(row, {"doolittle_occupied_rate_per_k": -9e-4, "tait_softening_per_k": softening}, **waves))
            beta = 4.7*0.66*(OIL["oil_expansion_per_k"] + 9e-4)/0.34**2
            self.check_close(result["frozen_heat_error"], 0.25*beta*result["largest_rise_mid_film_k"], 1e-9, "beta")
            self.assertLess(result["friction_coefficient"], result["isothermal_friction_coefficient"])
            self.assertLess(result["central_film"], result["isothermal_central_film"])
            self.assertLess(result["heat_balance_error"], 1e-3)
            films.append(result["central_film"])
        self.assertNotEqual(*films)

    def test_refusals(self):
        row = read_rows()[7]
        cases = {
            "surface at rest": groups({**row, "slide_to_roll_ratio": 2.0}, 256),
            "&lubricant temperature_k is missing": groups(row, 256, lubricant={"temperature_k": 0.0}),
            "'oil_density_kg_per_m3' in &heat: 0.0 is out of range: write a value in kg/m3, above 0": groups(
                row, 256, heat={"oil_density_kg_per_m3": 0.0}),
            "takes the temperature from its volume": free_volume(row, heat={"oil_expansion_per_k": 0.0}),
            "response = 'periodic' does not take &heat": groups(row, 256, waviness={
                "orientation": "transverse", "wavelength_over_a": 1.0, "response": "periodic"}),
            "is for waves that move in time": groups(row, 256, heat={"wave_temperatures": "carried"}, waviness={
                "orientation": "transverse", "wavelength_over_a": 1.0, "response": "harmonic"}),
            "temperatures of the steady load": groups(row, 256, dynamics={"end_time": 1.0}),
            "which a measured surface changes": groups(row, 256, surface={"file": "trace.csv"}),
            "is replaced by shear_limit_over_pressure": groups(row, 256, lubricant={"limiting_stress_over_pressure": 0.1}),
        }
        for message, given in cases.items():
            with self.subTest(message), tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "case.nml"
                path.write_text(namelist(given))
                outcome = run("case", str(path))
                self.check_status(outcome, 2)
                self.assertIn(message, outcome.stderr)


if __name__ == "__main__":
    unittest.main()
