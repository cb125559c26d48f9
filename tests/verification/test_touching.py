"""Surfaces that touch: values of an independent solver, the dry limits, oil that is kept, and cases without touching."""

import csv
import math
import unittest
from pathlib import Path

from ehlwave_program import IS_LONG, FolderTest, last_line, namelist, report, run, solve

try:
    import h5py
    import numpy
except ImportError:
    h5py = None

CONDITIONS = {"radius_x_m": 0.01, "reduced_modulus_pa": 226e9, "load_n_per_m": 100086.1376, "viscosity_pa_s": 0.04}
OIL = {"pressure_viscosity_per_pa": 2.2e-8, "roelands_index": 0.68, "flow_law": "eyring", "eyring_stress_pa": 10e6}
FILM_M = 20e-9
REFERENCE = Path(__file__).parent / "reference" / "touching_line.csv"


def reference(case, *shares):
    """Share, speed on 384 cells, extrapolated speed, area on 1536 cells, friction of the oil: an independent solver, eps
    averaged between nodes, at rest."""
    with REFERENCE.open(encoding="utf-8") as lines:
        rows = [row for row in csv.DictReader(lines) if row["case"] == case and float(row["share"]) in shares]
    return [(float(row["share"]), float(row["u_meshes"].split("/")[0]),
             *(float(row[name]) for name in ("u_m_s", "area_over_2b", "mu_oil"))) for row in rows]


SMOOTH, WAVY = reference("smooth", 0.02, 0.5, 0.95), reference("wavyC", 0.1, 0.5, 0.9)
WAVE = {"orientation": "transverse", "wavelength_over_a": 0.5, "amplitude_m": 50e-9}


def groups_of(cells, speed=0.03, slip=0, scheme=None, waviness=None, grid=None, load=1, **keys):
    """Input of the roller on so many cells; keys of &touching by name, film_m=None: without the group."""
    groups = {"conditions": CONDITIONS | {"mean_speed_m_per_s": speed, "slip_parameter": slip,
                                          "load_n_per_m": load*CONDITIONS["load_n_per_m"]},
              "lubricant": OIL, "grid": {"x_min": -4, "x_max": 2, "cells_x": cells, "edges": "truncated"} | (grid or {})}
    keys = {"film_m": FILM_M} | keys
    if keys["film_m"]:
        groups["touching"] = keys
    if waviness:
        groups["waviness"] = waviness
    if scheme:
        groups["solver"] = {"scheme": scheme}
    return groups


def contact(*arguments, **keys):
    return solve(**groups_of(*arguments, **keys))


def dry_pressure(x, gap, load):
    """Pressure of a dry contact with a gap over c at nodes x: the solids bear where they must, and only press."""
    h = x[1] - x[0]
    half = numpy.abs(x[:, None] - x)*1.0

    def integral(u):
        size = numpy.abs(u)
        return u*(math.log(16) + 1 - numpy.log(numpy.where(size > 0, size, 1)))

    kernel = 2/math.pi*(integral(half + h/2) - integral(half - h/2))
    bears = numpy.abs(x) < 1
    while True:
        n = bears.sum()
        matrix = numpy.zeros((n + 1, n + 1))
        matrix[:n, :n] = kernel[numpy.ix_(bears, bears)]
        matrix[:n, n] = -1
        matrix[n, :n] = h
        values = numpy.linalg.solve(matrix, numpy.append(-gap[bears], load))
        pressure = numpy.zeros_like(x)
        pressure[bears] = values[:n]
        excess = gap + kernel @ pressure - values[n]
        new = numpy.where(bears, pressure > 0, excess < -1e-12)
        if (new == bears).all():
            return pressure
        bears = new


