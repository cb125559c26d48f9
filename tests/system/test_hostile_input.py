"""Inputs that are long, large, damaged or meant to harm: refused in a line, in linear time, in little memory."""

import base64
import struct
import unittest
import zlib

from attack import REFUSED, attack
from ehlwave_program import FolderTest, namelist

MOES = "&conditions load_parameter_m = 100, lubricant_parameter_l = 12.05, radius_ratio_d = 1 /\n"
GRID = {"cells_x": 32, "cells_y": 32}
DIMENSIONAL = {"radius_x_m": 12.52e-3, "radius_y_m": 12.52e-3, "reduced_modulus_pa": 1.17e11, "load_n": 39.2,
               "mean_speed_m_per_s": 0.024, "viscosity_pa_s": 1.22}

# Surfaces of 2 kB, deflated, in which a fuzzer changed some bytes: HDF5 1.10 ends the process that reads the numbers of the first
# (its stack is smashed) or opens the second (SIGSEGV).
BROKEN = [base64.b64decode(text) for text in (
    "eNrr9HBx4+WS4mIAAQ4OBhYGAQZk8B8K4jhQ+TD5BCjNCKU7oPQKJpg4I1hOAiouCDUfXV1IkKsrSPV/NACzx4AFQkswjIKRCDxcHQNAdASUrwClTzChqs"
    "tIzUzPKGFgqIDyK9HSpwWJ9jIysEL0MsL4GhCaCSLADFXHikM/MzC9g1QKAPMPxKnvoeo5wOJMTBCDOKApm5mRAZrT5NBMahgU8RDs5+/CCPQVBywemPGr"
    "h5UmFaz41cHydQfbyEjPmOkKEgKMjIwo6YkVno4kwEoFFeyhYe/AYMLNYPKfmYFAepKDRpUGmgs6hlR4MMPDgdLwcOPAXpN0MIxMwAgulxhxsJDBB3soww"
    "FCcUBpAQc0hXBxAMnxOxQ=",
    "eNrr9HBx4+WS4mIAAQ4OBhYGAQZk8B8K4jhQ+TD5BCjNCKU7oPQKJpg4I1hOAiouCDefEW4WupkGLAzYxMBAgmEUjAjwHpXr4eoYAKIjoHwFKH2CCVVdRm"
    "pmekYJA0MFlF+Jlj4tSHQGIwMrRC8jjK8BoZkgAsxQdaxQGpMvANYqAMw/EKcKQOU5wOJMTBCDOKApm5mRAZrT5NBc0jAooiXYz9+FEegrDlg8MONXD8vt"
    "Faz41cHydQfbyEjemOkKEgKMjIwo6QeRjiTASgUV7KFh78Bgws1g8p+ZgUB6koNGlQaaCzqGVHjAkhnzUkrDw40De03SMfQSkTx1Qp4JGuzYWMjggz2U4Q"
    "ChOKC0gAOaQrg4AOfGQrk=")]


