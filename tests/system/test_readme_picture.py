"""The picture of the first page: its points are computed again, its curve is fitted again, and it is drawn again."""

import importlib.util
import io
import os
import re
import unittest
from pathlib import Path

from ehlwave_program import IS_LONG, FolderTest, last_line, namelist, report, run
from test_readme_numbers import ROOT, agrees, cell, found_in, table, words

PICTURE = ROOT/"postprocess/record/quick/figure2.png"
COMPUTED = {"load_parameter_m": ("50", "200") if IS_LONG else ("50",), "radius_ratio_d": ("1", "0.12") if IS_LONG else ("0.12",), "wavelength_over_a": ("1.4",)}
"""Points that are computed again, in every orientation."""
HAS_PACKAGES = all(importlib.util.find_spec(name) for name in ("xarray", "matplotlib", "lmfit", "PIL"))


def again():
    return [row for row in table("quick/points.csv") if all(row[key] in values for key, values in COMPUTED.items())]


class Points(FolderTest):
    def test_programs_give_the_points(self):
        text = (ROOT/"inputs/paper_quick.nml").read_text(encoding="utf-8")
        grid, waves = (re.search(rf"&{name}\n.*?\n/", text, re.DOTALL)[0] for name in ("grid", "waviness"))
        self.assertEqual(len(again()), 12 if IS_LONG else 3)
        largest = longest = 0
        for row in again():
            conditions = {key: float(row[key]) for key in ("load_parameter_m", "radius_ratio_d")}
            wave = waves.replace("&waviness", f"&waviness\n  orientation = '{row['orientation']}'\n  wavelength_over_a = {row['wavelength_over_a']}")
            (self.folder/"case.nml").write_text(namelist({"conditions": {**conditions, "lubricant_parameter_l": 12.05}}) + f"{wave}\n{grid}\n")
            outcome = run("case", "case.nml", "--json", "--quiet", folder=self.folder)
            self.check_status(outcome)
            result = last_line(outcome)
            ratio = result["amplitude_ratio" if row["orientation"] == "longitudinal" else "amplitude_ratio_fit"]
            largest = max(largest, abs(ratio - float(row["deformed_ratio"])))
            bar = abs(ratio*result["amplitude_ratio_error"] - float(row["deformed_error"]))
            longest = max(longest, bar/float(row["deformed_error"]))
        report(f"Ad/Ai computed again: at most {largest:.1e} off, error bars {100*longest:.1f} %")
        self.assertLess(largest, 2e-3)
        self.assertLess(longest, 0.05)

    def test_every_orientation_and_ratio_has_points(self):
        points = table("quick/points.csv")
        self.assertEqual(len(points), cell("quick/refit.csv", "points", group="all", variable="f_v"))
        self.assertEqual({row["orientation"] for row in points}, {"transverse", "isotropic", "longitudinal"})
        self.assertEqual({float(row["radius_ratio_d"]) for row in points}, {1, 0.35, 0.12, 0.04})


@unittest.skipUnless(HAS_PACKAGES, "the packages that draw are not there")
class Picture(unittest.TestCase):
    def points(self):
        import numpy as np
        import xarray as xr
        rows = table("quick/points.csv")
        columns = {key: [row[key] if key == "orientation" else float(row[key] or "nan") for row in rows] for key in rows[0]}
        return xr.Dataset({key: ("case", values) for key, values in columns.items()}
                          | {"is_point_resolved": ("case", np.full(len(rows), True))})

    def drawn(self):
        from ehlwave.results.figures import collapse_figure
        holder = io.BytesIO()
        collapse_figure(self.points(), "f_v").savefig(holder, dpi=300)
        return holder

    def image(self, source):
        import numpy as np
        from PIL import Image
        with Image.open(source) as picture:
            return np.asarray(picture.convert("RGB")).astype(int)

    def test_the_fit_belongs_to_the_points(self):
        from ehlwave import fit_formula, point_weights
        points = self.points()
        x, ratio = points["f_v"].values, points["deformed_ratio"].values
        fit = fit_formula(x, ratio, weight=point_weights(x, ratio, points["deformed_error"].values))
        printed = found_in(words("README.md"), "c1 = {} and c2 = {}")
        for one, name in zip(printed, ("c1", "c2"), strict=True):
            self.assertAlmostEqual(getattr(fit, name)/cell("quick/refit.csv", name, group="all", variable="f_v"), 1, delta=1e-3)
            self.assertTrue(agrees(one, getattr(fit, name)), (one, getattr(fit, name)))

    def test_the_picture_shows_the_points(self):
        import matplotlib as mpl
        import numpy as np
        if mpl.__version_info__[:2] < (3, 11):
            self.skipTest("the picture has the texts of matplotlib 3.11: with 3.9, 3.6 % of its pixels differ")
        kept, drawn = self.image(PICTURE), self.image(self.drawn())
        self.assertLess(np.abs(np.subtract(kept.shape, drawn.shape)).max(), 6)   # other fonts
        rows, columns = (min(kept.shape[i], drawn.shape[i]) for i in (0, 1))
        off = np.abs(kept[:rows, :columns] - drawn[:rows, :columns]).max(axis=2) > 60
        report(f"picture: {100*off.mean():.2f} % of its pixels differ from the picture drawn anew")
        self.assertLess(off.mean(), 0.02)

    def test_every_ratio_has_a_colour_of_its_own(self):
        import numpy as np
        from ehlwave.results.colour_key import COLOURS
        pixels = self.image(PICTURE).reshape(-1, 3)
        self.assertGreater(len(np.unique(pixels @ [65536, 256, 1])), 256)
        for colour in COLOURS[:4]:
            wanted = [int(colour[i:i + 2], 16) for i in (1, 3, 5)]
            self.assertGreater((np.abs(pixels - wanted).max(axis=1) <= 2).sum(), 500, colour)


@unittest.skipUnless(HAS_PACKAGES, "the packages of postprocess are not there")
class FiveLines(unittest.TestCase):
    def test_they_print_what_the_page_says(self):
        import contextlib
        text = (ROOT/"README.md").read_text(encoding="utf-8")
        begin = text.index("    import ehlwave\n")
        lines = [line[4:] for line in text[begin:].split("\n\n")[0].splitlines()]
        self.assertEqual(len(lines), 5)
        said, here = io.StringIO(), Path.cwd()
        os.chdir(ROOT)
        try:
            with contextlib.redirect_stdout(said):
                exec("\n".join(lines), {})   # the lines of the page
        finally:
            os.chdir(here)
        for line in said.getvalue().splitlines():
            self.assertIn(f"`{line}`", text)


class Block(unittest.TestCase):
    def test_three_ways_in_stand_at_the_top(self):
        lines = (ROOT/"README.md").read_text(encoding="utf-8").splitlines()
        self.assertLessEqual(len(lines), 150)
        self.assertEqual(sum(line.startswith("![") for line in lines), 1)
        top = lines[lines.index("## Start"):50]
        for command in ("pip install ./postprocess", "import ehlwave", "ehlwave app", "scripts/reproduce", "scripts/test"):
            self.assertIn("    " + command, top)


if __name__ == "__main__":
    unittest.main()