class SpeedOfShare(FolderTest):
    def test_same_grid(self):
        """On the same grid the averaged scheme has the speeds of the independent solver."""
        for table, waviness in ((SMOOTH, None), (WAVY, WAVE)):
            for share, speed, *_ in table:
                found = contact(384, 0.05, scheme="averaged", waviness=waviness, share=share)
                self.check_close(found["mean_speed_m_per_s"], speed, 4e-4, f"speed at a share of {share}")
                self.check_close(found["touching_share"], share, 1e-8, "share")
                self.assertLess(found["residual"], 1e-9)

    def test_extrapolated(self):
        """The fitted scheme on 768 cells: within 5 % of the extrapolated speeds, friction and area as in the table."""
        for table, waviness, bound in ((SMOOTH, None, 0.01), (WAVY, WAVE, 0.05)):
            share, _, speed, area, friction = table[1]
            found = contact(768, 0.05, waviness=waviness, share=share)
            deviation = self.check_close(found["mean_speed_m_per_s"], speed, bound, "extrapolated speed")
            self.assertLessEqual(abs(found["mean_speed_m_per_s"]/speed - 1), found["mean_speed_error"])
            self.assertLessEqual(abs(found["touching_area"] - area), 0.02)
            self.check_close(-found["oil_friction_coefficient"], friction, 0.02, "friction of the oil")
            self.check_close(-found["solid_friction_coefficient"], 0.1*share, 1e-6, "friction of the solids")
            report(f"speed {deviation:.2%} off, stated error {found['mean_speed_error']:.2%}")

    def test_both_ways(self):
        """The speed does not depend on the one at which the continuation begins."""
        speeds = [contact(192, speed, waviness=WAVE, share=0.4)["mean_speed_m_per_s"] for speed in ((0.2, 0.05, 0.01) if IS_LONG else (0.2, 0.01))]
        self.check_close(max(speeds), min(speeds), 1e-7, "speeds")

    def test_given_speed(self):
        """At the speed of a share the solids bear that share."""
        found = contact(192, 0.02, share=0.6)
        again = contact(192, found["mean_speed_m_per_s"])
        self.check_close(again["touching_share"], 0.6, 1e-6, "share")


@unittest.skipIf(h5py is None, "needs h5py and numpy")
class DryLimits(FolderTest):
    def fields(self, groups):
        Path(self.folder, "case.nml").write_text(namelist(groups))
        outcome = run("case", "case.nml", "--json", "--quiet", "--output", "fields.h5", "--overwrite", folder=self.folder)
        assert outcome.returncode == 0, outcome.stdout + outcome.stderr
        with h5py.File(Path(self.folder, "fields.h5")) as file:
            return last_line(outcome), file["x"][:], numpy.squeeze(file["contact_pressure"][:])

    def test_dry_line(self):
        """Hardly any speed: area and peak of a dry solver on the same grid."""
        amplitude = 0.2e-6
        found, x, pressure = self.fields(groups_of(384, 1e-5, waviness=WAVE | {"amplitude_m": amplitude}))
        c = found["hertz_approach_c_m"]
        dry = dry_pressure(x, x**2 - amplitude/c*numpy.cos(2*math.pi*x/0.5), math.pi/2)
        self.check_close(found["touching_area"], (dry > 0).sum()*(x[1] - x[0])/2, 1e-3, "area")
        self.check_close(pressure.max(), dry.max(), 1e-3, "peak")

    def test_dry_wave(self):
        """Westergaard's half widths at the centre, where the mean pressure is that of Hertz."""
        wavelength = 0.1
        for half_width in (0.2, 0.3, 0.4) if IS_LONG else (0.3,):
            peak = 0.6e9/math.sin(math.pi*half_width)**2
            amplitude = 2*wavelength*1.06194690e-4*peak/(math.pi*226e9)
            found, x, pressure = self.fields(groups_of(576, 1e-4, grid={"x_min": -1.5, "x_max": 1.5}, waviness=WAVE | {
                "wavelength_over_a": wavelength, "amplitude_m": amplitude}))
            h = x[1] - x[0]
            touching = (numpy.abs(x) < wavelength/2) & (pressure > 0)
            self.assertLessEqual(abs(touching.sum()*h/2 - half_width*wavelength), h, f"half width {half_width}")
            self.assertGreater(found["touching_share"], 0.99)


