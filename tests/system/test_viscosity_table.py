"""Measured viscosities from a file: films, messages beyond the table, refusals."""

import math
import unittest

from ehlwave_program import FolderTest, last_line, namelist, report, run

CONTACT = {"radius_x_m": 0.0125, "radius_y_m": 0.0125, "reduced_modulus_pa": 2.26e11, "load_n": 40,
           "mean_speed_m_per_s": 0.5, "viscosity_pa_s": 0.05}
GRID = {"cells_x": 64, "cells_y": 64}
TABLE = {"viscosity_law": "table", "viscosity_table": "oil.csv"}
ALPHA, INDEX, P0 = 2.2e-8, 0.68, 1.96e8


def roelands(p):
    """Viscosity of the oil of CONTACT by Roelands' law."""
    return 0.05*math.exp(ALPHA*P0/INDEX*((1 + p/P0)**INDEX - 1))


def rows(largest, count):
    """Table of that oil at equidistant pressures."""
    pressures = [largest*i/(count - 1) for i in range(count)]
    return "pressure_pa,viscosity_pa_s\n" + "".join(f"{p!r},{roelands(p)!r}\n" for p in pressures)


class ViscosityTables(FolderTest):
    def run_case(self, table, lubricant, *arguments, **groups):
        (self.folder/"oil.csv").write_text(table)
        inputs = {"conditions": CONTACT, "grid": GRID, "lubricant": lubricant, **groups}
        (self.folder/"case.nml").write_text(namelist(inputs))
        return run("case", "case.nml", "--json", *arguments, folder=self.folder)

    def solve(self, table, lubricant, **groups):
        outcome = self.run_case(table, lubricant, "--quiet", **groups)
        self.check_status(outcome)
        return last_line(outcome)

    def test_table_of_roelands_is_roelands(self):
        expected = self.solve("", {"pressure_viscosity_per_pa": ALPHA, "roelands_index": INDEX})
        result = self.solve(rows(1.5e9, 30), TABLE)
        # alpha of M, L is the film-forming coefficient, not the ambient-pressure coefficient: films in metres are
        # compared
        for name in ("central_film_um", "minimum_film_um"):
            deviation = self.check_close(result[name], expected[name], 1e-3, name)
            report(f"30 pressures: {name} within {deviation:.1e}")
        self.assertNotIn("table", result["warning"])
        self.assertEqual((result["nonlinear_steps"], result["rung"]), (expected["nonlinear_steps"], "direct"))
        self.assertEqual(result["viscosity_file"], "oil.csv")
        self.assertNotIn("viscosity_file", expected)

    def test_pressures_beyond_the_table_are_said(self):
        needle = "and viscosity_law = 'table' is known up to 0.6 GPa: beyond that it is extrapolated"
        outcome = self.run_case(rows(6e8, 12), TABLE, "--plan")
        self.assertIn("WARNING: pressures reach 0.8584 GPa " + needle, outcome.stdout)
        self.assertIn(needle, last_line(outcome)["validity"])
        result = self.solve(rows(6e8, 12), TABLE)
        self.assertIn(needle, result["warning"])
        self.assertEqual(result["status"], "converged")
        # waves take pressures beyond a table that the smooth contact does not leave
        smooth = result["max_pressure"]*result["hertz_pressure_pa"]
        enough = rows(1.005*smooth, 20)
        self.assertNotIn("table", self.solve(enough, TABLE)["warning"])
        waves = {"orientation": "transverse", "wavelength_over_a": 1.0, "amplitude_over_film": 0.5}
        self.assertIn("beyond that it is extrapolated", self.solve(enough, TABLE, waviness=waves)["warning"])

    def test_numbers_alone_make_the_digest(self):
        table = rows(1.5e9, 8)
        digests = [last_line(self.run_case(text, TABLE, "--plan"))["viscosity_digest"]
                   for text in (table, "# an oil\n" + table, table.replace("0.05\n", "0.0501\n"))]
        self.assertEqual(digests[0], digests[1])
        self.assertNotEqual(digests[0], digests[2])

    def assert_refused(self, message, table, lubricant, **groups):
        outcome = self.run_case(table, lubricant, "--plan", **groups)
        self.check_status(outcome, 2)
        self.assertIn(message, outcome.stderr)

    def test_refusals(self):
        table = rows(1.5e9, 8)
        start = "case.nml: &lubricant viscosity_table: "
        self.assert_refused("&lubricant viscosity_table is missing: viscosity_law = 'table' needs it", table,
                            {"viscosity_law": "table"})
        idle = " belongs to viscosity_law = 'table'"
        self.assert_refused("viscosity_table = 'oil.csv'" + idle, table, {"viscosity_table": "oil.csv"})
        self.assert_refused("temperature_k = 313.15" + idle, table, {"temperature_k": 313.15})
        self.assert_refused(start + "no.csv: no such file", table, {**TABLE, "viscosity_table": "no.csv"})
        self.assert_refused(start + "oil.csv:4: column viscosity_pa_s: ",
                            table.replace(f"{roelands(3e9/7)!r}", "thick"), TABLE)
        self.assert_refused(start + "oil.csv:2: the first pressure_pa is ", "".join(table.splitlines(True)[:1] +
                                                                                    table.splitlines(True)[2:]), TABLE)
        self.assert_refused("has 0.05 Pa s at ambient pressure, which &conditions viscosity_pa_s = 0.051 contradicts",
                            table, TABLE, conditions={**CONTACT, "viscosity_pa_s": 0.051})
        warm = "temperature_k,pressure_pa,viscosity_pa_s\n" + "".join(
            f"{t},{p},{roelands(p)*math.exp(-0.04*(t - 313))}\n" for t in (313, 353) for p in (0, 1e8, 4e8, 1e9))
        self.assert_refused(start + "oil.csv: has 2 temperatures, 313 to 353 K: &lubricant temperature_k is needed",
                            warm, TABLE)
        self.assert_refused("temperature_k = 360 is outside the table", warm, {**TABLE, "temperature_k": 360})


if __name__ == "__main__":
    unittest.main()
