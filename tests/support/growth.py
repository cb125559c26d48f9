"""Whether a process that works on many cases grows.   python3 growth.py [--responses N] [--marches N] [--folder DIR]

Linear responses, then marches, on small grids and at conditions of their own, by two ranks: resident memory and open files of the
second while the last 90 % of its cases are computed, against their values at 10 %. The first also holds the table and
the results. """

import argparse
import os
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from studies.programs import MPI_ENVIRONMENT, mpi_command

LARGEST_GROWTH_KIB = 1024
INPUT = """&sweep case_file = 'cases.csv', unresolved = 'run', output = 'results.h5' /
&conditions radius_ratio_d = 1 /
&grid cells_x = 32, cells_y = 32 /
&waviness response = '{response}' /
&solver error_estimate = 'model' /
"""


def resident(pid):
    """Resident memory of a process, KiB, and the number of its open files."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return int(next(line for line in lines if line.startswith("VmRSS:")).split()[1]), len(list(Path(f"/proc/{pid}/fd").iterdir()))


def process_of(log):
    """Number of the process that writes a log."""
    return int(log.read_bytes()[:4096].split(b"]],[")[1].split(b",")[4])


def samples_of(process, log):
    """Samples (size of log, KiB, files) of the process that writes a log, until its parent ends."""
    samples = []
    while process.poll() is None:
        time.sleep(0.05)
        try:
            samples.append((log.stat().st_size, *resident(process_of(log))))
        except (OSError, IndexError, StopIteration):   # it has not begun, or has ended
            pass
    return samples


def growth(samples):
    """Growth of samples (size of log, KiB, files) after 10 % of the log: KiB and files at first, and their growth."""
    late = [sample for sample in samples if 0.1*samples[-1][0] < sample[0]]
    assert len(late) > 5, "too few samples"
    last = late[len(late)//2:]   # files that are open for a moment do not stay so
    return late[0][1], late[0][2], max(one[1] for one in late) - late[0][1], min(one[2] for one in last) - late[0][2]


def watch(response, cases, folder):
    """Run a sweep of random cases on two ranks; samples of the second while it computes."""
    chance = random.Random(cases)
    rows = [f"{chance.uniform(10, 100)},{chance.uniform(2, 8)},{chance.choice(['transverse', 'isotropic', 'longitudinal'])},"
            f"{chance.uniform(1, 3)}" for _ in range(cases)]
    Path(folder, "cases.csv").write_text("\n".join(["load_parameter_m,lubricant_parameter_l,orientation,wavelength_over_a", *rows]))
    Path(folder, "sweep.nml").write_text(INPUT.format(response=response))
    log = Path(folder, "results.store", "records", "000001-000001.log")
    with Path(folder, "run.log").open("w") as file:
        process = subprocess.Popen([*mpi_command(2), os.environ["EHLWAVE_SWEEP"], "sweep.nml"], cwd=folder, stdout=file, stderr=file,
                                   env={**os.environ, **MPI_ENVIRONMENT})
        samples = samples_of(process, log)
    if process.returncode not in (0, 1):
        raise SystemExit(Path(folder, "run.log").read_text()[-2000:])
    return [sample for sample in samples if sample[0] < samples[-1][0]]   # then it writes the results


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--responses", type=int, default=100000)
    parser.add_argument("--marches", type=int, default=2000)
    parser.add_argument("--folder", help="where the sweeps run; default: the temporary folder of the system")
    options = parser.parse_args()
    failed = False
    for response, cases in [("harmonic", options.responses), ("transient", options.marches)]:
        if not cases:
            continue
        with tempfile.TemporaryDirectory(dir=options.folder) as place:
            memory, files, more_memory, more_files = growth(watch(response, cases, place))
        print(f"{cases} {response} cases: {memory} KiB resident and {files} files open after 10 %, at most {more_memory} KiB and "
              f"{more_files} files more later", flush=True)
        failed = failed or more_memory >= LARGEST_GROWTH_KIB or more_files > 0
    sys.exit(1 if failed else 0)