class Marches(FolderTest):
    def test_rolling_wave(self):
        """A share that was marched by the independent solver on the same grid, with all oil kept."""
        found = contact(192, 0.03, 1, "averaged", WAVE | {"amplitude_m": 0.2e-6})
        self.check_close(found["touching_share"], 0.374, 0.02, "share")
        self.assertLess(found["residual"], 1e-9)
        self.assertFalse(found["touching_is_artefact"])
        self.assertEqual(found["solid_friction_coefficient"], 0)

    def test_report(self):
        """The printed report names neither another oil nor a range of small waves, which touching surfaces do not have."""
        (self.folder/"case.nml").write_text(namelist(groups_of(96, 0.03, 0.5, waviness=WAVE)))
        printed = run("case", "case.nml", folder=self.folder).stdout
        self.assertIn("Touching ", printed)
        self.assertRegex(printed, r"(?m)^Friction     coefficient [-\d.]+; shear by sliding up to")
        self.assertNotIn("(Newtonian oil)", printed)
        self.assertNotIn("respond", printed)

    def test_settling(self):
        """The error of a share that has not settled has its change from period to period."""
        early = contact(96, 0.03, 1, None, WAVE | {"amplitude_m": 0.2e-6})
        late = solve(**groups_of(96, 0.03, 1, waviness=WAVE | {"amplitude_m": 0.2e-6}), dynamics={"end_time": 12})
        off = abs(early["touching_share"] - late["touching_share"])
        self.assertGreater(off, 1e-3)
        self.assertGreater(early["touching_share_error"], late["touching_share_error"] + off)

    def test_error_of_speed(self):
        """Where the share is given, the report prints the error of the speed and no error of the share."""
        (self.folder/"case.nml").write_text(namelist(groups_of(96, share=0.3)))
        printed = run("case", "case.nml", folder=self.folder).stdout
        self.assertRegex(printed, r"(?m)^Touching     share 0\.3 of the load, area")
        self.assertRegex(printed, r"m/s \(relative error 0\.\d+\), friction of the oil")

    def test_artefact(self):
        """A share that falls with the mesh size is flagged."""
        found = contact(192, 0.1, 1, None, WAVE | {"amplitude_m": 0.1e-6})
        self.assertEqual(found["status"], "unresolved")
        self.assertTrue(found["touching_is_artefact"])

    def test_full_film_of_the_finest_mesh(self):
        """No touching on the finest mesh is no artefact, even where a wider mesh touches; the error has the difference."""
        found = contact(128, 0.1, 0, None, WAVE | {"wavelength_over_a": 1, "amplitude_m": 0.2e-6})
        self.assertEqual((found["status"], found["touching_share"], found["touching_is_artefact"]), ("converged", 0, False))
        self.assertGreater(found["touching_share_error"], 0.1)

    def test_no_wider_mesh(self):
        """A share without an error, as the march on half the cells fails: the warning has this reason."""
        found = contact(128, 0.03, 0.1, None, WAVE | {"amplitude_m": 0.2e-6})
        self.assertIsNone(found["touching_share_error"])
        self.assertIn("the mesh twice as wide has no solution", found["warning"])

    def test_full_film(self):
        """A film that is thick enough is that without touching."""
        full = contact(128, 0.5, 1, "averaged", film_m=None)
        found = contact(128, 0.5, 1, "averaged")
        for name in ("central_film", "minimum_film", "max_pressure"):
            self.check_close(found[name], full[name], 1e-5, name)
        self.assertEqual(found["touching_share"], 0)

    def test_soft_law(self):
        """The harder the solids, the closer the speed of a share to that of the hard law."""
        hard = contact(128, 0.02, share=0.5)["mean_speed_m_per_s"]
        distances = [abs(contact(128, 0.02, share=0.5, law="soft", softness_m=softness, stress_pa=3e8)["mean_speed_m_per_s"] - hard)
                     for softness in (4e-9, 2e-9, 1e-9)]
        self.assertGreater(distances[0], distances[1])
        self.assertGreater(distances[1], distances[2])
        self.assertLess(distances[2], 0.03*hard)


