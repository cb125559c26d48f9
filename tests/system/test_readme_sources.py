"""Every number of every README is of a kind that cannot go stale, is compared, or is counted as measured by hand.

By rule a number states a definition or a condition (code, equations, years, versions, exponents, `M = 100`, grids, citations), or a
test compares it: `test_readme_numbers`, or the test of the reference of keys. The others were measured by hand. The
record `by_hand.csv` has how many of these each page has at most, and with which results of `scripts/accept` they were
measured: when those change, this test fails until somebody has measured again.
"""

import ast
import csv
import hashlib
import re
import sys
import unittest
from pathlib import Path

from ehlwave_program import report
from test_readme_commands import READMES
from test_readme_numbers import CLAIMS, NUMBER, agrees, found_in

ROOT = Path(__file__).resolve().parents[2]
PAGES = [page for page in READMES if not any(part.startswith(".") for part in Path(page).parts)]
LEDGER = ROOT/"postprocess/record/by_hand.csv"
RESULTS = ROOT/"scripts/accept.csv"
BY_PROGRAMS = ("README.md", "postprocess/manual/case.md")
"""Pages with sentences that are compared with the programs."""
DIGITS = 4
"""Digits of results that hold for any compiler."""

UNIT = r"(?: ?(?:a|b|um|nm|mm|m/s|MPa|GPa|Pa|K|N/m|1/Pa|hX|Hc|%|of the film))?"
SYMBOL = (r"(?:(?:gamma )?M|L|D|S|E'|alpha E'|alpha|alphabar|z|n|G|K0'?|f\(r\)|f V|tau0|tau0/E'|X|Y|Z|T|U|dT|hX|hY|B|N|p|P|y|kappa|Omega|"
          r"Rq|Ai|lambda|lambda/[abh]|lambda_[nxy](?:/a)?|abs\(X\)|\|X\|)")
AND = r"(?:,| and| or| to|, and|, to| beside)?"
RULES = {
    "comments, code, addresses": r"<!--.*?-->|`[^`]*`|\]\([^)]*\)|https?://\S+|doi:\S+|arXiv:\S+",
    "references": r"(?:(?<=\s)|^)\d+\. (?=[A-ZÖÄÜ])[^|]*?\b(?:19|20)\d\d\b[^|]*?(?=\s\d+\. [A-ZÖÄÜ]|$|\s#)",
    "what is cited": r"(?:[^|.]|\.(?=\d))*\[\d+(?:[ ,][^\]]*)?\](?:[^|.]|\.(?=\d))*",
    "years, volumes and pages": r"\b(?:19|20)\d\d\b\)?(?:, ?\d+-\d+| \d+-\d+)?|\b[A-Z]?\d+(?: \(|, )?#?,? \d+-\d+",
    "equations": r"\((?:[A-Z]{0,2}\d+[a-z]?)(?:(?:,| and| to|-) ?\(?[A-Z]{0,2}\d+[a-z]?\)?)*\)",
    "figures and sections": r"\b(?:[Ff]igures?|[Tt]ables?|eqs?\.|[Ee]quations?|[Ss]ections?|[Cc]hapters?|[Vv]olumes?|Series|[Ii]nstants?|"
                            r"[Cc]riteri(?:on|a)|International|NASA \w+) \(?\d[\d.-]*\)?(?:,? (?:and|to|or) \(?\d[\d.]*\)?)*|pp?\. \d+",
    "versions and names": r"\b(?:[Vv]ersion|Debian|Ubuntu|Python|gfortran|GCC|Open MPI|MPICH|Slurm|PETSc|Spack|NumPy|HDF5?|AVX|CMake|"
                          r"FFTW|VG|ISO|ASTM D|PAO|LVI|Santotrac|MIT|TDF-) ?\d[\d.]*(?: (?:and|to) \d+(?! ?%))?|\b[A-Za-z']*[A-Za-z]-?\d+\b|x86-64|\b\d[A-Z]\d[A-Z]\b",
    "exponents": r"\^\(?[-+]?\d+(?:\.\d+)?(?:/\d+)?\)?",
    "exit statuses": r"[Ee]xit status(?:es)?:? [^.|]*|status(?:es)? \d+(?:(?:,| and| or) \d+)*",
    "conditions": rf"\b{SYMBOL} ?(?:=|<=|>=|<|>|below|above|from|of|near|up to|at least|at most|) ?{NUMBER}{UNIT}(?:{AND} (?:<= )?{NUMBER}{UNIT})*"
                  rf"|{NUMBER}{UNIT} (?:<=|<) {SYMBOL}(?!\w)",
    "grids": rf"{NUMBER} x {NUMBER}|{NUMBER}(?:(?:,| and| or| to) {NUMBER})* (?:cells|nodes|levels|ranks|cores|points per wave)\b",
    "formulas": r"\b\d+(?:\.\d+)?/\(|\(\d+(?:\.\d+)? [-+] (?:\d+(?:\.\d+)? [a-z(])?|[-+] \d+(?:\.\d+)? \(?[a-z]|\b\d pi|\b[a-z] [-+] \d+\b|\bS -> 1",
    "an accuracy in other words": r"asks for (?:a relative error of )?1 %",
}


