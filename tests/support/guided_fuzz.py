"""Inputs that reach new branches of the readers, found by AFL++.   python3 guided_fuzz.py [--seconds S] [--keep DIR] [TARGET...]

The targets of fuzz.py that are Fortran, with the same corpora, in the program that EHLWAVE_FUZZ_TARGET names, built so that AFL++
sees its branches. Inputs that end the process, hang for 10 s or need more than 1 GiB stay in DIR/TARGET/default/crashes
and hangs. """

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from fuzz import LARGEST_MIB, LONGEST_S, PLACE, TARGETS, Target, with_checksums

GUIDED = tuple(name for name in TARGETS if name != "trace")
ENVIRONMENT = {"AFL_NO_UI": "1", "AFL_SKIP_CPUFREQ": "1", "AFL_NO_AFFINITY": "1", "AFL_I_DONT_CARE_ABOUT_MISSING_CRASHES": "1",
               "AFL_CRASH_EXITCODE": "2", "AFL_FORKSRV_INIT_TMOUT": "20000"}   # 2: an error of the Fortran library


def init(_seed):
    """Begin to be a module of afl-fuzz."""


def deinit():
    """End that."""


def post_process(data):
    """Every other log with good checksums."""
    return data if len(data) % 2 else bytearray(with_checksums(data))


def guided_fuzz(name, seconds, keep):
    """Fuzz a target. Returns the statistics of afl-fuzz."""
    with tempfile.TemporaryDirectory(dir=PLACE) as folder:
        target = Target(name, folder, seed=0)
        begin = Path(folder, "corpus")
        begin.mkdir()
        for number, data in enumerate(target.mutator.corpus):
            (begin/str(number)).write_bytes(data)
        variables = {"AFL_PYTHON_MODULE": "guided_fuzz", "PYTHONPATH": str(Path(__file__).parent)} if target.recode else {}
        subprocess.run(["afl-fuzz", "-i", begin, "-o", keep/name, "-f", target.path, "-t", str(int(1000*LONGEST_S)),
                        "-m", str(LARGEST_MIB), "-V", str(seconds), "--", os.environ["EHLWAVE_FUZZ_TARGET"], *target.words], cwd=folder,
                       env={**os.environ, **ENVIRONMENT, **variables}, stdout=(keep/f"{name}.log").open("w"), check=True)
    lines = (keep/name/"default"/"fuzzer_stats").read_text().splitlines()
    return {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("targets", nargs="*", metavar="TARGET", help="one of " + ", ".join(GUIDED) + "; default: all")
    parser.add_argument("--seconds", type=int, default=600, help="of each target")
    parser.add_argument("--keep", type=Path, default=Path("guided-fuzz"), help="folder for logs and what was found")
    options = parser.parse_args()
    if set(options.targets) - set(GUIDED):
        parser.error("unknown target")
    options.keep.mkdir(exist_ok=True)
    found = 0
    for name in options.targets or GUIDED:
        stats = guided_fuzz(name, options.seconds, options.keep.resolve())
        print(f"  {name}: {stats['execs_done']} inputs, {stats['edges_found']} branches, {stats['corpus_found']} inputs reached new ones, "
              f"{stats['saved_crashes']} crashes, {stats['saved_hangs']} hangs", flush=True)
        found += int(stats["saved_crashes"]) + int(stats["saved_hangs"])
    sys.exit(1 if found else 0)
