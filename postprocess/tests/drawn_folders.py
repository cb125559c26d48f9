"""Folders of inputs, files of others and links, and commands that write there, at random."""

import hashlib
import os
import shutil
import stat
from pathlib import Path
from random import Random

from contact import EXPERIMENT

from ehlwave.writing import LIST_FORMAT, LIST_NAME

OUTPUT_NAMES = (
    "collapse.csv",
    "figure1.png",
    "figure2.pdf",
    "refit.csv",
    "refit.json",
    "deformed.csv",
    "deformed.h5",
    "deformed.json",
    "spectrum.csv",
    "spectrum.png",
    "film.csv",
    "c.png",
    "c-case.pdf",
    "out.csv",
    "out.h5",
    "second",
)
CONDITIONS = [f"{key}={value}" for key, value in EXPERIMENT.items()]

Snapshot = dict[str, tuple[str, str]]


def _followed(path: Path) -> os.stat_result | None:
    try:
        return path.stat()
    except (OSError, ValueError):
        return None


def _is_foreign(path: Path) -> bool:
    return (
        not path.is_file()
        or path.is_symlink()
        or LIST_FORMAT not in path.read_text("utf-8", "replace")
    )


class DrawnFolder:
    """A folder, its content, and the files written by commands."""

    def __init__(self, folder: Path, sources: Path, random: Random) -> None:
        """Fill the folder with copies of `sources` by their names or others, and with traps."""
        self.folder, self.random = folder, random
        for name in ("", "here", "here/sub", "outside"):
            (folder / name).mkdir()
        self.here = folder / "here"
        self.inputs = {}
        for source in sorted(sources.iterdir()):
            renamed = random.random() < 0.3
            stem = random.choice(OUTPUT_NAMES[:-1]).split(".")[0] if renamed else source.stem
            place = self.here / f"{stem}{source.suffix}"
            if os.path.lexists(place):
                place = self.here / source.name
            if os.path.lexists(place):
                place = self.here / f"in-{source.name}"
            shutil.copyfile(source, place)
            self.inputs[source.name] = place
        (folder / "outside" / "notes.txt").write_text("years of work")
        (folder / "outside" / "deformed.csv").write_text("x,y\n1,2\n")
        for _ in range(random.randrange(7)):
            self._set_trap()

    def _set_trap(self) -> None:
        """Put a file, a link or a folder at the place of an output."""
        place = self.folder / self.random.choice(("here", "here/sub", "here"))
        place /= self.random.choice((*OUTPUT_NAMES, LIST_NAME))
        if os.path.lexists(place):
            return
        inputs = sorted(self.inputs.values())
        kind = self.random.randrange(8)
        if kind == 0:
            place.write_text("measured on a Sunday")
        elif kind == 1:
            place.mkdir()
            (place / "kept.txt").write_text("kept")
        elif kind == 2:
            place.hardlink_to(self.random.choice(inputs))
        elif kind == 3:
            place.symlink_to(self.random.choice(inputs))
        elif kind == 4:
            place.symlink_to(self.folder / "outside" / "notes.txt")
        elif kind == 5:
            place.symlink_to(self.folder / "outside", target_is_directory=True)
        elif kind == 6:
            place.symlink_to("nowhere")
        else:
            os.mkfifo(place)

    def snapshot(self) -> Snapshot:
        """Return the state of everything, links and folders too, by its path."""
        found = {}
        for path in sorted(self.folder.rglob("*")):
            mode = path.lstat().st_mode
            if stat.S_ISLNK(mode):
                found[str(path)] = "link", str(path.readlink())
            elif stat.S_ISREG(mode):
                found[str(path)] = "file", hashlib.sha256(path.read_bytes()).hexdigest()
            else:
                found[str(path)] = str(stat.S_IFMT(mode)), ""
        return found

    def has_lists_of_others(self) -> bool:
        """Return whether a foreign file has the name of a list of results."""
        return any(_is_foreign(path) for path in self.folder.rglob("*") if path.name == LIST_NAME)

    def command(self) -> list[str]:
        """Return a command that writes, its inputs by names and links that lead to them."""
        draw = self.random.choice
        folder = ["--output", str(self._output_folder())]
        file = str(self._output_file())
        results, trace = self._name("results.h5"), self._name("trace.csv")
        prediction = [trace, "--conditions", *self._conditions(), "--formula", "recommended"]
        commands = (
            ["export", results, "--csv", file],
            ["harmonics", results, "--csv", file],
            ["surface", trace, "--output", file],
            ["collapse", results, *folder],
            ["refit", results, "--replicates", "0", *folder],
            ["contact", self._name("c.h5"), *folder],
            ["plot", self._name("c.h5"), *folder],
            ["deform", *prediction, *folder],
            ["deform", *prediction, "--second", self._name("other.csv"), *folder],
            ["deform", trace, "--conditions", *self._conditions(), *self._refit(), *folder],
        )
        return [*draw(commands), *draw(([], [], [], ["--overwrite"]))]

    def read_by(self, command: list[str]) -> set[str]:
        """Return the paths, by all their names, of the inputs of a command."""
        output = next(k for k, word in enumerate(command) if word in ("--output", "--csv"))
        words = [Path(word) for k, word in enumerate(command) if k != output + 1]
        files = {(found.st_dev, found.st_ino) for one in words if (found := _followed(one))}
        every = {path: path.lstat() for path in self.folder.rglob("*")}
        return {str(path) for path, is_ in every.items() if (is_.st_dev, is_.st_ino) in files}

    def _conditions(self) -> list[str]:
        return self.random.choice((CONDITIONS, [self._name("contact.nml")]))

    def _refit(self) -> list[str]:
        return ["--refit", self._name("refit.csv")]

    def _name(self, source: str) -> str:
        """Return a way to an input: its name, a longer name, a link."""
        place = self.inputs[source]
        kind = self.random.randrange(4)
        if kind == 0:
            return str(place.parent / "sub" / ".." / place.name)
        if kind == 1:
            link = self.folder / "here" / f"link-to-{place.name}"
            if not os.path.lexists(link):
                link.symlink_to(place)
            return str(link)
        return str(place)

    def _output_file(self) -> Path:
        kind = self.random.randrange(6)
        if kind == 0:
            return self.random.choice(sorted(self.inputs.values()))
        if kind == 1:
            return (
                self.folder / "outside" / self.random.choice(("notes.txt", "deformed.csv", "new"))
            )
        return self._output_folder() / self.random.choice(OUTPUT_NAMES)

    def _output_folder(self) -> Path:
        choices = ("here", "here", "here/sub", "here/new/deep", "here/trace.csv", "outside")
        return self.folder / self.random.choice((*choices, "here/sub/..", "here/second"))
