"""Mutated inputs for everything that reads a file.   python3 fuzz.py [--inputs N] [--seconds S] [--seed N] [TARGET...]

Targets: case, sweep, table (CSV of cases), record (a log of a store), surface (HDF5) in the program of fuzz_target.f90, named
by EHLWAVE_FUZZ_TARGET; trace (input of `ehlwave surface`) in Python. Inputs are mutations of a corpus: the samples
below and the inputs of the repository. For any input the process must go on, answer within 10 s and stay below 1 GiB.
Inputs that break this are kept in the present folder as fuzz-TARGET-NUMBER. """

import argparse
import os
import random
import select
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LONGEST_S = float(os.environ.get("EHLWAVE_LONGEST", "10"))   # processor time, whatever else the machine does
HANGS_S = 60*LONGEST_S   # by the clock
LARGEST_MIB = int(os.environ.get("EHLWAVE_LARGEST_MIB", "1024"))
FRESH = 5000   # inputs of a process: HDF5 keeps something of every damaged file, and takes longer over each
PLACE = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None   # place of the inputs
TARGETS = ("case", "sweep", "table", "record", "surface", "trace")

TOKENS = [b"&", b"/", b"=", b",", b"'", b'"', b"!", b"(", b"*", b"\n", b"\r", b"\0", b" ", b"\t", b"\x1b", b"\xff", b"\xef\xbb\xbf",
          b"nan", b"inf", b"1e308", b"1e-320", b"1d400", b"-0", b"0", b"99999999999999999999", b"2147483648", b"-1", b"1.5.2", b"1e",
          b".true.", b"3*", b"100000*1", b"99999*", b"[", b"]", b"{", b"}", b"\\", b"\\u00", b"\\\"", b"null", b"true", b"#",
          b"case ", b"run ", b"input ", b"columns ", b"start ", b"stop ", b"[[", b"]]"]
TABLE = b"""load_parameter_m, radius_ratio_d, orientation, f_v, cells_x
100, 1, transverse, 3, 64
# a comment
200, 0.35, Isotropic, 3, 64

200, 0.35, longitudinal, 12, 32.0
"""
SWEEP = b"""&sweep
  load_parameter_m = 100, 200, 3*300
  lubricant_parameter_l = 12.05, radius_ratio_d = 1, 0.5
  orientation = 'transverse', 'isotropic', wavelength_over_a = 0.5, 1
  output = 'x.h5', unresolved = 'run', largest_case_seconds = 10 /
&grid cells_x = 32, cells_y = 32 /
&solver method = 'fas', cycle = 'w' /
"""
TABLE_SWEEP = "&sweep case_file = 'cases.csv' /\n&conditions lubricant_parameter_l = 12.05 /\n&grid cells_y = 32 /\n"


class Mutator:
    """Changes of a text: bytes, tokens, pieces moved, doubled, repeated, lost, mixed with another."""

    def __init__(self, corpus, seed):
        self.corpus, self.random = corpus, random.Random(seed)

    def next(self):
        """A further input."""
        data = bytearray(self.random.choice(self.corpus))
        for _ in range(min(12, 1 + int(self.random.expovariate(0.4)))):
            self.mutate(data)
        return bytes(data[:2**20])

    def mutate(self, data):
        """Change a text in a random way."""
        chance = self.random
        at = chance.randrange(len(data) + 1)
        length = min(len(data) - at, int(chance.expovariate(1/8)) + 1)
        kind = chance.randrange(10)
        if kind == 0 and data:
            data[min(at, len(data) - 1)] ^= 1 << chance.randrange(8)
        elif kind == 1 and data:
            data[min(at, len(data) - 1)] = chance.randrange(256)
        elif kind == 2:
            data[at:at] = chance.choice(TOKENS)
        elif kind == 3:
            data[at:at + length] = chance.choice(TOKENS)
        elif kind == 4:
            del data[at:at + length]
        elif kind == 5:
            data[at:at] = data[at:at + length]*chance.choice([1, 2, 10, 300])
        elif kind == 6:
            other = chance.choice(self.corpus)
            begin = chance.randrange(len(other) + 1)
            data[at:at] = other[begin:begin + chance.choice([4, 40, 400])]
        elif kind == 7:
            del data[at:]
        elif kind == 8:
            begin = chance.randrange(len(data) + 1)
            piece = data[begin:begin + length]
            del data[begin:begin + length]
            data[at:at] = piece
        else:   # a number changes
            digits = [i for i, byte in enumerate(data) if 48 <= byte <= 57]
            if digits:
                data[chance.choice(digits)] = 48 + chance.randrange(10)


