"""Sensitivities of film and response to the oil against centred differences of whole runs."""

import math
import unittest

from ehlwave_program import TestCase, report, solve

STEP = 1e-4         # step in the logarithm of a property
AGREEMENT = 1e-6    # relative
TIGHT = {"tolerance": 1e-10, "response_tolerance": 1e-9, "largest_steps": 100}


def waves(orientation="isotropic"):
    return {"waviness": {"orientation": orientation, "wavelength_over_a": 1, "response": "harmonic"}, "solver": TIGHT}


def moes(flow_law, d=1, edges="truncated", **conditions):
    """Input of a contact as a function of factors on alpha and on the stress; alpha leaves M, ph and E' tau0 as they are."""
    def groups(alpha=1, stress=1):
        lubricant = {"pressure_viscosity_per_pa": 2.2e-8*alpha, "flow_law": flow_law}
        if flow_law == "eyring":
            lubricant["eyring_stress_pa"] = 5e6*stress
        if flow_law == "carreau":
            lubricant |= {"carreau_modulus_pa": 7e6*stress, "carreau_exponent": 0.4}
        grid = {"cells_x": 48, "cells_y": 48} if d else {"cells_x": 192}
        grid["edges"] = edges
        return {"m": 50, "l": 11*alpha, "d": d, "lubricant": lubricant, "grid": grid,
                "conditions": {"reduced_modulus_pa": 2.26e11, **conditions},
                **waves("isotropic" if d else "transverse")}
    return groups


def doolittle(alpha=1, stress=1):
    """A contact in SI unitswith constant load, speed and geometry; Doolittle's factor acts on ln(eta/eta0)."""
    return {"conditions": {"radius_x_m": 0.0125, "radius_y_m": 0.02, "reduced_modulus_pa": 2.26e11, "load_n": 20,
                           "mean_speed_m_per_s": 0.5, "viscosity_pa_s": 0.08, "slip_parameter": 1.2},
            "lubricant": {"viscosity_law": "doolittle", "density_law": "tait", "doolittle_factor": 4*alpha,
                          "doolittle_occupied_fraction": 0.66, "tait_modulus_pa": 1.7e9, "tait_modulus_rate": 11,
                          "flow_law": "eyring", "eyring_stress_pa": 4e6*stress},
            "grid": {"cells_x": 48, "cells_y": 48}, **waves()}


def transfer(result):
    return complex(result["harmonic_real"], result["harmonic_imaginary"])


class Sensitivities(TestCase):
    def check(self, name, groups, properties=("alpha", "stress"), agreement=AGREEMENT):
        result = solve(**groups(), output={"sensitivities": True})
        self.assertEqual(result["status"], "converged")
        worst = 0
        for which in properties:
            up, down = (solve(**groups(**{which: math.exp(side*STEP)})) for side in (1, -1))
            film = math.log(up["central_film"]/down["central_film"])/(2*STEP)
            worst = max(worst, self.check_close(result[f"film_sensitivity_{which}"], film, AGREEMENT, f"{name}: film, {which}"))
            response = (transfer(up) - transfer(down))/(2*STEP)
            found = complex(result[f"response_real_by_{which}"], result[f"response_imaginary_by_{which}"])
            deviation = abs(found - response)/abs(response)
            self.assertLessEqual(deviation, agreement, f"{name}: response, {which}: {found} against {response}")
            worst = max(worst, deviation)
            self.check_close(result[f"response_sensitivity_{which}"], (found/transfer(result)).real, 1e-4, f"{name}: ratio, {which}")
        report(f"{name}: largest deviation {worst:.1e}")
        return result

    def test_eyring(self):
        result = self.check("Ree-Eyring, S = 1.5", moes("eyring", slip_parameter=1.5))
        self.assertGreater(result["film_sensitivity_alpha"], 10*result["film_sensitivity_stress"])

    def test_carreau(self):
        self.check("Carreau, S = 0.6", moes("carreau", slip_parameter=0.6))

    def test_line(self):
        self.check("line contact, Ree-Eyring, S = 1.2", moes("eyring", d=0, slip_parameter=1.2))

    def test_flooded_edges(self):
        """Changes by waves at the edges are not differentiated."""
        self.check("flooded edges", moes("eyring", edges="flooded", slip_parameter=1.5), agreement=1e-5)

    def test_law_with_parameters_of_its_own(self):
        self.check("Doolittle, SI units", doolittle)

    def test_newtonian(self):
        """To alpha only; by nothing at constant viscosity."""
        result = self.check("Newtonian, S = 1.5", moes("newtonian", slip_parameter=1.5), ["alpha"])
        groups = moes("newtonian")()
        groups["lubricant"] = {"viscosity_law": "isoviscous"}
        constant = solve(**groups, output={"sensitivities": True})
        for name in ("film_sensitivity", "response_sensitivity", "response_real_by", "response_imaginary_by"):
            self.assertIsNone(result[f"{name}_stress"])
            self.assertIsNone(constant[f"{name}_alpha"])

    def test_not_asked_for(self):
        """No response in the result; a smooth contact has the sensitivities of its film alone."""
        groups = moes("eyring")()
        self.assertNotIn("film_sensitivity_alpha", solve(**groups))
        del groups["waviness"]
        smooth = solve(**groups, output={"sensitivities": True})
        self.assertGreater(smooth["film_sensitivity_alpha"], 0.4)
        self.assertIsNone(smooth["response_sensitivity_alpha"])


if __name__ == "__main__":
    unittest.main()
