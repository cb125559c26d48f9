"""Runs of a sweep in which a system call fails; needs EHLWAVE_SWEEP and EHLWAVE_FAULTS, the preloaded library.

Each starts from the same store, in which half of the cases are done. The run may end with any status of its own, in
time; the store keeps its content; reported work is right; and the next run, undisturbed, ends with the bits of an
undisturbed sweep. """

import errno
import os
import random
import shutil
import subprocess
from pathlib import Path

from ehlwave_program import HANGS_S, MPI_ENVIRONMENT, namelist
from hdf5_reading import read
from store_reading import finished

OWN_STATUS = (0, 1, 2, 3, 85)
FINISHED = (0, 1)
ERRORS = {"open": [errno.EIO, errno.EACCES, errno.ENOSPC, errno.EMFILE], "read": [errno.EIO, 0], "fsync": [errno.EIO, 0],
          "write": [errno.EIO, errno.ENOSPC, errno.EINTR, 0], "rename": [errno.EIO, errno.EACCES, errno.ENOSPC],
          "unlink": [errno.EIO, errno.EACCES], "mkdir": [errno.ENOSPC, errno.EACCES]}
# a part of it is long enough for a checkpoint, another has fields
HALF = {"sweep": {"load_parameter_m": [100, 120], "lubricant_parameter_l": 12.05, "radius_ratio_d": 1, "orientation": "transverse",
                  "wavelength_over_a": [1, 2], "output": "results.h5", "checkpoint_seconds": 0},
        "grid": {"cells_x": 32, "cells_y": 32}, "output": {"fields": True}}
WHOLE = {**HALF, "sweep": {**HALF["sweep"], "load_parameter_m": [100, 120, 140, 160]}}


class Faults:
    """Faults in turn in a folder."""

    variables = {}   # variables of the environment, besides MPI's

    def __init__(self, folder, seed, circumstances):
        self.folder, self.random, self.circumstances = Path(folder), random.Random(seed), circumstances
        self.counts = {"faults": 0, "reached": 0, "lost": 0, "doubled": 0, "different": 0, "hung": 0, "crashed": 0}
        self.messages = []
        half, whole = self.folder/"half", self.folder/"whole"
        for place, groups in [(half, HALF), (whole, WHOLE)]:
            place.mkdir()
            (place/"sweep.nml").write_text(namelist(groups))
            if self.run(place)[0] not in FINISHED:
                raise AssertionError("a run without faults fails")
        (half/"sweep.nml").write_text(namelist(WHOLE))
        self.before = finished(half/"results.store")
        self.expected = read(whole/"results.h5")[1]
        self.calls = {call: self.count_calls(call) for call in ERRORS}

    def run(self, place, fault=None, count=None):
        """Status and output of a run; None where it hangs."""
        environment = {**os.environ, **MPI_ENVIRONMENT, **self.variables}
        if fault:
            environment |= {"LD_PRELOAD": os.environ["EHLWAVE_FAULTS"], "EHLWAVE_FAULT": fault}
            if count:
                environment["EHLWAVE_FAULT_COUNT"] = str(count)
        try:
            outcome = subprocess.run([os.environ["EHLWAVE_SWEEP"], "sweep.nml"], cwd=place, env=environment, capture_output=True,
                                     text=True, stdin=subprocess.DEVNULL, timeout=HANGS_S, check=False)
        except subprocess.TimeoutExpired:
            return None, ""
        return outcome.returncode, outcome.stdout + outcome.stderr

    def attempt(self, fault, count=None):
        """A run with a fault, from half of the cases on; where it ran, its status and output."""
        place = self.folder/"attempt"
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(self.folder/"half", place)
        return place, *self.run(place, fault, count)

    def count_calls(self, call):
        """How many calls of a kind an undisturbed run makes."""
        count = self.folder/f"count-{call}"
        self.attempt(f"{call} 1000000 5 1 results", count)
        return int(count.read_text().split()[0])

    def disturb(self):
        """A fault of a random call, with a random error, once or for a while."""
        call = self.random.choices(list(ERRORS), [min(1 + self.calls[one], 12) for one in ERRORS])[0]
        number = self.random.randint(1, max(1, self.calls[call]))
        times = self.random.choice([1, 1, 1, 3, 1000000])
        error = self.random.choice(ERRORS[call])
        if times > 3 and error in (errno.EINTR, 0):
            times = 3   # a system that does so for ever is none
        fault = f"{call} {number} {error} {times} results"
        place, status, text = self.attempt(fault)
        self.counts["faults"] += 1
        self.judge(fault, place, status, text)
        return fault, status

    def fail(self, kind, fault, what):
        self.counts[kind] += 1
        self.messages.append(f"{kind}: {fault}: {what}")

    def judge(self, fault, place, status, text):
        """Whether the run and the next behaved correctly."""
        if status is None:
            return self.fail("hung", fault, "")
        if status not in OWN_STATUS:
            return self.fail("crashed", fault, f"{status}: {text[-400:]}")
        self.counts["reached"] += status not in FINISHED
        held = finished(place/"results.store")
        for identity, row in self.before.items():
            if held.get(identity) != row:
                return self.fail("lost", fault, identity)
        if status in FINISHED and self.differs(place):
            return self.fail("different", fault, f"{status}: {self.differs(place)}")
        again, text = self.run(place)
        if again not in FINISHED:
            return self.fail("lost", fault, f"the next run ends with {again}: {text[-400:]}")
        if f"{len(held)} of {len(self.expected['case_id'])} cases found in the store" not in text:
            self.fail("doubled", fault, f"{len(held)} cases were there: {text[-400:]}")
        if self.differs(place):
            self.fail("different", fault, self.differs(place))
        return None

    def differs(self, place):
        """Return the difference from a run without faults, else None."""
        data = read(place/"results.h5")[1]
        if set(data) != set(self.expected):
            return f"columns {set(data) ^ set(self.expected)}"
        for name in set(data) - self.circumstances:
            same = data[name] == self.expected[name] if isinstance(data[name], list) \
                else data[name].tobytes() == self.expected[name].tobytes()
            if not same:
                return name
        fields = sorted(path.name for path in (place/"results.store"/"fields").glob("*.h5"))
        if fields != sorted(f"{identity}.h5" for identity in self.expected["case_id"]):
            return "fields"
        return None
