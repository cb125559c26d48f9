"""Run the programs of the build from a test.

The paths come from the environment, which CTest sets: EHLWAVE_CASE, EHLWAVE_SWEEP, EHLWAVE_MPIEXEC.
"""

import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SKIPPED = 77

# Open MPI as root in a container: no vader copies, loopback only.
MPI_ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
}
MPI_ARGUMENTS = ["--oversubscribe", "--mca", "oob_tcp_if_include", "lo", "--mca", "btl_tcp_if_include", "lo"]


def namelist(groups):
    """Text of an input file from {group: {key: value}}; lists become comma-separated values."""

    def written(value):
        if isinstance(value, bool):
            return ".true." if value else ".false."
        if isinstance(value, str):
            return "'" + value + "'"
        if isinstance(value, (list, tuple)):
            return ", ".join(written(one) for one in value)
        return repr(value)

    lines = []
    for group, keys in groups.items():
        lines += [f"&{group}", *(f"  {key} = {written(value)}" for key, value in keys.items()), "/"]
    return "\n".join(lines) + "\n"


def run(program, *arguments, ranks=0, folder=None):
    """Run ehlwave-case or ehlwave-sweep; with `ranks` under mpiexec."""
    command = [os.environ["EHLWAVE_" + program.upper()], *map(str, arguments)]
    environment = {**os.environ, **MPI_ENVIRONMENT}
    if ranks:
        mpiexec = os.environ.get("EHLWAVE_MPIEXEC") or "mpiexec"
        command = [mpiexec, "-n", str(ranks), *MPI_ARGUMENTS, *command]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def last_line(outcome):
    """The JSON object on the last line of the output."""
    return json.loads(outcome.stdout.rstrip("\n").split("\n")[-1])


def solve(**groups):
    """Result of one case that has to converge; the first group may be given as m, l, d."""
    if "m" in groups:
        m, l, d = groups.pop("m"), groups.pop("l", 12.05), groups.pop("d")
        groups["conditions"] = {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d,
                                **groups.get("conditions", {})}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "case.nml")
        path.write_text(namelist(groups))
        outcome = run("case", path, "--json", "--quiet")
    if outcome.returncode != 0:
        raise AssertionError(f"exit status {outcome.returncode} for\n{namelist(groups)}\n{outcome.stdout}{outcome.stderr}")
    return last_line(outcome)


class TestCase(unittest.TestCase):
    """Adds checks on numbers that NaN cannot pass."""

    def check_close(self, value, expected, relative, what):
        """|value/expected - 1| <= relative; returns the deviation."""
        self.assertTrue(value is not None and math.isfinite(value), f"{what}: got {value}")
        deviation = abs(value/expected - 1)
        self.assertLessEqual(deviation, relative, f"{what}: {value} against {expected}")
        return deviation

    def check_order(self, values, smallest, what):
        """Observed order of three values on grids of n, 2n, 4n cells; returns it."""
        order = math.log2(abs(values[1] - values[0])/abs(values[2] - values[1]))
        self.assertGreaterEqual(order, smallest, f"{what}: order {order:.3f} of {values}")
        return order


def report(text):
    """A measured number for the log of the test."""
    print("  measured: " + text, flush=True)
