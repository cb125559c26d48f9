"""The experiment of Venner, Kaneta and Lubrecht (2000), section 4: smooth central film at 0.024 m/s, and the study's input."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import SKIPPED, TestCase, last_line, report, run, solve

try:
    from ehlwave.cli import main
    from studies.experiment.cases import SMOOTH, read_input, shared_groups
    from studies.experiment.measure import richardson
except ImportError as error:
    print(f"SKIPPED: ehlwave cannot be imported ({error})")
    sys.exit(SKIPPED)

INPUTS = Path(__file__).parents[2]/"inputs"/"full"
PAPER_UM = 0.24                    # text of section 4
ALLOWED = 0.03


class Experiment(TestCase):
    def test_smooth_central_film_at_the_lowest_speed(self):
        base = read_input(INPUTS/"experiment.nml")
        films = []
        for cells in (128, 192, 256):
            groups = {**shared_groups(SMOOTH, base, None), "grid": {"cells_x": cells, "cells_y": cells//2}}
            films.append(solve(**groups)["central_film_um"])
        coarse, fine = richardson(*films[:2], 1.5), richardson(films[0], films[2], 2)
        report(f"smooth central film {fine.value:.5f} um, {coarse.value:.5f} um from the coarser pair, {films} um on the grids")
        self.check_close(fine.value, PAPER_UM, ALLOWED, "smooth central film at 0.024 m/s, um")
        # both pairs of grids have the same limit, else there is no order to extrapolate with
        self.check_close(coarse.value, fine.value, 0.003, "extrapolated film, um")
        self.assertLess(fine.error, 0.01*fine.value)

    def test_input_of_the_study_with_the_surface_its_heading_tells_to_write(self):
        with tempfile.TemporaryDirectory() as folder:
            surface = str(Path(folder, "sputtered_wave.h5"))
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(main(["surface", str(INPUTS/"sputtered_profile.csv"), "--period", "60", "--repeat", "16", "--output", surface]), 0)
            outcome = run("case", INPUTS/"experiment.nml", "--plan", "--json", folder=folder)
        self.check_status(outcome)
        plan = last_line(outcome)
        self.assertTrue(plan["is_resolved"])
        self.assertEqual(plan["time_steps"], 4.5*64)


if __name__ == "__main__":
    unittest.main()