class Ball(FolderTest):
    GROUPS = {
        "conditions": {"radius_x_m": 0.01, "radius_y_m": 0.01, "reduced_modulus_pa": 226e9, "load_n": 20.72,
                       "mean_speed_m_per_s": 1e-3, "viscosity_pa_s": 0.04, "slip_parameter": 0},
        "lubricant": {"pressure_viscosity_per_pa": 2.2e-8, "roelands_index": 0.68},
        "touching": {"film_m": FILM_M},
        "grid": {"x_min": -2.5, "x_max": 1.5, "y_max": 2, "cells_x": 64, "cells_y": 64, "edges": "truncated"},
    }

    def test_dry_ball(self):
        """Isotropic waves of 0.1 um at hardly any speed: area and peak of an independent dry solver on the same grid."""
        found = solve(**self.GROUPS, waviness={"orientation": "isotropic", "wavelength_over_a": 1, "amplitude_m": 1e-7})
        self.check_close(found["touching_area"], 0.9363, 1e-3, "area")
        self.check_close(found["max_total_pressure"], 1.5575, 1e-3, "peak")
        self.assertLess(found["residual"], 1e-9)

    def test_share(self):
        """A smooth ball on a coarse grid: the speed of a share gives that share."""
        grid = self.GROUPS["grid"] | {"cells_x": 32, "cells_y": 32}
        found = solve(**self.GROUPS | {"grid": grid, "touching": {"film_m": FILM_M, "share": 0.5}})
        conditions = self.GROUPS["conditions"] | {"mean_speed_m_per_s": found["mean_speed_m_per_s"]}
        again = solve(**self.GROUPS | {"grid": grid, "conditions": conditions})
        self.check_close(again["touching_share"], 0.5, 1e-6, "share")

    def march(self, cells=48, amplitude_m=2e-7, slip=1, speed=0.1, touching=True, orientation="isotropic", **groups):
        conditions = self.GROUPS["conditions"] | {"mean_speed_m_per_s": speed, "slip_parameter": slip}
        grid = self.GROUPS["grid"] | {"cells_x": cells, "cells_y": cells}
        wave = {"orientation": orientation, "wavelength_over_a": 1, "amplitude_m": amplitude_m}
        groups = self.GROUPS | {"conditions": conditions, "grid": grid, "waviness": wave, "solver": {"scheme": "averaged"}} | groups
        return solve(**{name: keys for name, keys in groups.items() if touching or name != "touching"})

    def test_march(self):
        """Marches of a ball with isotropic waves that touch, in rolling and sliding, of a Newtonian and a Ree-Eyring oil."""
        eyring = self.GROUPS["lubricant"] | {"flow_law": "eyring", "eyring_stress_pa": 1e7}
        for slip, lubricant in ((1, self.GROUPS["lubricant"]), (1.5, eyring))[0 if IS_LONG else 1:]:
            found = self.march(slip=slip, speed=0.05, lubricant=lubricant)
            self.assertGreater(found["touching_share"], 0.01)
            self.assertLess(found["residual"], 1e-9)
            self.assertEqual(found["touching_meshes"], 2)
            plan = found["counted_work_units"]/found["expected_work_units"]
            self.assertLess(abs(math.log(plan)), math.log(2), "work over plan")
            report(f"work over plan: {plan:.2f}")

    def test_impossible_friction(self):
        """A Newtonian oil that slides under more than twice the Hertz pressure has no friction that could be given."""
        found = self.march(cells=32, slip=1.5, speed=0.05)
        self.assertIsNone(found["friction_coefficient"])
        self.assertIsNone(found["oil_friction_coefficient"])
        self.assertIn("no friction coefficient is given: the oil would have", found["warning"])
        self.assertGreater(found["touching_share"], 0)

    def test_full_film_march(self):
        """A film thicker than the waves: the mean film of the march without touching."""
        full = self.march(amplitude_m=2e-8, speed=1, touching=False)
        found = self.march(amplitude_m=2e-8, speed=1)
        self.assertEqual(found["touching_share"], 0)
        self.check_close(found["mean_film"], full["mean_film"], 1e-4, "mean film")


class Refusals(FolderTest):
    def refuse(self, text, groups):
        Path(self.folder, "case.nml").write_text(namelist(groups))
        outcome = run("case", "case.nml", "--json", folder=self.folder)
        self.assertNotEqual(outcome.returncode, 0)
        self.assertIn(text, outcome.stderr)

    def test_keys(self):
        self.refuse("film_m is missing", groups_of(128) | {"touching": {"share": 0.5}})
        self.refuse("softness_m", groups_of(128, law="soft"))
        self.refuse("amplitude_m", groups_of(128, waviness={"orientation": "transverse", "wavelength_over_a": 0.5}))
        self.refuse("remove share", groups_of(128, slip=1, waviness=WAVE, share=0.5))
        self.refuse("response", groups_of(128, slip=1, waviness=WAVE | {"response": "harmonic"}))
        self.refuse("oil_over_flooded", groups_of(128) | {"inlet": {"oil_over_flooded": 1}})


if __name__ == "__main__":
    unittest.main()
