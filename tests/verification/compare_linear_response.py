"""Small-amplitude response against the linearised equations, row by row.

    compare_linear_response.py --all [--finest 129] [--harmonic]

runs every row of reference/linear_response.csv and prints the deviations; EHLWAVE_CASE names the program. With
--harmonic the program's own linear response is compared in place of a march in time. Without --all only the rows of
the tests in this folder are run.
"""

import argparse

from ehlwave_program import solve
from reference_values import case_groups, case_name, rows

AMPLITUDE = 0.01
# The default step tolerance belongs to Ai = 20 % of the film. At 1 % it leaves 0.5 % of error, this 0.05 %.
STEP_TOLERANCE = 5e-6
# The default measures over the first period after T = 3.5, when long waves are not periodic yet (2 % for lambda/a = 2).
PERIODS_TO_SETTLE = 3
RELATIVE = 2e-3

# A fast case of each orientation for each condition, resolved wherever 129 points resolve it.
CHOSEN = {
    (1, "transverse"): [(65, 0.7), (129, 0.3)], (1, "isotropic"): [(65, 1.2), (129, 0.4)],
    (1, "longitudinal"): [(65, 0.7), (129, 0.3)],
    (0.35, "transverse"): [(65, 1.2), (129, 0.4)], (0.35, "isotropic"): [(65, 2), (129, 0.7)],
    (0.35, "longitudinal"): [(65, 1.5), (129, 0.7)],
    (0.12, "transverse"): [(65, 0.7), (129, 1.2)], (0.12, "isotropic"): [(65, 2), (129, 1.5)],
    (0.12, "longitudinal"): [(65, 2), (129, 1.2)],
    (0.04, "transverse"): [(65, 2), (129, 0.7)], (0.04, "isotropic"): [(129, 2)],
    (0.04, "longitudinal"): [(129, 2)],
}


def chosen_rows():
    """Rows of the table above."""
    return [row for row in rows("linear_response.csv")
            if (row["points"], row["wavelength_over_a"]) in CHOSEN[row["radius_ratio_d"], row["orientation"]]]


def respond(row):
    """Result of the nonlinear solver at a small amplitude."""
    wavelength = row["wavelength_over_a"]
    moving = {}
    if row["orientation"] != "longitudinal":
        moving = {"dynamics": {"end_time": 3.5 + (PERIODS_TO_SETTLE + 1)*wavelength}}
    return solve(**case_groups(row), **moving, solver={"step_tolerance": STEP_TOLERANCE, "tolerance": 1e-7},
                 waviness={"orientation": row["orientation"], "wavelength_over_a": wavelength,
                           "amplitude_over_film": AMPLITUDE})


def respond_linearly(row):
    """Linear response of the program."""
    return solve(**case_groups(row), solver={"tolerance": 1e-7},
                 waviness={"orientation": row["orientation"], "wavelength_over_a": row["wavelength_over_a"],
                           "response": "harmonic"})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true", help="every row of the file")
    parser.add_argument("--harmonic", action="store_true", help="the linear response, not the march in time")
    parser.add_argument("--finest", type=int, default=257, help="leave out grids with more points")
    arguments = parser.parse_args()
    table = rows("linear_response.csv") if arguments.all else chosen_rows()
    worst = {}
    for row in (row for row in table if row["points"] <= arguments.finest):
        try:
            result = respond_linearly(row) if arguments.harmonic else respond(row)
        except AssertionError as problem:
            print(f"{case_name(row)}: FAILED: {problem}", flush=True)
            worst["failed"] = worst.get("failed", 0) + 1
            continue
        ratio = result["harmonic_ratio" if arguments.harmonic else "amplitude_ratio_fit"]
        deviation = ratio/row["amplitude_ratio"] - 1
        key = (row["orientation"], result["status"])
        if abs(deviation) > abs(worst.get(key, (0,))[0]):
            worst[key] = (deviation, case_name(row))
        print(f"{case_name(row)}: {ratio:.6f} against {row['amplitude_ratio']:.6f}, "
              f"{100*deviation:+.3f} %, {result['status']}, {result['seconds']:.1f} s", flush=True)
    for key, value in sorted(worst.items(), key=str):
        print("worst", key, value, flush=True)


if __name__ == "__main__":
    main()
