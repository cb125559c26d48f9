"""Change signs and constants of the source, one at a time, and list the tests that notice.

    python3 tests/support/mutate.py --stage build/release:accept --stage build/debug:unit/ [--count N] [--seed N] FOLDER...

A stage is a build folder and a regular expression of CTest names, or accept: scripts/accept. A later stage runs only where those
before have noticed nothing. Each line of the output: file, line, change, number of tests that noticed, their names. The tree must be
a clone of its own: source files are changed, and restored at the end.
"""

import argparse
import random
import re
import signal
import subprocess
import sys
from pathlib import Path

SRC = Path(__file__).parents[2]/"src"
CHANGES = ((re.compile(r" \+ "), " - "), (re.compile(r"(?<=[\w)]) - "), " + "), (re.compile(r"(?<=[\w)])\*(?=[\w(])"), "/"),
           (re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)_dp"), r"1.1_dp*\1_dp"), (re.compile(r"(?<=[-+*/( ])2\*"), "3*"))
LEFT_OUT = re.compile(r"^\s*(!|use |type|integer|logical|character|class|write|call list|error stop|case|.*//)|[\"']|::")


def candidates(folders):
    """All changes of statements: file, line, column, old and new text."""
    for path in sorted(path for folder in folders for path in (SRC/folder).rglob("*.[fF]90")):
        lines = path.read_text(encoding="utf-8").splitlines()
        first = next((n for n, line in enumerate(lines) if line.strip() == "contains" and not line.startswith("   ")), len(lines))
        for number, line in enumerate(lines[first:], first):
            code = line.split("!")[0]
            if LEFT_OUT.search(code):
                continue
            for pattern, new in CHANGES:
                for match in pattern.finditer(code):
                    yield path, number, line[:match.start()] + match.expand(new) + line[match.end():]


def build(folder, *targets):
    return subprocess.run(["cmake", "--build", folder, "-j1", "--target", *targets], capture_output=True, check=False).returncode == 0


def failures(folder, names):
    """Names of the tests that fail."""
    if names == "accept":
        done = subprocess.run([SRC.parent/"scripts/accept", f"{folder}/drivers/ehlwave-case"], capture_output=True, text=True, check=False)
        return ["accept"]*(done.returncode != 0)
    done = subprocess.run(["ctest", "--test-dir", folder, "-R", names, "--timeout", "300"], capture_output=True, text=True, check=False)
    return re.findall(r"Test +#\d+: (\S+) \.*\s*\*\*\*", done.stdout)


def noticed(stages):
    """Tests that notice the change at hand; None: it is not compiled."""
    for folder, names in stages:
        if not build(folder, *(["ehlwave-case"] if names == "accept" else ["all", "test_programs"])):
            return None
        found = failures(folder, names)
        if found:
            return found
    return []


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--stage", action="append", required=True)
    parser.add_argument("--count", type=int, default=36)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))   # the source is restored
    stages = [stage.split(":", 1) for stage in arguments.stage]
    done = 0
    every = list(candidates(arguments.folders))
    random.Random(arguments.seed).shuffle(every)
    for path, number, line in every:
        if done == arguments.count:
            break
        text = path.read_text(encoding="utf-8")
        lines = text.splitlines()
        old, lines[number] = lines[number], line
        try:
            path.write_text("\n".join(lines) + "\n", encoding="utf-8")
            found = noticed(stages)
        finally:
            path.write_text(text, encoding="utf-8")
        if found is not None:
            done += 1
            print(f"{path.relative_to(SRC)}:{number + 1}\t{old.strip()} -> {line.strip()}\t{len(found)}\t{' '.join(found)}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