def record_line(text):
    """A line of a log."""
    import zlib
    return f"{zlib.crc32(text):08x} {len(text)} ".encode() + text + b"\n"


def with_checksums(data):
    """A log with good checksums: otherwise nothing but the checksum is tested."""
    lines = [bytes(line).split(b" ", 2) for line in data.split(b"\n")]
    return b"".join(record_line(parts[2]) for parts in lines if len(parts) == 3)


class Target:
    """A reader and the file that it reads."""

    def __init__(self, name, folder, seed):
        self.name, self.folder = name, Path(folder)
        self.process = None
        self.kind, self.path, corpus = getattr(self, "prepare_" + name)()
        self.words = self.kind.split() if " " in self.kind else [self.kind, self.path]   # words passed to the program
        self.mutator = Mutator(corpus, seed)
        self.recode = name == "record"
        self.answers = {}

    def prepare_case(self):
        corpus = [path.read_bytes() for path in sorted((ROOT/"inputs").glob("*.nml")) if b"&sweep" not in path.read_bytes()]
        return "case", "case.nml", corpus

    def prepare_sweep(self):
        few = SWEEP.replace(b"'run'", b"'skip'").replace(b"32", b"256")
        return "sweep", "sweep.nml", [SWEEP, few, SWEEP.replace(b"\n", b"\r\n")]

    def prepare_table(self):
        (self.folder/"table.nml").write_text(TABLE_SWEEP)
        return "sweep table.nml", "cases.csv", [TABLE, TABLE.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + TABLE]

    def prepare_record(self):
        old = ROOT/"tests"/"system"/"store_of_0.1.0"/"results.store"
        (self.folder/"s.store"/"records").mkdir(parents=True)
        shutil.copy(old/"store", self.folder/"s.store"/"store")
        corpus = [path.read_bytes() for path in sorted((old/"records").iterdir())]
        return "store s.store", "s.store/records/000001-000000.log", corpus

    def prepare_surface(self, rows=3, columns=5):
        import h5py
        corpus = []
        for options in [{}, {"chunks": (2, 3), "compression": "gzip"}, {"dtype": "f4"}, {"dtype": "i2"}]:
            with h5py.File(self.folder/"s.h5", "w") as file:
                file.create_dataset("height", data=[[i % 3 for i in range(columns)]]*rows, **options)
                file["x"], file["y"] = [1.0*i for i in range(columns)], [2.0*i for i in range(rows)]
            corpus.append((self.folder/"s.h5").read_bytes())
        return "surface", "s.h5", corpus

    def make(self):
        """The next input, in its file."""
        data = self.mutator.next()
        if self.recode and self.mutator.random.random() < 0.7:
            data = with_checksums(data)
        path = self.folder/self.path
        path.write_bytes(data)
        return data

    def start(self):
        self.process = subprocess.Popen([os.environ["EHLWAVE_FUZZ_TARGET"]], cwd=self.folder, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=(self.folder/"errors").open("wb"))

    def visit(self):
        """Have the present input read. Returns the failure, else None."""
        if self.process is None:
            self.start()
        begin = self.cpu()
        self.process.stdin.write(" ".join(self.words).encode() + b"\n")
        self.process.stdin.flush()
        ready, _, _ = select.select([self.process.stdout], [], [], HANGS_S)
        answer = self.process.stdout.readline() if ready else b""
        if not answer:
            self.process.kill()
            status = self.process.wait()
            self.process = None
            what = "hangs" if not ready else f"ends with {status}"
            return f"{what}: {(self.folder/'errors').read_text(errors='replace')[-600:]}"
        word = answer.split(b" ")[0].decode(errors="replace")
        word = word if word == "refused" else "read"
        self.answers[word] = self.answers.get(word, 0) + 1
        seconds, mib = self.cpu() - begin, self.memory()
        if seconds > LONGEST_S:
            return f"takes {seconds:.1f} s"
        if mib > LARGEST_MIB:
            self.stop()
            return f"takes {mib:.0f} MiB"
        return None

    def cpu(self):
        """Processor time of the reader so far, s."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12]))/os.sysconf("SC_CLK_TCK")

    def memory(self):
        """Largest memory of the reader so far, MiB."""
        for line in Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1])/1024
        return 0

    def stop(self):
        if self.process is not None:
            self.process.stdin.close()
            self.process.wait(timeout=60)
            self.process = None


class Traces(Target):
    """Readers of the Python package; they may raise SurfaceError only."""

    def prepare_trace(self):
        import io

        import numpy
        heights = numpy.sin(numpy.arange(90.0)).reshape(9, 10)
        corpus = [b"x_um,z_nm\n" + b"".join(b"%d,%d\n" % (i, i % 3) for i in range(12)),
                  b"# a comment\n" + b"".join(b"%d,5;%.2f\n" % (i, i/7) for i in range(12)).replace(b".", b","),
                  b"".join(b" ".join(b"%.3f" % one for one in row) + b"\n" for row in heights), b"1\n2\n3.5\n4e0\n"*4]
        for save in [lambda file: numpy.save(file, heights), lambda file: numpy.savez(file, height=heights, x=numpy.arange(10.0)),
                     lambda file: numpy.savez_compressed(file, height=heights, y=numpy.arange(9.0))]:
            file = io.BytesIO()
            save(file)
            corpus.append(file.getvalue())
        _, _, surfaces = self.prepare_surface(9, 10)
        return "trace", "", corpus + surfaces

    def make(self):
        data = self.mutator.next()
        suffix = ".npz" if data[:2] == b"PK" else ".npy" if data[:6] == b"\x93NUMPY" else ".h5" if data[:4] == b"\x89HDF" else ".csv"
        if self.mutator.random.random() < 0.05:
            suffix = self.mutator.random.choice([".npz", ".npy", ".h5", ".txt"])
        self.path = "trace" + suffix
        (self.folder/self.path).write_bytes(data)
        return data

    def visit(self):
        import warnings

        from ehlwave.surface.read import ReadOptions, read_surface
        from ehlwave.errors import SurfaceError
        begin = time.process_time()
        options = ReadOptions(length_unit="um", height_unit="nm", step=1.0, fill_missing=True)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                read_surface(self.folder/self.path, options)
            word = "read"
        except SurfaceError:
            word = "refused"
        except Exception as error:   # noqa: BLE001 - the search is for these
            return f"raises {type(error).__name__}: {error}"
        self.answers[word] = self.answers.get(word, 0) + 1
        seconds = time.process_time() - begin
        return f"takes {seconds:.1f} s" if seconds > LONGEST_S else None


def fuzz(name, inputs, seed, seconds=float("inf"), keep=None, say=print):
    """Make and read inputs. Returns their number and a list of failures."""
    faults = []
    with tempfile.TemporaryDirectory(dir=PLACE) as folder:
        target = (Traces if name == "trace" else Target)(name, folder, seed)
        end = time.monotonic() + seconds
        done = 0
        while done < inputs and time.monotonic() < end and len(faults) < 20:
            if done % FRESH == FRESH - 1:
                target.stop()
            data = target.make()
            fault = target.visit()
            done += 1
            if fault is None:
                continue
            faults.append(fault)
            say(f"  {name} {done}: {fault}")
            if keep:
                Path(keep, f"fuzz-{name}-{done}").write_bytes(data)
        target.stop()
        say(f"  {name}: {done} inputs, {target.answers.get('read', 0)} read, {target.answers.get('refused', 0)} refused, "
            f"{len(faults)} faults")
    return done, faults


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("targets", nargs="*", metavar="TARGET", help="one of " + ", ".join(TARGETS) + "; default: all")
    parser.add_argument("--inputs", type=int, default=100000, help="of each target")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="of each target, at most")
    parser.add_argument("--seed", type=int, default=int(time.time()))
    options = parser.parse_args()
    if set(options.targets) - set(TARGETS):
        parser.error("unknown target")
    print(f"fuzz: seed {options.seed}")
    failed = [one for name in options.targets or TARGETS
              for one in fuzz(name, options.inputs, options.seed, options.seconds, keep=".")[1]]
    sys.exit(1 if failed else 0)
