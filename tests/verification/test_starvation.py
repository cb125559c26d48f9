"""Contacts with too little oil: values of an independent solver, limits, the balance of the oil, time against linear response."""

import math
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import IS_LONG, TestCase, last_line, namelist, report, run, solve

try:
    import h5py
except ImportError:
    h5py = None

DOMAIN = {"x_min": -3, "x_max": 1.5, "y_max": 2, "edges": "truncated"}
# R on 1/16, 1/32, 1/64, and Ad/Ai of transverse 0.25, 0.5, 1, 2, isotropic 0.25, 0.5, 1, 2, longitudinal 0.5, 1 on 1/64: an
# independent solver (M = 100, L = 12.05, D = 1), whose mass balance has a residual of first order at the meniscus.
PEER = {
    20: ((1.000, 1.000, 1.000), (0.973, 0.923, 0.690, 0.391, 0.935, 0.856, 0.674, 0.408, 0.640, 0.398)),
    2: ((0.917, 0.934, 0.940), (0.971, 0.913, 0.679, 0.369, 0.932, 0.849, 0.658, 0.395, 0.625, 0.383)),
    1: ((0.715, 0.761, 0.780), (0.960, 0.906, 0.564, 0.261, 0.922, 0.822, 0.614, 0.307, 0.579, 0.359)),
    0.7: ((0.548, 0.598, 0.619), (1.001, 0.756, 0.383, 0.150, 0.906, 0.794, 0.473, 0.195, 0.523, 0.259)),
    0.5: ((0.412, 0.445, 0.463), (0.904, 0.506, 0.201, 0.047, 0.894, 0.638, 0.283, 0.080, 0.383, 0.120)),
}
WAVES = [(orientation, wavelength) for orientation in ("transverse", "isotropic") for wavelength in (0.25, 0.5, 1, 2)]
WAVES += [("longitudinal", 0.5), ("longitudinal", 1)]


def contact(r, cells=16, **groups):
    """M = 100, L = 12.05, D = 1 on so many cells per a; the grid's keys override DOMAIN."""
    grid = DOMAIN | {"cells_x": round(4.5*cells), "cells_y": 4*cells} | groups.pop("grid", {})
    inlet = groups.pop("inlet", {})
    if r:
        inlet = {"oil_over_flooded": r} | inlet
    if inlet:
        groups["inlet"] = inlet
    return solve(m=100, l=12.05, d=1, grid=grid, **groups)


def waves(orientation, wavelength, response="harmonic", amplitude=0.2):
    return {"orientation": orientation, "wavelength_over_a": wavelength, "response": response, "amplitude_over_film": amplitude}


def responses(r, cells, patterns):
    """Ad/Ai of each of the patterns, and R, of the contact on so many cells per a."""
    groups = {"sweep": {"case_file": "waves.csv", "output": "results.h5"},
              "conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1},
              "grid": DOMAIN | {"cells_x": round(4.5*cells), "cells_y": 4*cells}, "inlet": {"oil_over_flooded": r},
              "waviness": {"response": "harmonic"}}
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "sweep.nml").write_text(namelist(groups))
        rows = [f"{orientation},{wavelength}" for orientation, wavelength in patterns]
        Path(folder, "waves.csv").write_text("\n".join(["orientation,wavelength_over_a", *rows, ""]))
        outcome = run("sweep", "sweep.nml", folder=folder)
        assert outcome.returncode == 0, outcome.stdout + outcome.stderr
        with h5py.File(Path(folder, "results.h5")) as file:
            return file["harmonic_ratio"][:].tolist(), file["film_over_flooded"][0]


def limit(values):
    """At mesh size 0: Aitken where the differences fall, of an order of at most 2."""
    first, second = values[1] - values[0], values[2] - values[1]
    ratio = min(max(second/first, 0.25), 0.6) if abs(first) > 1e-9 else 0.25
    return values[2] + second*ratio/(1 - ratio)