def also_compared():
    """Sentences by page, with their values, that `test_readme_numbers` has not."""
    formula = (ROOT/"postprocess/src/ehlwave/contact/formula.py").read_text(encoding="utf-8")
    constants = [float(re.search(rf"^PAPER_{name} = ([\d.]+)$", formula, re.MULTILINE)[1]) for name in ("C1", "C2")]
    default = re.search(r"^\| `amplitude_over_film` \| `([\d.]+)`", (ROOT/"inputs/keys/waviness.md").read_text(encoding="utf-8"), re.MULTILINE)[1]
    return {
        "README.md": [("1/(1 + {} f V + {} (f V)^2)", constants), ("with an amplitude of {} %", [100*float(default)]),
                      ("| c1 = {}, c2 = {} |", constants)],
    }


def prose(page):
    """A page as a single line, without run parts."""
    text = (ROOT/page).read_text(encoding="utf-8")
    text = "\n".join(line for line in text.splitlines() if not re.match(r"    \S| {8}", line))
    return re.sub(r"\s+", " ", text)


def compared_by_programs():
    """Sentences of test_readme_numbers that are compared with the programs."""
    tree = ast.parse((Path(__file__).parent/"test_readme_numbers.py").read_text(encoding="utf-8"))
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "found_in"]
    return [call.args[1].value for call in calls if isinstance(call.args[1], ast.Constant)]


def left_over(text, sentences):
    """The numbers that neither a test nor a rule has."""
    for sentence in sentences:
        pattern = NUMBER.join(re.escape(part) for part in sentence.split("{}"))
        text = re.sub(pattern, " # ", text, count=1, flags=re.IGNORECASE)
    for rule in RULES.values():
        text = re.sub(rule, " # ", text)
    return [text[max(0, one.start() - 50):one.end() + 20] for one in re.finditer(NUMBER, text)]


def results_digest(rows=None):
    """Rows of `scripts/accept.csv`, and a digest of the first so many of them."""
    with RESULTS.open(encoding="utf-8", newline="") as file:
        found = list(csv.reader(file))
    rows = rows or len(found)
    rounded = [[f"{float(one):.{DIGITS}g}" if re.fullmatch(NUMBER, one) else one for one in row] for row in found[:rows]]
    return f"{rows}:{hashlib.sha256(repr(rounded).encode()).hexdigest()[:8]}"


def ledger():
    with LEDGER.open(encoding="utf-8", newline="") as file:
        return {row["page"]: (int(row["numbers"]), row["results"]) for row in csv.DictReader(file)}


def by_hand(page):
    """Where a page has numbers that were measured by hand."""
    sentences = [sentence for sentence, _ in [*CLAIMS.get(page, list)(), *also_compared().get(page, [])]]
    return left_over(prose(page), sentences + (compared_by_programs() if page in BY_PROGRAMS else []))


def write_ledger():
    """Count anew, after somebody has measured again: `python tests/system/test_readme_sources.py --write`."""
    rows = [(page, len(by_hand(page)), results_digest()) for page in PAGES if by_hand(page)]
    LEDGER.write_text("".join(",".join(map(str, row)) + "\n" for row in [("page", "numbers", "results"), *rows]), encoding="utf-8")


class Sources(unittest.TestCase):
    def test_numbers_that_only_this_test_compares(self):
        self.assertGreater(len(compared_by_programs()), 3)
        for page, claims in also_compared().items():
            for sentence, values in claims:
                with self.subTest(page=page, sentence=sentence):
                    printed = found_in(prose(page), sentence)
                    self.assertIsNotNone(printed, f"{page} has no such sentence: change this test with it")
                    for one, value in zip(printed, values, strict=True):
                        self.assertTrue(agrees(one, value), (one, value))

    def test_no_more_numbers_than_said_were_measured_by_hand(self):
        known = ledger()
        for page in PAGES:
            with self.subTest(page=page):
                left, most = by_hand(page), known.get(page, (0, ""))[0]
                report(f"{page}: {len(left)} of {len(re.findall(NUMBER, prose(page)))} numbers measured by hand")
                self.assertLessEqual(len(left), most, f"{page}: compare the new one with a record, or leave it out:\n" + "\n".join(left))

    def test_what_was_measured_by_hand_belongs_to_these_results(self):
        for page, (_, results) in ledger().items():
            self.assertIn(page, PAGES)
            self.assertEqual(results, results_digest(int(results.partition(":")[0])),
                             f"{page}: results have changed since numbers of it were measured by hand: measure them again")

    def test_what_the_rules_take(self):
        for text, left in (("M = 100, L = 12.05 and D 1 to 0.12 on 128 x 128 cells by (18) of Figure 2 (1994)", 0),
                           ("`cells_x = 64` takes 17 steps", 1), ("within 4 % of Rq", 1), ("0.5 a and 2 a take 41 work units", 3),
                           ("(f V)^2 with status 2", 0), ("mineral oil | 7 [1] | 0.35 [1] | 12", 1), ("by 2.1 % for M = 100", 1),
                           ("28 minutes on two cores", 1)):
            self.assertEqual(len(left_over(text, [])), left, (text, left_over(text, [])))
        self.assertEqual(left_over("takes 17 steps", ["takes {} steps"]), [])


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        write_ledger()
    else:
        unittest.main()
