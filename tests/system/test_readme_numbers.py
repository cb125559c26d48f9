"""Numbers of READMEs against their source files, or against the programs.

A claim is a piece of a README with `{}` for each number, and the values of these numbers. A number agrees with a value that rounds
to it in the printed digits; a bound ("within 4 %", "at most") is not below the value and less than a unit of its last
digit above.
"""

import csv
import json
import math
import re
import tempfile
import unittest
from functools import cache
from pathlib import Path
from typing import NamedTuple

from ehlwave_program import last_line, report, run, solve

ROOT = Path(__file__).resolve().parents[2]
RECORD = ROOT/"postprocess/record"
NUMBER = r"[-+]?\d+(?:\.\d+)?(?:e-?\d+)?"


class Bound(NamedTuple):
    """The largest of something that a README promises to stay below."""

    value: float


@cache
def table(name):
    """The rows of a CSV file of the records."""
    with (RECORD/name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def cells(name, column, **where):
    """Numbers of a column, in the rows where other columns have these values."""
    found = [float(row[column]) for row in table(name) if all(row[key] == value for key, value in where.items())]
    assert found, f"{name}: no {column} where {where}"
    return found


def cell(name, column, **where):
    found = cells(name, column, **where)
    assert len(found) == 1, f"{name}: {len(found)} rows where {where}"
    return found[0]


def percents(values):
    return [100*value for value in values]


def small_waves(column, **where):
    return cells("speed/small_waves.csv", column, **where)


def across():
    """Factors that linear responses gain over marches, of waves that move."""
    return [float(row["factor"]) for row in table("speed/small_waves.csv") if row["orientation"] != "longitudinal"]


def top_level():
    surfaces = table("microgeometry/table.csv")
    small = [row for row in surfaces if float(row["amplitude_over_film"]) < 0.3]
    bounds = [Bound(100*max(float(row[f"error_{by}_over_rq"]) for row in small)) for by in ("default", "table", "formula")]
    marched, small_wave = (small_waves(name, orientation="isotropic")[0] for name in ("march", "linear_response"))
    minutes = sum(cells("full/stages.csv", "seconds"))/60
    quick = {name: cell("quick/refit.csv", name, group="all", variable="f_v") for name in ("points", "c1", "c2")}
    loads = cells("quick/points.csv", "load_parameter_m")
    refit = {"varied": "grid", "points": "resolved, L = 12.05", "orientation": "all"}
    c1, c2 = ([cell("full/tables/refits.csv", f"{name}{end}", **refit) for end in ("", " from", " to")] for name in ("c1", "c2"))
    small_v = {"points of": "L = 12.05"}
    mean = cell("full/tables/formula_small_v.csv", "mean", **small_v, **{"f(r) V": "0.8 to 1.5"})
    unresolved, points = (sum(cells("full/tables/unresolved_on_paper_grid.csv", name)) for name in ("not resolved", "points"))
    films = [cell("full/tables/experiment-comparison.csv", "this code", quantity=f"mean film, computed at {speed} m/s")
             for speed in ("0.024", "0.048", "0.096")]
    return [
        ("Points: {} contacts, M = {} to {}, L = 12.05", [quick["points"], min(loads), max(loads)]),
        ("fitted to the points, c1 = {} and c2 = {}", [quick["c1"], quick["c2"]]),
        ("repeats the whole study, {} minutes on two cores", [minutes]),
        ("{} counted work units in place of {}, a factor of {}.", [small_wave, marched, marched/small_wave]),
        ("c1 = {} [{}, {}], c2 = {} [{}, {}] at L = 12.05", [*c1, *c2]),
        ("by {} at f V = 0.8 to 1.5 in the mean, {} at most", [mean, max(cells("full/tables/formula_small_v.csv", "largest", **small_v))]),
        ("{} of {} points are not resolved", [unresolved, points]),
        ("measured 0.28, 0.42, 0.70 um | {}, {}, {} um", films),
        validated(),
        ("differ from simulated ones by at most {} % of Rq where the amplitude is below 30 % of the film. "
         "With a table computed for the contact (`--table`) it is {} %, with the paper's formula {} %", bounds),
    ]


def one_contact():
    return [("is {} to {} times cheaper for waves across the motion (M = 100", [min(across()), max(across())]),
            ("It is {} times cheaper for longitudinal waves", small_waves("factor", orientation="longitudinal"))]


SURFACES = {"ground": "ground-like map, Rq 30 nm", "dent": "dent, 60 nm", "ridge": "ridge, 50 nm", "sputtered": "sputtered pattern, 145 nm"}


def microgeometry():
    claims, of_row = [], "{} m/s | {} | {} % | {} % | {} % | {} % |"
    for surface, name in SURFACES.items():
        values = []
        for row in table("microgeometry/table.csv"):
            if row["surface"] == surface:
                errors = [float(row[f"error_{by}_over_rq"]) for by in ("formula", "linear", "table", "default")]
                values += [float(row["speed_m_per_s"]), float(row["amplitude_over_film"]), *percents(errors)]
        claims.append((f"| {name} | {of_row} | | {of_row}", values))
    amplitudes = percents(cells("microgeometry/table.csv", "error_amplitudes_over_rq"))
    shift, left, default = (cells("microgeometry/table.csv", f"mean_shift_{part}over_rq", surface="sputtered")
                            for part in ("", "left_", "default_"))
    rises = [shift, [a - b for a, b in zip(shift, left, strict=True)], [a - b for a, b in zip(shift, default, strict=True)]]
    claims += [
        ("amplitudes but no phase it is {} to {} %", [min(amplitudes), max(amplitudes)]),
        ("The waves of the sputtered pattern raise its mean film by {} and {} Rq", rises[0]),
        ("by the rises of the table, of second order, it is {} and {} Rq, by the rises of the atlas {} and {} Rq", rises[1] + rises[2]),
    ]
    return claims + lambda_ratios()


def lambda_ratios():
    """Traces as the README has them: ground, honed, isotropic, measured."""
    claims = []
    for contact, conditions in (("ball", "M = 39, L = 12"), ("experiment", "M = 134, L = 6.6")):
        get = lambda column, contact=contact: cells("microgeometry/lambda_ratios.csv", column, contact=contact)  # noqa: E731
        formula = get("lambda_by_formula")
        four = "{}, {}, {}, {}"
        undeformed = sum(get("lambda_undeformed"))/4
        claims.append((f"| {conditions} | {{}} | {four}{' (honed second)' if contact == 'ball' else ''} | {four} | {four} % | {{}} to {{}} |",
                       [undeformed, *get("lambda_predicted"), *get("lambda_simulated"), *percents(get("error")), min(formula), max(formula)]))
    rows = [row for row in table("microgeometry/lambda_ratios.csv") if row["contact"] == "experiment"]
    on_grid = [100*(float(row["lambda_predicted"])/float(row["lambda_on_grid"]) - 1) for row in rows]
    claims.append(("which is {} % too thin at M = 134, those are {} to {} %",
                   [100*float(rows[0]["own_error_of_film"]), min(on_grid), max(on_grid)]))
    return claims


def study():
    refit = {"varied": "grid", "points": "resolved, L = 12.05", "orientation": "all"}
    c1, c2 = ([cell("full/tables/refits.csv", f"{name}{end}", **refit) for end in ("", " from", " to")] for name in ("c1", "c2"))
    rms = [cell("full/tables/refits.csv", column, **refit) for column in ("rms refitted", "rms of (18)")]
    by_l = [cell("full/tables/refits.csv", "rms of (18)", varied="L", points=f"L = {value}", orientation="all") for value in ("2.5", "20")]
    small_v = [cell("full/tables/formula_small_v.csv", "mean", **{"points of": "L = 12.05", "f(r) V": part})
               for part in ("0.1 to 0.2", "0.8 to 1.5")]
    largest = max(cells("full/tables/formula_small_v.csv", "largest", **{"points of": "L = 12.05"}))
    printed = [cell("full/tables/companion.csv", "this code", quantity=f"Ad/Ai, isotropic, {how}")
               for how in ("on 257 x 257 nodes", "extrapolated")]
    line = cells("full/tables/line_published.csv", "this code")
    where = "full/tables/experiment-comparison.csv"
    films = {kind: [cell(where, "this code", quantity=f"mean film, {kind} at {speed} m/s") for speed in ("0.024", "0.048", "0.096")]
             for kind in ("computed", "second order")}
    unresolved = cells("full/tables/unresolved_on_paper_grid.csv", "not resolved")
    points = cells("full/tables/unresolved_on_paper_grid.csv", "points")
    return [
        ("257 x 257 nodes {} of {} points are not resolved", [sum(unresolved), sum(points)]),
        ("the grid alone adds up to {} to Ad/Ai",
         [cell("full/tables/paper_grid_error.csv", "largest", points="resolved on the paper's grid")]),
        ("c1 = {} [{}, {}], c2 = {} [{}, {}] at L = 12.05; rms {}, of (18) {}.", [*c1, *c2, *rms]),
        ("(18) has an rms of {} at L = 2.5 and {} at L = 20", by_l),
        ("by {} at f V = 0.1 to 0.2 and {} at 0.8 to 1.5 in the mean, {} at most", [*small_v, largest]),
        ("{} for isotropic waves on the paper's grid, {} resolved", printed),
        ("| {}, {}, {}, {}, {} | | V of a line", line),
        ("of the experiment, 0.24 um | {} um", [cell(where, "this code", quantity="smooth central film at 0.024 m/s")]),
        ("(measured 0.28, 0.42, 0.70) | {}, {}, {} um", films["computed"]),
        ("| the same | {}, {}, {} um for the cosine by its linear response", films["second order"]),
        ("0.13 um (measured 0.15) | {} um", [cell(where, "this code", quantity="amplitude of the film, computed at 0.024 m/s")]),
    ]


def validation():
    film = table("validation/mourier_film.csv")
    outside = [row for row in film if row["dimple"] == "outside"]
    weights = [float(row["points"]) for row in outside]
    rms = math.sqrt(sum(w*float(row["rms, %"])**2 for w, row in zip(weights, outside, strict=True))/sum(weights))
    claims = [
        ("55 points of the film | outside the dimple within {} %, rms {} % (aim 5 %); inside within {} % (aim 8 %)",
         [max(float(row["worst, %"]) for row in outside), rms, float(film[-1]["worst, %"])]),
        ("0.839 | {}, {}, {}, {}, {}, {}, mesh", cells("validation/venner_oils.csv", "default")),
    ]
    rows = (("central", "central: Nijenbanning, Venner, Moes (1994)", "Nijenbanning, Venner, Moes"),
            ("central", "Hamrock, Dowson (1977)", "Hamrock, Dowson"), ("central", "Chittenden and others (1985)", "Chittenden and others"),
            ("smallest", "smallest: Hamrock, Dowson", "Hamrock, Dowson"))
    for film, printed, formula in rows:
        where = {"film": film, "formula": formula, "D": "all"}
        claims.append((f"| {printed} | {{}} % | {{}} % | {{}} %", [cell("validation/films.csv", name, **where)
                                                                 for name in ("mean, %", "rms, %", "worst, %")]))
    return claims


def better_formula():
    ladder = "full/tables/formula_ladder.csv"
    three = ("rounded", "paper", "refitted")
    claims = [("x = {} (lambda_n/a) (gamma M)^(1/2)", [cell("full/tables/formula_parameters.csv", "rounded", parameter="C")])]
    claims.append(("| conditions held out of the fit | {} | {} | {} |", [cell(ladder, "rms held out", formula=name) for name in three]))
    for text, group in (("of them L = 12.05, the paper's", "L = 12.05"), ("L = 20", "L = 20"), ("L = 2.5", "L = 2.5")):
        columns = ("rms recommended, held out", "rms (18)", "rms (18) refitted")
        claims.append((f"| {text} | {{}} | {{}} | {{}} |", [cell("full/tables/formula_residuals.csv", name, group=group) for name in columns]))
    for text, name in (("nine fresh conditions", "fresh"), ("the paper's own points, resolved", "resolved")):
        claims.append((f"| {text} | {{}} | {{}} | {{}} |", [cell(f"full/tables/formula_{name}.csv", "rms", formula=one) for one in three]))
    largest = cell(ladder, "largest held out", formula="rounded")
    return [*claims, ("The largest error of the recommended one is {};", [largest])]


def two_waves():
    errors = lambda name, column="rms of |a + c|/Ai": cell("two_waves/errors.csv", column, points=name)  # noqa: E731
    claims = [
        ("tau0 1 to 30 MPa or Newtonian | {} | {} | {} |",
         [errors("conditions held out of the fit", "conditions"), errors("conditions held out of the fit"),
          errors("one half of what enters, c = (1 - a)/2")]),
        ("| of them 0.5 <= S <= 1.5 | {} | {} |", [errors("0.5 <= S <= 1.5", "conditions"), errors("0.5 <= S <= 1.5")]),
        ("| fresh, in no fit | {} | {} |", [errors("fresh conditions, as installed", "conditions"), errors("fresh conditions, as installed")]),
        ("film by `corrected_film` | {} | {} |", [errors("fresh conditions, as installed, film by formula", "conditions"),
                                                errors("fresh conditions, as installed, film by formula")]),
        ("The table has {} waves. Complex, fresh waves are met within {}. Below S = 0.5 it is {}.",
         [errors("conditions held out of the fit", "number"), errors("fresh conditions, as installed", "rms of a + c"),
          cell("two_waves/slip.csv", "rms of |a + c|/Ai", S="0 to 0.5")]),
        ("Newtonian oils are met less well ({}) than Ree-Eyring ones ({})", [errors("of them Newtonian"), errors("Ree-Eyring")]),
    ]
    for slip in ("1.3", "0.7"):
        for text, column in (("computed waves", "error, computed waves"), ("law alone", "error, law")):
            claims.append((f"| {slip}, {text} | {{}} | {{}} | {{}} | {{}} |", percents(cells("two_waves/passing.csv", column, S=slip))))
    seconds = sum(cell("full/stages.csv", "seconds", stage=name) for name in ("two_waves", "sliding"))
    return [*claims, ("computes the needed cases ({} s on two cores)", [seconds])]


def rolling():
    """The transfer of pure rolling."""
    closer, formula = "closer fit, conditions held out", "recommended formula, four numbers"
    rms = [cell("two_waves/rolling.csv", "rms of Ad/Ai", formula=name) for name in (closer, formula)]
    mean, most = ([cell("two_waves/rolling.csv", column, formula=name) for name in (closer, formula)]
                  for column in ("mean of formula/Ad below 0.1", "largest of it"))
    return [("rms of Ad/Ai {} (recommended {}), with phase {}; below Ad/Ai = 0.1 it is {} % too large in the mean "
             "and {} % at most ({} % and a factor {}).",
             [*rms, cell("two_waves/rolling.csv", "rms with phase", formula=closer), *percents([mean[0] - 1, most[0] - 1, mean[1] - 1]),
              most[1]])]


ATLASES = ("rolling", "rolling_wide", "sliding", "sliding_wide", "line", "line_sliding", "line_newtonian")


def of_atlas(kind, *names):
    """Attributes of a file of the atlas; None without xarray."""
    try:
        import xarray
    except ImportError:
        return None
    with xarray.open_dataset(ROOT/f"postprocess/src/ehlwave/laws/atlas/{kind}.nc") as data:
        return [data.attrs[name] for name in names]


def atlas_files():
    """Sizes and points of the files of the atlas."""
    claims = []
    for kind in ATLASES:
        points = of_atlas(kind, "responses", "contacts")
        if points is not None:
            size = (ROOT/f"postprocess/src/ehlwave/laws/atlas/{kind}.nc").stat().st_size
            claims.append((f"| `{kind}.nc` | {{}} KB | {{}} responses of {{}} contacts", [size/1000, *map(float, points)]))
    return claims


def bar(name):
    """Error of a law, as the package has it."""
    table = (ROOT/"postprocess/src/ehlwave/error_bars.csv").read_text()
    return float(re.search(rf"^{re.escape(name)},([\d.]+),", table, re.M)[1])


def atlas():
    """Errors that the files of the atlas state about themselves, and errors of lines."""
    found = [of_atlas(kind, "rise_cross_validated") for kind in ATLASES]
    rises = [json.loads(one[0]) for one in found if one is not None]
    claims = [] if not rises else [
        ("has a median error of {} in contacts that roll (wide: {}), {} under slip (wide: {}), {} in line contacts and {} in those that slide "
         "(Newtonian: {}), in units of (A/film)^2 of the film, and {} (wide: {}), {} (wide: {}), {} and {} ({}) at 95 % of the waves",
         [one["median"] for one in rises] + [one["95 %"] for one in rises])]
    slip = [bar(f"two_waves.{oil}") for oil in ("newtonian", "carreau", "ree-eyring")]
    return [*claims, *lines_of_atlas(), ("have the law alone, within {}, {} and {} of Ai", slip)]


def lines_of_atlas():
    """Line contacts of the atlas beside computed contacts."""
    claims = []
    for of, name in (("line", "line"), ("line_sliding", "line, sliding"), ("line_newtonian", "line, sliding, Newtonian")):
        for what, row in (("film response, units of Ai", name), ("film response, M > 100", f"{name}, M > 100"),
                          ("central film, relative", f"central film, {name}")):
            if row not in ("line, M > 100", "central film, line, sliding, Newtonian"):
                columns = ("conditions", "within the bar [%]", "median", "median bar", "95 %", "largest")
                claims.append((f"| {row} | {{}} | {{}} % | {{}} | {{}} | {{}} | {{}} |",
                               [cell("atlas/lines.csv", column, of=of, what=what) for column in columns]))
    return claims


def atlas_elements():
    """Contacts of machines that the atlas answers."""
    claims = []
    for of in ("rollers", *(f"{machine} in a {law} oil" for machine in ("gears", "cams") for law in ("Ree-Eyring", "Newtonian"))):
        where = {"of": of.replace("rollers", "bearing rollers"), "what": "film response, units of Ai"}
        answered = cell("atlas/machines.csv", "answered", **where)
        films = [100*cell("atlas/machines.csv", "median", of=where["of"], what=f"{one} film, relative") for one in ("central", "smallest")]
        columns = ("conditions", "within the bar [%]", "median")
        claims.append((f"| {of} | {{}} of 300, {{}} % | {{}} | {{}} % | {{}} | {{}} % | {{}} % |",
                       [answered, answered/3, *(cell("atlas/machines.csv", column, **where) for column in columns), *films]))
    return claims


def validated():
    """Amplitudes up to which predictions were compared with marches."""
    text = (ROOT/"postprocess/src/ehlwave/surface/amplitude.py").read_text()
    found = [re.search(rf"{name} = ([\d.]+), ([\d.]+)", text).groups()
             for name in ("VALIDATED_ROLLING, VALIDATED_SLIDING", "SLIGHT_SLIP, VALIDATED_FASTER")]
    return ("up to amplitudes (sqrt(2) Rq) of {} films in pure rolling, {} films where S is within 1 +- {}, and {} films at any other S",
            [float(one) for pair in found for one in pair])


def postprocess():
    return [validated()]


def thin_films():
    """Tables of marches of rough maps in films as thin as the maps are rough."""
    claims = []
    for row in table("lambda/trusted.csv"):
        errors = [row[f"{name}_error_largest"] for name in ("lambda", "mean", "rq")]
        values = [row["marched"], row["touch_somewhere"]]
        claims.append((f"| {row['motion']} | {row['rq_over_film']} | {{}} | {{}} | {{}} % | {{}} % | {{}} % | {{}} |",
                       [float(one) for one in values] + percents(map(float, errors)) + [float(row["lowest_film"])]))
    lowest = {row["contacts"]: row for row in table("lambda/lowest.csv")}["held out"]
    return [*claims, ("95 % of the lowest films are then within {} of the smooth film, by linear responses within {}",
                      [float(lowest["corrected_95"]), float(lowest["linear_95"])])]


def roughness():
    errors = [bar(f"film.{name}") for name in ("formula", "formula_line")]
    return [*microgeometry(), *thin_films(), *postprocess(), ("too thin and {} % too thick in 95 % of contacts", [100*errors[0]]),
            ("up to 40 %, in line contacts up to {} %", [100*errors[1]])]


def record():
    first = [row for row in table("linearity/linearity.csv")]
    def largest(amplitude, column="fit_over_linear"):
        return 100*max(abs(float(row[column]) - 1) for row in first if row["amplitude_over_film"] == amplitude)
    return [
        ("agrees with the linear response within {} % at Ai = 1 % of the film", [largest("0.01")]),
        ("and within {} % at 20 %", [largest("0.2")]),
        ("At 90 % it is still within {} %", [Bound(largest("0.9"))]),
        ("{} cases (4 D", [cell("harmonic/refit.csv", "points", group="all", variable="f_v")]),
    ]


def speeds():
    """Counted work, which no other job of the machine changes."""
    get = lambda work, method, column="counted", unit="WU": cell("speed/speed.csv", column, work=work, method=method, unit=unit)  # noqa: E731
    steady, step, ratio = "steady state, 257 x 257", "one time step, 257 x 257", "steady state, 1025 x 1025 over 257 x 257"
    memory = "memory, 1025 x 1025"
    return [
        ("a steady state takes {} counted work units, a linear response {} more, a march of waves {}.",
         [get(steady, "newton"), get("linear response, 257 x 257", "newton"), small_waves("march", cells="256")[0]]),
        ("| steady state, 257 x 257 | {} | {} |", [get(steady, "newton"), get(steady, "fas")]),
        ("| one time step, transverse waves of 0.5 a, 257 x 257 | {} | {}, V cycles |", [get(step, "newton"), get(step, "fas")]),
        ("| linear response to them | {} | |", [get("linear response, 257 x 257", "newton")]),
        ("(a march from rest, with its error estimate: {}) | {} | |",
         [small_waves("march", cells="256")[0], get("periodic state", "newton")]),
        ("against 257 x 257 | {} times, {} MiB | {} times, {} MiB |",
         [get(ratio, "newton", unit="times"), get(memory, "newton", "figure", "MiB"), get(ratio, "fas", unit="times"),
          get(memory, "fas", "figure", "MiB")]),
        ("1025 x 1025 nodes take {} times the work of 257 x 257 and {} times the time", [get(ratio, "auto", unit="times"), get(ratio, "auto", "figure", "times")]),
        ("its steady state {} besides, a march of the waves {} ", [get(steady, "newton"), small_waves("march", cells="256")[0]]),
    ]


def model(name, column):
    """A number of the models of errors and costs that plans use."""
    return cell("error-vs-time/models.csv", column, model=name)


def grid_errors():
    """The table of errors by the grid, and their models."""
    def error(cells, quantity, m, d, wave="0"):
        return 100*cell("error-vs-time/estimates.csv", "error", m=m, d=d, wavelength=wave, quantity=quantity, cells=cells, slip="1",
                        orientation="transverse" if wave != "0" else "none", lubricant_l="12.05")

    contacts = (("100", "1"), ("100", "0.12"), ("1000", "1"), ("1000", "0.12"))
    film = {n: [error(n, "central_film", *contact) for contact in contacts] for n in ("64", "128", "256", "512")}
    ratio = {n: [[error(n, "amplitude_ratio_fit", *contact, wave) for wave in ("0.5", "2")] for contact in contacts]
             for n in ("64", "128", "256")}
    return [
        ("the central film is {} % off on 128 x 128 cells, {} % on 256 x 256", [film["128"][0], film["256"][0]]),
        ("central film, 64 x 64 | {} % | {} % | not resolved | {} % | | 128 x 128 | {} % | {} % | not resolved | {} %",
         [film[n][i] for n in ("64", "128") for i in (0, 1, 3)]),
        ("| 256 x 256 | {} % | {} % | {} % | {} % | | 512 x 512 | {} % | {} % | {} % | {} % |", film["256"] + film["512"]),
        ("lambda = 0.5 a / 2 a, 64 x 64 | {} / {} % | below 0.1 / {} % | not resolved | {} / {} % |",
         [*ratio["64"][0], ratio["64"][1][1], *ratio["64"][3]]),
        ("| 128 x 128 | {} / {} % | below 0.1 / {} % | not resolved | {} / {} % |",
         [*ratio["128"][0], ratio["128"][1][1], *ratio["128"][3]]),
        ("| 256 x 256 | {} / {} % | below 0.1 / below 0.1 % | {} / {} % | {} / {} % |",
         [*ratio["256"][0], *ratio["256"][2], *ratio["256"][3]]),
        ("the error is about {} hX^2 gamma M of H(0,0) and {} hX^2", [model("film", "coefficient_1"), model("moving_ratio", "coefficient_1")]),
    ]


def estimates():
    """Accuracy of the models of errors, and of the error estimates of results."""
    def range_of(quantity):
        rows = [row for row in table("error-vs-time/estimates.csv")
                if row["quantity"] == quantity and row["status"] == "converged" and float(row["error"]) > 1e-3]
        found = [float(row["estimate_over_error"]) for row in rows if row["estimate_over_error"] != "nan"]
        return [min(found), max(found)]

    return [
        ("were within a factor {} in half of the runs, {} in the worst",
         [model("moving_ratio", "typical_factor"), model("moving_ratio", "largest_factor")]),
        ("Where errors are above 0.1 % these were {} to {} times the error of H(0,0), {} to {} times that of the smallest H and "
         "{} to {} times that of Ad/Ai", [*range_of("central_film"), *range_of("minimum_film"), *range_of("amplitude_ratio_fit")]),
    ]


def costs():
    """Models of the counted work of steady states and time steps."""
    cost = [[model(name, f"coefficient_{i}") for i in (1, 2, 3)] for name in ("steady_cost", "step_cost")]
    return [
        ("takes {} (cells/128)^{} (gamma M/100)^{} of them (within a factor {} in {} contacts and grids)",
         [*cost[0], model("steady_cost", "largest_factor"), model("steady_cost", "points")]),
        ("a time step {} (cells/128)^{} (within {} in {} runs)",
         [*cost[1][:2], model("step_cost", "largest_factor"), model("step_cost", "points")]),
    ]


def heavy_loads():
    """Work of both schemes for 1 %."""
    rows = table("heavy/work.csv")
    claims = []
    for contact in dict.fromkeys((row["load_parameter_m"], row["radius_ratio_d"]) for row in rows):
        m, d = contact
        works = [float(row[scheme]) for row in rows if (row["load_parameter_m"], row["radius_ratio_d"]) == contact
                 for scheme in ("averaged", "fitted")]
        claims.append((f"| {int(float(m)):,}, {d} | {{}}, {{}} | {{}}, {{}} | {{}}, {{}} |", works))
    smooth = {(float(row["load_parameter_m"]), row["radius_ratio_d"]): float(row["averaged"])/float(row["fitted"])
              for row in rows if float(row["wavelength_over_a"]) == 0}
    for row in table("heavy/refinement.csv"):
        contact = float(row["load_parameter_m"]), row["radius_ratio_d"]
        values = [float(value) for value in list(row.values())[2:]]
        values = [100*value if n in (0, 1, 2, 4, 6) else value for n, value in enumerate(values)]
        claims.append((f"| {int(contact[0]):,}, {contact[1]} | {{}} %, {{}} % | {{}} %, {{}} | {{}} %, {{}} | {{}} %, {{}} | {{}} | {{}} |",
                       [*values, smooth[contact]]))
    return claims


def peers():
    """Errors and times of public solvers, and of the book's program on its own contact."""
    def shown(rows):
        done = [row for row in rows if row["film"]]
        return [value for row in done for value in (100*float(row["error"]), float(row["seconds"]))]

    claims = []
    for solver in dict.fromkeys(row["solver"] for row in table("peers/peers.csv")):
        done = [row for row in table("peers/peers.csv") if row["solver"] == solver and row["film"]]
        claims.append((f"| {solver} |{' {} %, {} s |'*len(done)}", shown(done)))
    book = {(row["solver"], row["cells"]): row for row in table("peers/book.csv")}
    whole = "ehlwave, whole domain"
    for cells in ("256", "512", "1024", "2048"):
        rows = [book[solver, cells] for solver in ("book", "book, 4 relaxations", whole, f"{whole}, fitted", "ehlwave")]
        columns = "".join(" {} %, {} s |" if row["film"] else " stalled |" for row in rows)
        claims.append((f"| {cells} |{columns} {{}}, {{}} |", [*shown(rows), *(float(row["times"]) for row in rows[:2])]))
    return claims


MANUAL = "postprocess/manual/explanation"
CLAIMS = {"README.md": top_level, "postprocess/manual/case.md": one_contact, "postprocess/manual/measured_surfaces.md": postprocess, "postprocess/record/README.md": record,
          f"{MANUAL}/accuracy.md": grid_errors, f"{MANUAL}/estimates.md": estimates, f"{MANUAL}/work.md": lambda: [*speeds(), *costs()],
          f"{MANUAL}/atlas.md": atlas, f"{MANUAL}/atlas_making.md": atlas_files, f"{MANUAL}/atlas_elements.md": atlas_elements,
          f"{MANUAL}/roughness.md": roughness, f"{MANUAL}/paper.md": lambda: [*study(), *validation(), *better_formula(), *rolling()],
          f"{MANUAL}/slip.md": two_waves, f"{MANUAL}/fitted_scheme.md": heavy_loads,
          f"{MANUAL}/other_programs.md": peers}


def words(path):
    """The text of a README as a single line."""
    return re.sub(r"\s+", " ", (ROOT/path).read_text(encoding="utf-8"))


def found_in(text, sentence):
    """The numbers of a sentence as printed, or None."""
    pattern = f"({NUMBER})".join(re.escape(part) for part in sentence.split("{}"))
    found = re.search(pattern, text, re.IGNORECASE)
    return None if found is None else list(found.groups())


def agrees(printed, value):
    digits = len(printed.partition(".")[2].partition("e")[0])
    unit = 10.0**-digits
    if isinstance(value, Bound):
        return value.value <= float(printed) < value.value + unit
    return abs(float(printed) - value) <= 0.5*unit*(1 + 1e-6) + 1e-12


class Numbers(unittest.TestCase):
    def test_readmes_say_what_records_have(self):
        for path, claims in CLAIMS.items():
            text, count = words(path), 0
            for sentence, values in claims():
                with self.subTest(readme=path, sentence=sentence):
                    printed = found_in(text, sentence)
                    self.assertIsNotNone(printed, f"{path} has no such sentence: change this test with it")
                    self.assertEqual(len(printed), len(values))
                    off = [(one, value) for one, value in zip(printed, values, strict=True) if not agrees(one, value)]
                    self.assertEqual(off, [], f"{path}: printed, and what the record has")
                    count += len(values)
            report(f"{path}: {count} of {len(re.findall(NUMBER, text))} numbers compared")

    def test_what_the_test_calls_agreement(self):
        for printed, value, answer in (("0.28", 0.284, True), ("0.28", 0.286, False), ("23", 22.7, True), ("23", 22.4, False),
                                       ("4", Bound(3.7), True), ("4", Bound(4.01), False), ("4", Bound(2.9), False),
                                       ("nan", 1.0, False)):
            self.assertEqual(agrees(printed, value), answer, (printed, value))

    def test_programs_give_what_the_first_readme_says(self):
        text = words("README.md")
        with tempfile.TemporaryDirectory() as folder:
            march, response = (self.solved(folder, "isotropic", change) for change in ({}, {"'isotropic'": "'isotropic', response = 'harmonic'"}))
            printed = found_in(text, "{} counted work units in place of {}, a factor of {}.")
            for one, value in zip(printed, [response["counted_work_units"], march["counted_work_units"],
                                            march["counted_work_units"]/response["counted_work_units"]], strict=True):
                self.assertAlmostEqual(float(one)/value, 1, delta=0.05)
            printed = found_in(text, "of the film keep Ad/Ai = {} within {} % (harmonic fit)")
            values = [march["amplitude_ratio_fit"], 100*march["error_estimate"]]
            for one, value, tolerance in zip(printed, values, (6e-4, 0.06), strict=True):
                self.assertAlmostEqual(float(one), value, delta=tolerance)

    def test_programs_give_what_the_page_of_one_contact_says(self):
        text = words("postprocess/manual/case.md")
        with tempfile.TemporaryDirectory() as folder:
            eyring, newtonian = (self.solved(folder, "sliding", change) for change in (
                {}, {"'eyring'": "'newtonian'", "eyring_stress_pa = 5e6": ""}))
            printed = found_in(text, "| Ree-Eyring | {} within {} % | | Newtonian (`flow_law = 'newtonian'`, no stress) | {} |")
            values = [eyring["harmonic_ratio"], 100*eyring["error_estimate"], newtonian["harmonic_ratio"]]
            for one, value, tolerance in zip(printed, values, (6e-4, 0.06, 6e-4), strict=True):
                self.assertAlmostEqual(float(one), value, delta=tolerance)
            printed = found_in(text, "M = {}, L = {}, D = {}, S = {}, E' = {} GPa, tau0 = {} MPa")
            values = [eyring[f"{key}"] for key in ("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d", "slip_parameter")]
            for one, value in zip(printed, [*values, 226, 5], strict=True):
                self.assertTrue(agrees(one, value), (one, value))

    def test_edges_thin_films_as_the_page_of_one_contact_says(self):
        printed = found_in(words("postprocess/manual/case.md"), "thinner by | | --- | --- | --- | | {} | {} | {} % | | {} | {} | {} % | | {} | {} | {} % |")
        for first in range(0, len(printed), 3):
            m, d, thinner = map(float, printed[first:first + 3])
            films = [solve(m=m, d=d, grid={"cells_x": 128, "cells_y": 128, "edges": edges})["central_film"]
                     for edges in ("truncated", "flooded")]
            self.assertAlmostEqual(100*(1 - films[0]/films[1]), thinner, delta=0.06)

    def solved(self, folder, name, change):
        text = (ROOT/f"inputs/{name}.nml").read_text(encoding="utf-8")
        for old, new in change.items():
            self.assertIn(old, text)
            text = text.replace(old, new)
        Path(folder, "case.nml").write_text(text)
        outcome = run("case", "case.nml", "--json", "--quiet", folder=folder)
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        return last_line(outcome)


if __name__ == "__main__":
    unittest.main()
