"""Flooded edges: a small domain against large ones, the routes, a march, line contacts; truncated edges for comparison."""

import unittest

from ehlwave_program import TestCase, report, solve

PAPER = (-2.5, 1.5, 2)
LARGE = (-10, 3, 6)
# Film and Ad/Ai, transverse waves of a: measured 1e-4, 7e-4; 4e-4, 1.0e-3; 8e-4, 5e-4 (truncated 2.2, 2.8 and 3.6 % of the film)
CONTACTS = ((100, 12.05, 1, 0.003), (500, 12.05, 0.12, 0.006), (20, 5, 1, 0.003))


def contact(m, l, d, domain, edges, cells=16, **groups):  # noqa: E741
    """A contact on so many cells per a."""
    x_min, x_max, y_max = domain
    grid = {"x_min": x_min, "x_max": x_max, "cells_x": round((x_max - x_min)*cells), "edges": edges}
    if d > 0:
        grid |= {"y_max": y_max, "cells_y": round(2*y_max*cells)}
    return solve(m=m, l=l, d=d, grid=grid, **groups)


def waves(response="harmonic", amplitude=0.2):
    return {"orientation": "transverse", "wavelength_over_a": 1, "response": response, "amplitude_over_film": amplitude}


class Edges(TestCase):
    def test_small_domain(self):
        """Effect of the paper's domain on the film and Ad/Ai, without more GMRES steps."""
        for m, l, d, band in CONTACTS:  # noqa: E741
            with self.subTest(m=m, d=d):
                large = contact(m, l, d, LARGE, "flooded", waviness=waves())
                small = contact(m, l, d, PAPER, "flooded", waviness=waves())
                cut = contact(m, l, d, PAPER, "truncated", waviness=waves())
                film = self.check_close(small["central_film"], large["central_film"], band, "film")
                ratio = self.check_close(small["harmonic_ratio"], large["harmonic_ratio"], band, "Ad/Ai")
                self.assertGreater(abs(cut["central_film"]/large["central_film"] - 1), 10*film)
                self.assertLessEqual(small["linear_steps"], 1.15*cut["linear_steps"])
                self.assertLessEqual(small["harmonic_linear_steps"], cut["harmonic_linear_steps"] + 1)
                report(f"M = {m}, D = {d}: film {film:.1e}, Ad/Ai {ratio:.1e}")

    def test_larger_domains_converge(self):
        """The error falls with the domain, and both edges to the same film."""
        films = [contact(20, 5, 1, domain, "flooded")["central_film"] for domain in (PAPER, (-5, 2, 4), LARGE)]
        self.assertLess(abs(films[1] - films[2]), 0.5*abs(films[0] - films[2]))
        self.check_close(contact(20, 5, 1, LARGE, "truncated")["central_film"], films[2], 0.002, "truncated")

    def test_errors_have_what_lies_outside(self):
        """At a fixed mesh size, a domain four times as large (rubber: twice) changes both by less than their errors by
        the domain.
        """
        sliding = {"conditions": {"slip_parameter": 1.6, "reduced_modulus_pa": 2.26e11}}
        soft = {"conditions": {"radius_x_m": 0.01, "radius_y_m": 0.05, "reduced_modulus_pa": 2e7, "load_n": 5.0, "mean_speed_m_per_s": 0.5,
                               "viscosity_pa_s": 0.05, "slip_parameter": 1.2}, "lubricant": {"viscosity_law": "isoviscous"}}
        for name, cells, times, groups in (
                ("light", 32, 4, {"m": 5, "l": 2, "d": 1, **sliding}),
                ("isoviscous", 32, 4, {"m": 100, "l": 3, "d": 0.2, **sliding, "lubricant": {"viscosity_law": "isoviscous"}}),
                ("thinning", 32, 4, {"m": 20, "l": 5, "d": 1, **sliding, "lubricant": {"flow_law": "eyring", "eyring_stress_pa": 5e6}}),
                ("rubber", 96, 2, soft)):
            small, large = (solve(**groups, grid={"x_min": -2.5*size, "x_max": 1.5*size, "y_max": 2*size, "edges": "flooded",
                                                  "cells_x": cells*size, "cells_y": cells*size}) for size in (1, times))
            for quantity, error in (("friction_coefficient", "friction_error"), ("minimum_film", "minimum_film_error")):
                off = abs(small[quantity]/large[quantity] - 1)
                report(f"{name}: {quantity} {off:.2%} off, declared {small[error + '_domain']:.2%} of {small[error]:.2%}")
                self.assertLess(off, small[error + "_domain"], f"{name}: {quantity}")
                self.assertLess(small[error + "_domain"], small[error])

    def test_rolling_has_no_friction_and_no_error_of_it(self):
        rolling = solve(m=100, l=12.05, d=1, grid={"cells_x": 32, "cells_y": 32}, conditions={"reduced_modulus_pa": 2.26e11})
        self.assertEqual([rolling[name] for name in ("friction_coefficient", "friction_error", "friction_error_domain")], [0, None, None])

    def test_heavy_steel_hardly_feels_what_lies_outside(self):
        heavy = solve(m=500, l=12, d=0.3, grid={"cells_x": 96, "cells_y": 64, "edges": "flooded"}, conditions={"slip_parameter": 1.1, "reduced_modulus_pa": 2.26e11},
                      lubricant={"flow_law": "eyring", "eyring_stress_pa": 5e6})
        self.assertTrue(0 < heavy["friction_error_domain"] < 0.01)

    def test_line(self):
        """The far field of a line contact is exact but for Hertz's gap: measured 1e-6 of the film."""
        for m, l in ((100, 11), (20, 5)):  # noqa: E741
            large = contact(m, l, 0, (-40, 2, 0), "truncated", 64)
            self.check_close(contact(m, l, 0, PAPER, "flooded", 64)["central_film"], large["central_film"], 1e-4, "film")

    def test_routes(self):
        """Newton's method, FAS and the whole domain come to the same."""
        newton = contact(100, 12.05, 0.5, PAPER, "flooded", solver={"tolerance": 1e-8})
        fas = contact(100, 12.05, 0.5, PAPER, "flooded", solver={"tolerance": 1e-8, "method": "fas"})
        self.check_close(fas["central_film"], newton["central_film"], 1e-7, "FAS")
        grid = {"cells_x": 64, "cells_y": 64, "edges": "flooded", "domain": "whole"}
        whole = solve(m=100, l=12.05, d=0.5, grid=grid, solver={"tolerance": 1e-8})
        self.check_close(whole["central_film"], newton["central_film"], 1e-7, "whole domain")

    def test_march(self):
        """Small waves in time and the linear response see the same edges, by both methods."""
        for method in ("newton", "fas"):
            result = contact(100, 12.05, 1, PAPER, "flooded", waviness=waves("both", 0.01),
                             solver={"method": method, "settling_periods": 2, "error_estimate": "model"})
            self.check_close(result["amplitude_ratio_fit"], result["harmonic_ratio"], 2e-3, method)


if __name__ == "__main__":
    unittest.main()