def extrapolated(r, wave):
    """Ad/Ai and R at mesh size 0: the best a + b hX^2 through 64, 96 and 128 cells per a.

    Nodes that pass the meniscus move single grids up and down (theory eq. (C8)), which three grids average."""
    cells = (64, 96, 128)
    results = [contact(r, n, waviness=waves(*wave)) for n in cells]
    x = [(cells[0]/n)**2 for n in cells]
    means = [sum(result[name] for result in results)/3 for name in ("harmonic_ratio", "film_over_flooded")]
    shift = [one - sum(x)/3 for one in x]
    return [mean - sum(x)/3*sum(s*result[name] for s, result in zip(shift, results, strict=True))/sum(s*s for s in shift)
            for mean, name in zip(means, ("harmonic_ratio", "film_over_flooded"), strict=True)]


class Starvation(TestCase):
    def test_film(self):
        """R at mesh size 0 within 2 % of the other solver's; its error estimate covers the change on finer grids."""
        for r, (peer, _) in list(PEER.items())[::1 if IS_LONG else 2]:
            with self.subTest(r=r):
                results = [contact(r, cells) for cells in (16, 32, 64)]
                values = [result["film_over_flooded"] for result in results]
                deviation = self.check_close(values[2], limit(peer), 0.02, "R")
                self.assertLess(abs(values[1]/values[2] - 1), 2*results[1]["film_over_flooded_error"] + 1e-4)
                report(f"r = {r}: R {values}, other solver {limit(peer):.4f}, apart {deviation:.1e}")

    def test_error_of_ratio(self):
        """Also where two grids agree by chance, and where the gap is full from the inlet edge on."""
        for m, l, d, r, x_min, cells, edges in ((45.2, 6, 0.24, 0.49, -3.5, 64, "truncated"),
                                                (23, 3.3, 0.26, 2.7, -2.5, 48, "flooded")):
            found, fine = (solve(m=m, l=l, d=d, inlet={"oil_over_flooded": r}, grid={
                "x_min": x_min, "edges": edges, "cells_x": cells*n, "cells_y": cells*n}) for n in (1, 2))
            self.check_close(found["film_over_flooded"], fine["film_over_flooded"], found["film_over_flooded_error"], f"r = {r}")

    @unittest.skipIf(h5py is None, "no h5py: set EHLWAVE_PYTHON")
    def test_responses(self):
        """Ad/Ai on the grid of the other solver, where oil is not short."""
        some = slice(None, None, 1 if IS_LONG else 3)
        for r in (20, 2, 1) if IS_LONG else (1,):
            ratios, _ = responses(r, 64, WAVES[some])
            for pattern, ratio, peer in zip(WAVES[some], ratios, PEER[r][1][some], strict=True):
                with self.subTest(r=r, pattern=pattern):
                    self.assertLess(abs(ratio - peer), 0.03)

    @unittest.skipUnless(IS_LONG, "three grids of each contact: --long")
    def test_extrapolated_responses(self):
        """Ad/Ai of little oil at mesh size 0 within 0.03 of the other solver's, and within 0.02 after the correction
        for its film, too thin by its meniscus of first order.
        """
        for r, same in ((0.7, 0.671), (0.5, 0.4785)):
            apart, left = 0, 0
            for wave, peer in zip(WAVES, PEER[r][1], strict=True):
                ratio, film = extrapolated(r, wave)
                thinner, thin = extrapolated(same, wave)
                by_film = (ratio - thinner)/(film - thin)*(film - PEER[r][0][2])
                apart, left = max(apart, abs(ratio - peer)), max(left, abs(ratio - peer - by_film))
            report(f"r = {r}: Ad/Ai at most {apart:.4f} apart, {left:.4f} but for the film of the other solver")
            self.assertLess(apart, 0.03)
            self.assertLess(left, 0.02)

    @unittest.skipIf(h5py is None, "no h5py: set EHLWAVE_PYTHON")
    def test_responses_of_the_same_film(self):
        """Ad/Ai of little oil: its film matches the other solver's on its grid, where it is 3.5 and 4.5 % too thin."""
        for r, same, within in ((0.7, 0.671, 0.01), (0.5, 0.4785, 0.02))[0 if IS_LONG else 1:]:
            some = slice(1, None, 2 if IS_LONG else 4)
            ratios, film = responses(same, 64, WAVES[some])
            self.check_close(film, PEER[r][0][2], 0.005, "R")
            apart = max(abs(ratio - peer) for ratio, peer in zip(ratios, PEER[r][1][some], strict=True))
            report(f"r = {r}: Ad/Ai of the same film at most {apart:.4f} apart")
            self.assertLess(apart, within)

    def test_orders(self):
        """R is of second order and its estimate is right; Ad/Ai differs from finer grids by no more than its estimate."""
        wave = waves("transverse", 1)
        for r in (1, 0.5) if IS_LONG else (0.5,):
            results = [contact(r, cells, waviness=wave) for cells in (16, 32, 64)]
            films = [result["film_over_flooded"] for result in results]
            order = math.log2((films[1] - films[0])/(films[2] - films[1]))
            report(f"r = {r}: R {films}, order {order:.2f}")
            self.assertTrue(1.6 < order < 2.6)
            true = 1 - films[0]/films[2]
            self.assertTrue(0.6*true < results[0]["film_over_flooded_error"] < 2*true)
            for result in results[:2]:
                self.assertGreater(result["ratio_error_meniscus"], 0)
                change = abs(result["harmonic_ratio"]/results[2]["harmonic_ratio"] - 1)
                self.assertLess(change, result["error_estimate"])

    def test_accuracy(self):
        """An accuracy chooses a grid that resolves the meniscus, and is kept."""
        def ratio(**solver):
            return solve(m=100, l=12.05, d=1, grid={"edges": "flooded"} | ({} if solver else {"cells_x": 384, "cells_y": 192}),
                         inlet={"oil_over_flooded": 0.6}, waviness=waves("transverse", 1), **({"solver": solver} if solver else {}))
        asked = ratio(accuracy=0.1)
        self.assertLess(asked["error_estimate"], 0.1)
        self.check_close(asked["harmonic_ratio"], ratio()["harmonic_ratio"], 0.1, "Ad/Ai")
        coarse = contact(0.4, 16, waviness=waves("transverse", 1))
        self.assertEqual(coarse["status"], "unresolved")
        self.assertIn("meniscus", coarse["message"])

    def test_limits(self):
        """Plenty of oil is the flooded contact; of little oil all passes; a longer domain changes nothing."""
        flooded = contact(0)
        plenty = contact(20)
        self.check_close(plenty["central_film"], flooded["central_film"], 1e-3, "r = 20")
        self.assertAlmostEqual(plenty["flooded_central_film"], flooded["central_film"], delta=1e-9)
        little = contact(0.1, 32)
        self.check_close(little["film_over_flooded"], 0.1, 0.005, "R for r to 0")
        short = contact(0.8, grid={"x_min": -2.5, "x_max": 1.5, "edges": "flooded", "cells_x": 64})
        long = contact(0.8, grid={"x_min": -5, "x_max": 1.5, "edges": "flooded", "cells_x": 104})
        deviation = self.check_close(short["film_over_flooded"], long["film_over_flooded"], 1e-3, "a longer domain")
        report(f"domain -2.5 against -5: {deviation:.1e}")
        short, long = (solve(m=55, l=9.8, d=0.21, inlet={"oil_over_flooded": 1.91},
                             grid={"x_min": x, "x_max": 1.5, "edges": "flooded", "cells_x": cells, "cells_y": 48})
                       for x, cells in ((-3, 72), (-6, 120)))
        self.assertIn("a longer domain", short["warning"])
        self.check_close(short["film_over_flooded"], long["film_over_flooded"], short["film_error_domain"], "full to the edge")

    @unittest.skipIf(h5py is None, "no h5py: set EHLWAVE_PYTHON")
    def test_oil(self):
        """Inflow equals outflow, to the tolerance; the outflow behind the contact is the flow of its film and its
        sides.
        """
        with tempfile.TemporaryDirectory() as folder:
            groups = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1},
                      "grid": DOMAIN | {"cells_x": 72, "cells_y": 64}, "inlet": {"oil_over_flooded": 0.7}}
            Path(folder, "case.nml").write_text(namelist(groups))
            result = last_line(run("case", "case.nml", "--json", "--quiet", "--output", "case.h5", folder=folder))
            with h5py.File(Path(folder, "case.h5")) as file:
                offered, behind, content = file["layer_offered"][:], file["layer_behind"][:], file["content"][:]
                oil, pressure = content*file["film"][:], file["pressure"][:]
        self.assertLess(result["mass_balance_error"], 1e-6)
        weights = [1] + [2]*(len(behind) - 2)
        share = sum(weights*behind[:-1])/sum(weights*offered[:-1])
        self.assertAlmostEqual(share, 1 - result["side_flow"], delta=1e-6)
        self.check_close(offered[0], 0.7*result["flooded_central_film"], 0.3, "the layer offered is near r times the flooded film")
        self.assertLess(behind[0], offered[0])              # the contact pushes oil aside
        self.assertGreater(max(behind), 1.1*offered[0])     # it piles up beside the track
        self.assertTrue(0 < content.min() <= content.max() <= 1)
        self.assertEqual(abs(pressure[:, -3:]).max(), 0)
        for column in (-3, -2, -1):                         # behind the contact, to the last node
            self.assertLess(abs(oil[:-1, column] - behind[:-1]).max(), 1e-6)
        self.assertLess(abs(oil[-1] - offered[-1]).max(), 1e-6)   # beside it

    def test_march(self):
        """Waves of 1 % of the film in time against the linear response: 0.5 % of Ai."""
        for r in (2, 1, 0.6) if IS_LONG else (0.6,):
            result = contact(r, grid={"cells_x": 144}, waviness=waves("transverse", 0.5, "both", 0.01),
                             solver={"settling_periods": 2, "error_estimate": "model"})
            self.assertLess(abs(result["amplitude_ratio_fit"] - result["harmonic_ratio"]), 0.005)
            report(f"r = {r}: march {result['amplitude_ratio_fit']:.4f}, response {result['harmonic_ratio']:.4f}")

    @unittest.skipIf(h5py is None, "no h5py: set EHLWAVE_PYTHON")
    def test_halved_layer(self):
        """A layer halved on the way ends in the steady state of half the layer."""
        with tempfile.TemporaryDirectory() as folder:
            groups = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1},
                      "grid": DOMAIN | {"cells_x": 72, "cells_y": 32},
                      "inlet": {"oil_over_flooded": 1, "oil_change_factor": 0.5, "oil_change_start": 0.5},
                      "dynamics": {"end_time": 9}}
            Path(folder, "case.nml").write_text(namelist(groups))
            run("case", "case.nml", "--output", "case.h5", folder=folder)
            with h5py.File(Path(folder, "case.h5")) as file:
                film = file["film_at_centre"][:]
        steady = contact(0.5, grid={"cells_x": 72, "cells_y": 32})["central_film"]
        self.check_close(film[-1], steady, 5e-4, "end of the march")
        self.assertGreater(film[0], 1.5*steady)

    @unittest.skipIf(h5py is None, "no h5py: set EHLWAVE_PYTHON")
    def test_gap_in_the_layer(self):
        """A gap of length a with a tenth of the oil thins the film to about a tenth; then the film recovers."""
        with tempfile.TemporaryDirectory() as folder:
            groups = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1},
                      "grid": DOMAIN | {"cells_x": 72, "cells_y": 32},
                      "inlet": {"oil_over_flooded": 1, "oil_change_factor": 0.1, "oil_change_start": 0.5, "oil_change_length": 1},
                      "dynamics": {"end_time": 8}}
            Path(folder, "case.nml").write_text(namelist(groups))
            run("case", "case.nml", "--output", "case.h5", folder=folder)
            with h5py.File(Path(folder, "case.h5")) as file:
                film = file["film_at_centre"][:]
        self.assertTrue(0.08 < min(film)/film[0] < 0.2)
        self.check_close(film[-1], film[0], 5e-3, "after the gap")

    def test_profile(self):
        """A constant profile of 1 changes nothing; a groove thins the film; an asymmetric profile takes the whole
        domain.
        """
        def with_profile(rows):
            with tempfile.TemporaryDirectory() as folder:
                Path(folder, "layer.csv").write_text("y_over_b,layer_over_given\n" + "\n".join(rows) + "\n")
                return contact(0.8, inlet={"oil_profile": str(Path(folder, "layer.csv"))})

        plain = contact(0.8)["central_film"]
        self.check_close(with_profile(["0,1", "1,1"])["central_film"], plain, 1e-9, "ones")
        groove = with_profile(["0,0.5", "0.4,1"])["central_film"]
        self.assertLess(groove, 0.95*plain)
        self.check_close(with_profile(["-0.4,1", "0,0.5", "0.4,1"])["central_film"], groove, 1e-4, "whole domain")

    def test_lanes_narrower_than_a_cell(self):
        """A dry lane between two rows takes its oil from their cells, and makes the case unresolved, as does a spike."""
        def with_profile(rows):
            with tempfile.TemporaryDirectory() as folder:
                Path(folder, "layer.csv").write_text("y_over_b,layer_over_given\n" + "\n".join(rows) + "\n")
                return contact(0.8, inlet={"oil_profile": str(Path(folder, "layer.csv"))})

        plain = contact(0.8)
        lane = with_profile(["0,1", "0.01,1", "0.0101,0", "0.03,0", "0.0301,1", "3,1"])
        spike = with_profile(["0,1", "0.01,1", "0.011,30", "0.012,1", "3,1"])
        self.assertEqual((plain["status"], lane["status"], spike["status"]), ("converged", "unresolved", "unresolved"))
        for row in (lane, spike):
            self.assertIn("the oil profile has a ridge or dry lane", row["message"])
        self.assertLess(lane["central_film"], 0.98*plain["central_film"])
        self.assertGreater(spike["central_film"], 1.02*plain["central_film"])

    def test_meniscus_of_a_profile(self):
        """A fifth of five times the oil has the meniscus, and the grid, of that oil."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "layer.csv")
            path.write_text("y_over_b,layer_over_given\n0,0.2\n3,0.2\n")
            fifth = contact(2.5, inlet={"oil_profile": str(path)}, waviness=waves("transverse", 1))
        plain = contact(0.5, waviness=waves("transverse", 1))
        self.assertEqual((fifth["status"], plain["status"]), ("unresolved", "unresolved"))
        self.check_close(fifth["meniscus_resolution"], plain["meniscus_resolution"], 1e-12, "meniscus")
        self.check_close(fifth["harmonic_ratio"], plain["harmonic_ratio"], 1e-6, "Ad/Ai")

    def test_waves_after_a_change(self):
        """Ad/Ai behind a gap in the layer equals the value without a gap, within its estimated error; an early end
        gives a warning.
        """
        wavy = {"waviness": waves("transverse", 2, "transient", 0.05), "solver": {"error_estimate": "model"},
                "grid": {"cells_x": 36, "cells_y": 32}}
        plain = contact(1.3, **wavy)
        gap = {"oil_change_factor": 0.1, "oil_change_start": 1, "oil_change_length": 0.5}
        behind = contact(1.3, inlet=gap, **wavy)
        early = contact(1.3, inlet=gap, dynamics={"end_time": 8}, **wavy)
        apart = abs(behind["amplitude_ratio_fit"]/plain["amplitude_ratio_fit"] - 1)
        self.assertLess(apart, 0.02)
        self.assertLess(apart, behind["ratio_error_settling"] + plain["ratio_error_settling"])
        self.assertGreater(abs(early["amplitude_ratio_fit"]/plain["amplitude_ratio_fit"] - 1), 0.05)
        self.assertGreaterEqual(early["ratio_error_settling"], 1)
        self.assertIn("end_time", early["validity"])
        self.assertNotIn("end_time", behind["validity"])
        report(f"behind a gap {100*apart:.2f} % apart, said {100*behind['ratio_error_settling']:.2f} %")

    def test_layer_in_metres(self):
        """A layer in metres gives the corresponding oil over the flow of the flooded contact."""
        ball = {"radius_x_m": 0.0127, "radius_y_m": 0.0127, "reduced_modulus_pa": 2.26e11, "load_n": 40, "mean_speed_m_per_s": 2,
                "viscosity_pa_s": 0.05}
        groups = {"conditions": ball, "grid": {"cells_x": 64, "cells_y": 64}}
        layer = solve(inlet={"oil_layer_m": 3e-7}, **groups)
        share = solve(inlet={"oil_over_flooded": layer["oil_offered"]}, **groups)
        self.check_close(share["central_film_um"], layer["central_film_um"], 1e-6, "film")
        self.assertLess(layer["central_film_um"], 0.3)      # all of it at most, as oil that is compressed
        self.assertGreater(layer["central_film_um"], 0.2)

    def test_refusals(self):
        """Combinations that are not built are refused with the key and the reason."""
        wavy = waves("transverse", 1)
        for groups, words in (
            ({"solver": {"method": "fas"}}, ("oil_over_flooded", "newton")),
            ({"solver": {"method": "petsc"}}, ("oil_over_flooded", "newton")),
            ({"waviness": waves("transverse", 1, "periodic")}, ("periodic",)),
            ({"waviness": waves("transverse", 1, "transient"), "solver": {"time_step_over_cell": 2}}, ("time_step_over_cell",)),
            ({"waviness": wavy, "conditions": {"slip_parameter": 1.5}}, ("pure rolling",)),
            ({"inlet": {"oil_change_factor": 0.5}}, ("end_time",)),
            ({"inlet": {"oil_layer_m": 1e-7}}, ("oil_over_flooded",)),
        ):
            with self.subTest(groups=groups), self.assertRaises(AssertionError) as refused:
                contact(0.5, **groups)
            for word in words:
                self.assertIn(word, str(refused.exception).rsplit("ehlwave-case:", 1)[-1])

    def test_cost(self):
        """The starved solve takes at most 2.5 times the counted work of the flooded solve; measured 1.2 to 2.1.

        Of the last, the menisci are far from the contact, and the gap of the last two is full from the inlet edge on."""
        ratios = [contact(r, 32)["starved_over_flooded_work"] for r in ((2, 1, 0.6, 0.3) if IS_LONG else (1, 0.3))]
        for m, l, d, cells in ((1000, 12.05, 0.1, 128), (1000, 20, 0.3, 128), (100, 12.05, 0.1, 96),
                               (100, 2, 0.1, 96))[::1 if IS_LONG else 2]:
            grid = {"x_min": -4.5, "edges": "flooded", "cells_x": cells, "cells_y": 64}
            ratios.append(solve(m=m, l=l, d=d, grid=grid, inlet={"oil_over_flooded": 3})["starved_over_flooded_work"])
        report(f"starved over flooded: {[round(ratio, 2) for ratio in ratios]}")
        self.assertLess(max(ratios), 2.5)

    def test_oil_that_thins(self):
        """A shear-thinning oil costs no more, and with a high stress it has the Newtonian film."""
        films = []
        for oil in ({}, {"eyring_stress_pa": 1e16}, {"eyring_stress_pa": 5e6}):
            lubricant = {"flow_law": "eyring", **oil} if oil else {}
            found = solve(m=61, l=3.9, d=0.32, conditions={"reduced_modulus_pa": 2.26e11}, lubricant=lubricant,
                          grid={"x_min": -3.5, "edges": "truncated", "cells_x": 64, "cells_y": 64},
                          inlet={"oil_over_flooded": 0.57})
            self.assertLess(found["starved_over_flooded_work"], 2.5)
            films.append(found["central_film"])
        self.check_close(films[1], films[0], 1e-6, "Newtonian limit")
        self.check_close(films[2], films[0], 0.02, "Ree-Eyring")

    def test_line(self):
        """A line contact passes all oil that it is offered where that is little; nothing leaves over sides."""
        grid = {"x_min": -3, "x_max": 1.5, "cells_x": 288, "edges": "truncated"}
        result = solve(m=100, l=11, d=0, grid=grid, inlet={"oil_over_flooded": 0.5})
        self.check_close(result["film_over_flooded"], 0.5, 0.01, "R")
        self.assertLess(result["mass_balance_error"], 1e-6)


if __name__ == "__main__":
    unittest.main()
