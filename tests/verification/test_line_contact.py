"""Line contacts, D = 0: published values, orders, formula, linear response against transient, domain of input."""

import math
import unittest

from ehlwave_program import TestCase, report, solve
from studies.published.values import line_ratios, small_line_ratios

# Bands in Ai, by the shortest wave of their range. Measured 0.004 at 0.5 a and longer, 0.017 at 0.25 a, 0.050 at 0.125
# a, to 3e-4: the published z, alpha and error are unknown.
PUBLISHED_BANDS = ((0.5, 0.006), (0.25, 0.025), (0.125, 0.055))
LARGE_BAND = 0.02        # at Ai = 0.5 Hc; measured 0.015
# Moes (1992), Barus and incompressible; measured +0.038 to -0.062. With the default lubricant films lie 1 to 28 per cent
# below it, most of that by the density at the contact centre.
FORMULA_BAND = 0.07
SMALL = 1e-3             # transient at Ai = 1 % of the film against the linear response; measured 1e-4


def line(m, l, cells, **groups):  # noqa: E741
    return solve(m=m, l=l, d=0, grid={"cells_x": cells}, **groups)


def waves(wavelength, response="harmonic", amplitude=0.01):
    return {"orientation": "transverse", "wavelength_over_a": wavelength, "response": response,
            "amplitude_over_film": amplitude}


def band(wavelength):
    return next(allowed for shortest, allowed in PUBLISHED_BANDS if wavelength >= shortest)


def moes_formula(m, l):  # noqa: E741
    """Central film, (h/Rx)(2U)^(-1/2)."""
    ri, ei = 3/m, 2.621*m**-0.2
    s = (7 + 8*math.exp(-2*ei/ri))/5
    elastic = (ri**(7/3) + ei**(7/3))**(3*s/7)
    if l == 0:
        return elastic**(1/s)
    rp, ep = 1.287*l**(2/3), 1.311*m**-0.125*l**0.75
    return (elastic + (rp**-3.5 + ep**-3.5)**(-2*s/7))**(1/s)


def response(result):
    return complex(result["harmonic_real"], result["harmonic_imaginary"])


