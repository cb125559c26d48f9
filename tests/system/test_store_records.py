"""A store is the set of its records: their order, their logs, repetition and lost records beside them change nothing.
"""

import os
import random
import shutil
import subprocess
import tempfile
import unittest
import zlib
from pathlib import Path

from ehlwave_program import EIGHT_CASES, IS_LONG, environment, namelist, run
from hdf5_reading import read
from store_reading import finished, records
from torture import CIRCUMSTANCES

VARIANTS = 40 if IS_LONG else 4


def line_of(record):
    text = record.encode()
    return f"{zlib.crc32(text):08x} {len(text)} ".encode() + text + b"\n"


def is_case(record):
    """Whether it belongs to a single case, without later records that depend on it."""
    return record.startswith(("case ", "start ", "stop "))


class StoreRecords(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = Path(place.name)
        for loads, ranks in (([20, 25], 2), (EIGHT_CASES["sweep"]["load_parameter_m"], 0)):  # two runs, the second on two ranks
            sweep = {**EIGHT_CASES["sweep"], "load_parameter_m": loads}
            groups = {**EIGHT_CASES, "sweep": sweep, "conditions": {"slip_parameter": 1}}
            (cls.folder/"sweep.nml").write_text(namelist(groups))
            outcome = run("sweep", "sweep.nml", ranks=ranks, folder=cls.folder)
            assert outcome.returncode == 0, outcome.stdout + outcome.stderr
        cls.logs = {path.name: records(path) for path in sorted((cls.folder/"results.store"/"records").iterdir())}
        cls.cases = finished(cls.folder/"results.store")
        cls.columns = read(cls.folder/"results.h5")[1]
        assert len(cls.logs) == 3 and len(cls.cases) == 8

    def setUp(self):
        self.random = random.Random(self.id())

    def write(self, logs):
        """A copy of the store with other logs; its folder."""
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        copy = Path(place.name)
        shutil.copytree(self.folder, copy, dirs_exist_ok=True)
        (copy/"results.h5").unlink()
        shutil.rmtree(copy/"results.store"/"records")
        (copy/"results.store"/"records").mkdir()
        for name, lines in logs.items():
            (copy/"results.store"/"records"/name).write_bytes(b"".join(map(line_of, lines)))
        return copy

    def check(self, logs, lost=()):
        """The store has all cases but those lost, and the next run makes the same results of it."""
        copy = self.write(logs)
        outcome = subprocess.run([os.environ["EHLWAVE_SWEEP"], "sweep.nml"], cwd=copy, env=environment(0),
                                 capture_output=True, text=True, check=False)
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        self.assertIn(f"{len(self.cases) - len(lost)} of {len(self.cases)} cases found in the store", outcome.stdout)
        columns = read(copy/"results.h5")[1]
        self.assertEqual(set(columns), set(self.columns))
        kept = [identity not in lost for identity in columns["case_id"]]
        for name, values in columns.items():
            for is_kept, value, expected in zip(kept, values, self.columns[name], strict=True):
                if is_kept or name not in CIRCUMSTANCES:
                    self.assertEqual(repr(value), repr(expected), name)

    def mixed(self, lines):
        """Return the common records first, then the records of cases in another order."""
        own = [record for record in lines if is_case(record)]
        self.random.shuffle(own)
        return [record for record in lines if not is_case(record)] + own

    def test_order(self):
        """Within a log; which rank wrote which log of a run."""
        names = {name: name for name in self.logs}
        for _ in range(VARIANTS):
            first, second = (name for name in self.logs if name.startswith("000001"))
            if self.random.random() < 0.5:
                names[first], names[second] = second, first
            self.check({names[name]: self.mixed(lines) for name, lines in self.logs.items()})

    def test_repetition(self):
        """Repeat records within a log, and whole logs, also as logs of an earlier run."""
        for _ in range(VARIANTS):
            logs = {}
            for name, lines in self.logs.items():
                twice = self.mixed(lines) + self.random.choices([record for record in lines if is_case(record)], k=5)
                logs[name] = [record for record in twice for _ in range(self.random.choice([1, 1, 2]))]
                copy = f"{self.random.randint(1, int(name[:6])):06d}-{self.random.randint(10, 99):06d}.log"
                logs[copy] = self.mixed(lines)
            self.check(logs)

    def test_loss(self):
        """Lose records and whole logs: the rest is unchanged, and lost cases are computed again."""
        for _ in range(VARIANTS):
            logs = {name: [record for record in lines if not (record.startswith("case ") and self.random.random() < 0.3)]
                    for name, lines in self.logs.items()}
            if self.random.random() < 0.3:
                logs.pop(self.random.choice(list(logs)))
            left = finished(self.write(logs)/"results.store")
            self.check(logs, set(self.cases) - set(left))

    def test_the_last_run_counts(self):
        """Whatever an earlier record of the same case contains, in a log that is read before or after."""
        (last,) = (name for name in self.logs if name.startswith("000002"))
        other = [record.replace('["converged"', '["stalled"', 1).replace('["unresolved"', '["stalled"', 1) for record in self.logs[last]]
        self.assertNotEqual(other, self.logs[last])
        self.check({**self.logs, "000001-000077.log": other})


if __name__ == "__main__":
    unittest.main()