class HostileInput(FolderTest):
    def write(self, name, text):
        data = text if isinstance(text, bytes) else text.encode()
        (self.folder/name).write_bytes(data)

    def judge(self, what, needle, program, *arguments, status=REFUSED):
        """The program must end as expected, print `needle`, and behave."""
        with self.subTest(what=what):
            outcome = attack(program, *arguments, folder=self.folder)
            self.assertEqual(outcome.faults(), [], outcome.stderr[:500])
            self.assertEqual(outcome.status, status, outcome.stderr[:500])
            self.assertIn(needle, outcome.stdout + outcome.stderr)

    def test_namelists(self):
        for what, text, needle in [
                ("100,000 keys", "&conditions\n" + "".join(f" k{i} = 1\n" for i in range(100000)) + "/\n", "unknown key 'k0'"),
                ("100,000 groups", "".join(f"&g{i} a = 1 /\n" for i in range(100000)), "unknown group &g0"),
                ("key given 100,000 times", "&grid\n" + " cells_x = 32\n"*100000 + "/\n", "given twice"),
                ("value of 1 MB", MOES + f"&solver method = '{'n'*10**6}' /\n", "not one of the choices"),
                ("number of 1 MB", MOES.replace("100,", "1"*10**6 + ","), "too large"),
                ("key of 1 MB", f"&conditions {'k'*10**6} = 1 /\n", "not the name of a key"),
                ("1 MB of quotes", MOES + f"&solver method = '{chr(39)*10**6} /\n", "quote without its partner"),
                ("100,000 values", MOES + f"&grid cells_x = {'1, '*99999}1 /\n", "100000 values"),
                ("repeat count", MOES + "&grid cells_x = 99999999*1 /\n", "repeat count"),
                ("escape bytes", MOES + "&solver method = '\x1b[2J\x1b]0;x\x07' /\n", "not one of the choices"),
                ("other control bytes", MOES + "&solver method = '\u009b2J' /\n", "not one of the choices"),
                ("escape byte as key", MOES + "&solver \x1bmethod = 'fas' /\n", "not plain ASCII"),
                ("a megabyte of blanks", " "*10**6, "no group")]:
            self.write("case.nml", text)
            self.judge(what, needle, "case", "case.nml", "--plan")
        self.judge("name with escape bytes", "o such file", "case", "\x1b[2J.nml")
        self.judge("option with escape bytes", "unknown option", "case", "--\x1b[2J")
        self.judge("argument of 100,000 bytes", "characters", "case", "x"*100000)

    def test_lists(self):
        lists = {"load_parameter_m": list(range(1, 2001)), "lubricant_parameter_l": list(range(1, 2001)), "radius_ratio_d": 1}
        self.write("sweep.nml", namelist({"sweep": lists, "grid": GRID}))
        self.judge("4 million combinations", "4000000 combinations", "sweep", "sweep.nml", "--plan")
        self.write("sweep.nml", "&sweep load_parameter_m = 50000*20, lubricant_parameter_l = 5, radius_ratio_d = 1 /\n")
        self.judge("50000 times the same", "1 case,", "sweep", "sweep.nml", "--plan", status=0)

    def test_tables(self):
        self.write("sweep.nml", namelist({"sweep": {"case_file": "cases.csv"}, "grid": GRID}))
        header = "load_parameter_m,lubricant_parameter_l,radius_ratio_d"
        for what, text, needle in [
                ("100,000 columns", ",".join(f"c{i}" for i in range(100000)) + "\n" + "1,"*99999 + "1\n", "'c0'"),
                ("2,000 columns, a million blank lines", ",".join(f"c{i}" for i in range(2000)) + "\n"*10**6 + "1,"*1999 + "1\n",
                 "'c0'"),
                ("a million short rows", header + "\n" + "1\n"*10**6, "cases.csv:2: 1 values"),
                ("a million rows", "load_parameter_m\n" + "1\n"*10**6, "1000000 rows"),
                ("a cell of 1 MB", header + "\n" + "1"*10**6 + ",1,1\n", "longer than 64"),
                ("escape bytes", header + ",\x1b[2J\n1,1,1,1\n", "unknown"),
                ("only commas", ","*10**6 + "\n", "given twice"),
                ("17 MiB", "# \n"*6*10**6, "larger than 16 MiB")]:
            self.write("cases.csv", text)
            self.judge(what, needle, "sweep", "sweep.nml", "--plan")
        self.write("cases.csv", b"\xef\xbb\xbf" + f"{header}\r\n100,5,1\r\n".encode())
        self.judge("a table of a spreadsheet", "1 case,", "sweep", "sweep.nml", "--plan", status=0)

    def test_surfaces(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("h5py is missing")
        self.write("case.nml", namelist({"conditions": DIMENSIONAL, "surface": {"file": "s.h5"}, "grid": GRID}))
        for what, shape, needle in [("298 GiB", (200000, 200000), "4e10 points"), ("2^31 points", (2, 2**30), "points"),
                                    ("numbers that are not there", (5, 7), "cannot be read"), ("one dimension", (35,), "cannot be read")]:
            with h5py.File(self.folder/"s.h5", "w") as file:
                file.create_dataset("height", shape=shape, dtype="f8", chunks=tuple(min(n, 64) for n in shape))
                file["x"] = [8e-6*i for i in range(7)]
                file["y"] = [8e-6*i for i in range(5)]
            self.judge(what, needle, "case", "case.nml", "--plan")
        self.surfaces_elsewhere(h5py)
        whole = (self.folder/"s.h5").read_bytes()
        self.write("s.h5", whole[:len(whole)//2])
        self.judge("half a file", "s.h5", "case", "case.nml", "--plan")
        for number, data in enumerate(BROKEN):
            self.write("s.h5", zlib.decompress(data))
            self.judge(f"what the library breaks down on, {number}", "is damaged", "case", "case.nml", "--plan")

    def surfaces_elsewhere(self, h5py):
        """Heights that are in other files, which are not read, and many that are in none."""
        heights = [[1e-8*(i*j % 5) for i in range(16)] for j in range(16)]
        steps = [8e-6*i for i in range(16)]
        with h5py.File(self.folder/"other.h5", "w") as file:
            file["height"] = heights
        self.write("raw", file_of(heights))
        virtual = h5py.VirtualLayout(shape=(16, 16), dtype="f8")
        virtual[:] = h5py.VirtualSource("other.h5", "height", shape=(16, 16))
        for what, make in [
                ("external link", lambda file: file.__setitem__("height", h5py.ExternalLink("other.h5", "/height"))),
                ("soft link", lambda file: file.update({"g": h5py.ExternalLink("other.h5", "/"), "height": h5py.SoftLink("/g/height")})),
                ("external storage", lambda file: file.create_dataset("height", (16, 16), "f8", external=[("raw", 0, 2048)])),
                ("virtual dataset", lambda file: file.create_virtual_dataset("height", virtual))]:
            with h5py.File(self.folder/"s.h5", "w") as file:
                make(file)
                file["x"] = file["y"] = steps
            self.judge(what, "not in the file itself", "case", "case.nml", "--plan")
        with h5py.File(self.folder/"s.h5", "w") as file:
            for name, shape in [("height", (7000, 7000)), ("x", (7000,)), ("y", (7000,))]:
                file.create_dataset(name, shape, "f8", chunks=(8,)*len(shape))[:1] = 1e-8 if name != "height" else [[1e-8]*7000]
        self.assertLess((self.folder/"s.h5").stat().st_size, 10**6)
        self.judge("49 million heights in 0.5 MB", "cannot be read", "case", "case.nml", "--plan")
        (self.folder/"s.h5").unlink()
        with h5py.File(self.folder/"s.h5", "w") as file:
            file["height"], file["x"], file["y"] = heights, steps, steps


def file_of(rows):
    """The bytes of numbers, as external storage has them."""
    return struct.pack(f"{sum(map(len, rows))}d", *(value for row in rows for value in row))


if __name__ == "__main__":
    unittest.main()