class LineContact(TestCase):
    def test_plans_of_light_contacts(self):
        """Work within a factor of 2 of the plan, which the cap on work is a multiple of; room for a thick film."""
        for m, law in ((2, "barus"), (5, "roelands"), (20, "roelands")):
            with self.subTest(m=m, law=law):
                row = solve(m=m, l=12, d=0, grid={"cells_x": 4096, "x_min": -20, "x_max": 3}, lubricant={"viscosity_law": law})
                self.assertEqual(row["status"], "converged", row["message"])
                self.check_close(math.log2(row["counted_work_units"]/row["expected_work_units"]) + 2, 2, 0.5, f"M = {m}: work")
        row = solve(m=2, l=12, d=0, lubricant={"viscosity_law": "barus"}, solver={"accuracy": 0.01}, grid={"edges": "flooded"})
        self.assertEqual(row["status"], "converged", row["message"])

    def test_published_ratios(self):
        found = {}
        published = small_line_ratios()
        self.assertEqual(len(published), 6)
        for wavelength, ratio in published.items():
            found[wavelength] = line(100, 11, 2048, waviness=waves(wavelength))["harmonic_extrapolated"]
            self.assertLessEqual(abs(found[wavelength] - ratio), band(wavelength), f"lambda = {wavelength} a")
        report(", ".join(f"lambda = {key} a: {value:.4f} ({published[key]})" for key, value in found.items()))

    def test_published_marches(self):
        """Difference of a march from the linear response on 256 cells, and on 2048."""
        found = {}
        for one in (one for one in line_ratios() if one.wavelength_over_a in (1, 0.5)):
            wavelength, amplitude = one.wavelength_over_a, one.amplitude_over_film
            small = line(100, 11, 2048, waviness=waves(wavelength))["harmonic_extrapolated"]
            result = line(100, 11, 256, waviness=waves(wavelength, "both", amplitude), solver={"settling_periods": 4})
            ratio = small + result["amplitude_ratio"] - result["harmonic_ratio"]
            found[wavelength, amplitude] = ratio - one.amplitude_ratio
            self.assertLessEqual(abs(found[wavelength, amplitude]), LARGE_BAND if amplitude > 0.2 else band(wavelength),
                                 f"lambda = {wavelength} a, Ai = {amplitude} Hc: {ratio}")
        self.assertEqual(len(found), 6)
        report(", ".join(f"lambda = {wave} a, Ai = {ai} Hc: {off:+.4f}" for (wave, ai), off in found.items()))

    def test_orders(self):
        results = [line(100, 11, cells, waviness=waves(0.5)) for cells in (512, 1024, 2048)]
        film = self.check_order([result["central_film"] for result in results], 1.8, "H(0,0)")
        ratio = self.check_order([result["harmonic_ratio"] for result in results], 1.8, "Ad/Ai")
        truth = results[-1]["harmonic_extrapolated"]
        for result in results:
            self.assertLessEqual(abs(result["harmonic_extrapolated"]/truth - 1), result["harmonic_error"])
        report(f"order of H(0,0) {film:.2f}, of Ad/Ai {ratio:.2f}")

    def test_film_formula(self):
        deviations = {}
        for m, l in [(10, 2), (20, 0), (20, 5), (30, 25), (50, 10), (100, 11), (200, 5), (500, 0), (1000, 20)]:
            result = line(m, l, 2048, lubricant={"viscosity_law": "barus", "density_law": "incompressible"})
            self.assertEqual(result["status"], "converged")
            self.assertLess(result["load_error"], 1e-6)
            deviations[m, l] = result["central_film_moes"]/moes_formula(m, l) - 1
            self.assertLessEqual(abs(deviations[m, l]), FORMULA_BAND, f"M = {m}, L = {l}")
        report(", ".join(f"M={m} L={l}: {value:+.3f}" for (m, l), value in deviations.items()))

    def test_wave_parameters(self):
        result = line(100, 11, 256, waviness=waves(0.5))
        alphabar = 11*math.sqrt(100/(2*math.pi))
        self.check_close(result["alphabar"], alphabar, 1e-12, "alphabar")
        self.check_close(result["lambdabar"], 1.5*math.pi**2/100**2, 1e-12, "lambdabar")
        self.check_close(result["v"], 0.5*100**0.75/math.sqrt(11), 1e-12, "V")
        self.check_close(result["v"], (2*math.pi)**0.75*0.5*alphabar**1.5/11**2, 1e-12, "V from alphabar")
        self.check_close(result["v2"], 0.5*math.sqrt(100/11), 1e-12, "V2")
        self.assertEqual((result["kappa"], result["cells_y"]), (0, 1))
        self.assertTrue(0.2 <= result["total_work_units"]/result["expected_work_units"] <= 5, "work that the plan expects")

    def test_small_transients(self):
        """On the same grid, several periods after the pattern has passed."""
        worst = (0, "")
        for slip, wavelength, cells in [(1, 0.5, 256), (0.5, 1, 256), (1.5, 1, 256)]:
            result = line(50, 8, cells, conditions={"slip_parameter": slip}, waviness=waves(wavelength, "both"),
                          solver={"settling_periods": 4, "step_tolerance": 1e-5, "tolerance": 1e-8})
            name = f"S = {slip}, lambda = {wavelength} a"
            deviation = self.check_close(result["harmonic_ratio"], result["amplitude_ratio_fit"], SMALL, name)
            turn = abs(math.remainder(result["harmonic_phase"] - result["phase_fit"], 2*math.pi))
            self.assertLessEqual(turn, SMALL, name)
            self.assertIsNotNone(result["amplitude_ratio_error"])
            worst = max(worst, (deviation, name))
        report(f"{worst[0]:.1e} at {worst[1]}")

    def test_standing_pattern(self):
        result = line(50, 8, 256, conditions={"slip_parameter": 0}, waviness=waves(1, "both"))
        self.check_close(result["harmonic_ratio"], result["amplitude_ratio_fit"], SMALL, "S = 0")

    def test_waves_along_the_line(self):
        """Oblique waves of a line, whose wave number along it is exact, against slender ellipses: 1 % of Ai, less the slenderer."""
        pattern = {"orientation": "custom", "wavelength_x_over_a": 1, "wavelength_y_over_a": 2, "response": "harmonic"}
        eyring = {"flow_law": "eyring", "eyring_stress_pa": 5e6}
        for name, slip, lubricant in (("rolling", 1, {}), ("sliding, Ree-Eyring", 1.5, eyring)):
            conditions = {"slip_parameter": slip, "reduced_modulus_pa": 226e9}
            groups = {"lubricant": lubricant, "conditions": conditions}
            oblique = solve(m=50, d=0, **groups, grid={"cells_x": 128}, waviness={**pattern, "oblique": True})
            self.assertEqual(oblique["harmonic_approach"], 0)
            transverse = solve(m=50, d=0, **groups, grid={"cells_x": 128}, waviness={**pattern, "wavelength_y_over_a": 0})
            self.assertGreater(abs(response(oblique) - response(transverse)), 0.01)      # it is seen that they are oblique
            differences = []
            for d, cells_y in ((0.1, 192), (0.02, 512)):
                smooth = solve(m=100, d=d, grid={"cells_x": 64, "cells_y": 64})
                m = 100*(oblique["alphabar"]/smooth["alphabar"])**3
                ellipse = solve(m=m, d=d, **groups, grid={"cells_x": 128, "cells_y": cells_y}, waviness=pattern)
                differences.append(abs(response(ellipse) - response(oblique)))
            self.assertLess(differences[-1], 0.01)
            self.assertLess(differences[-1], differences[0])
            report(f"waves along the line, {name}: {100*differences[0]:.2f} % of Ai from the ellipse of D = 0.1, "
                   f"{100*differences[1]:.2f} % from that of 0.02")

    def test_fine_grid_is_cheap(self):
        """Steps do not grow with the grid: 8192 cells; measured 16 GMRES steps, half a second."""
        result = line(100, 11, 8192, waviness=waves(2))
        self.assertLessEqual(result["harmonic_linear_steps"], 25)
        self.assertLessEqual(result["nonlinear_steps"], 10)
        report(f"{result['harmonic_linear_steps']} GMRES steps of the response, {result['seconds']:.2f} s")

    def test_petsc_agrees(self):
        try:
            checked = line(50, 8, 256, solver={"method": "petsc"})
        except AssertionError as refusal:
            if "PETSc" not in str(refusal):
                raise
            self.skipTest("built without PETSc")
        self.check_close(checked["central_film"], line(50, 8, 256)["central_film"], 1e-5, "H(0,0)")


if __name__ == "__main__":
    unittest.main()
