"""Folders full of files under drawn names, and forbidden changes by a command.

A test makes a `Scene` with its random generator, lets a command loose on names that `Scene.path` draws, and asks `Scene.damage`:
nothing that existed and is not a result of the programs may change (content, type, target of a link, mode) or vanish.
"""

import hashlib
import os
import shutil
import stat
from pathlib import Path

ODD_LETTERS = [" ", "\n", "\t", "'", '"', "*", "#", "-", "\x1b[2J", "ä", "\udcff", "$HOME", ";", "%s", "="]
DECOYS = {
    "thesis.txt": b"chapter 1\n",
    "notes": b"",
    "data.csv": b"x;z\n0;1\n",
    "photo.h5": b"not HDF5 at all\n",
    "r.h5.part-old": b"kept\n",
}
"""Files of somebody: never to be changed, whatever they are called."""


def snapshot(folder):
    """{path: facts} of everything below a folder, links not followed."""
    found = {}
    for parent, folders, files in os.walk(folder):
        for name in folders + files:
            path = os.path.join(parent, name)
            facts = os.lstat(path)
            if stat.S_ISLNK(facts.st_mode):
                content = os.readlink(path)
            elif stat.S_ISREG(facts.st_mode):
                content = _digest(path)
            else:
                content = None
            found[os.path.relpath(path, folder)] = (facts.st_mode, content)
    return found


def _digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


class Scene:
    """A folder with inputs, results, and other files beside them, under drawn names.

    `inputs` and `results` map names to a file or a folder that is copied; a command may replace or remove results only.
    """

    def __init__(self, folder, random, inputs, results=None, suffixes=(".h5", ".csv", ".txt", ".store", "")):
        self.folder = Path(folder)
        self.random = random
        self.suffixes = suffixes
        self.inputs = list(inputs)
        self.ours = set()
        """Names of results, and of files in stores."""
        (self.folder/"sub"/"deep").mkdir(parents=True)
        for name, source in inputs.items():
            _copy(source, self.folder/name)
        place = self._place()
        for name, source in (results or {}).items():
            target = self.folder/place/name
            if not os.path.lexists(target):
                _copy(source, target)
                self.ours.update(os.path.relpath(path, self.folder) for path in [target, *target.rglob("*")])
        for name, content in DECOYS.items():
            if random.random() < 0.6:
                self._write(self._place()/name, content)
        for _ in range(random.randint(2, 8)):
            self._draw_one()
        self._before = snapshot(self.folder)

    def _place(self):
        return Path(self.random.choice(["", "", "sub", "sub/deep"]))

    def _name(self):
        """A new name, often close to the name of an input or a result."""
        random = self.random
        stem = random.choice(["r", "out", "a b", "case", "0123456789abcdef", *[Path(name).stem for name in self.inputs]])
        if random.random() < 0.2:
            at = random.randint(0, len(stem))
            stem = stem[:at] + random.choice(ODD_LETTERS) + stem[at:]
        name = stem + random.choice(self.suffixes)
        if random.random() < 0.15:
            name = name.swapcase()
        return name[:100]

    def existing(self):
        """Names that are there, in the folder's own terms."""
        return sorted(os.path.relpath(os.path.join(parent, name), self.folder)
                      for parent, folders, files in os.walk(self.folder) for name in folders + files)

    def _write(self, path, content):
        path = self.folder/path
        if os.path.lexists(path):
            return
        path.write_bytes(content)
        if self.random.random() < 0.2:
            path.chmod(0o444)

    def _draw_one(self):
        """A file, a folder, a link, a hard link, a pipe, or a folder that looks like a store."""
        random = self.random
        path = self.folder/self._place()/self._name()
        if os.path.lexists(path):
            return
        target = self.folder/random.choice([".", *self.existing()])
        kind = random.choice(["file", "empty", "folder", "link", "link", "hard link", "hard link", "loop", "pipe", "store"])
        if kind == "file":
            self._write(path, b"measured %d\n" % random.randint(0, 99))
        elif kind == "empty":
            self._write(path, b"")
        elif kind == "folder":
            path.mkdir()
            self._write(path/self._name(), b"kept\n")
        elif kind == "link":
            path.symlink_to(random.choice([os.path.relpath(target, path.parent), target, "nowhere"]))
        elif kind == "loop":
            path.symlink_to(path.name)
        elif kind == "pipe":
            os.mkfifo(path)
        elif kind == "hard link" and target.is_file() and not target.is_symlink():
            os.link(target, path)
            if os.path.relpath(target, self.folder) in self.ours:
                self.ours.add(os.path.relpath(path, self.folder))
        elif kind == "store":
            self._pretend_store(path.with_name(path.name.split(".")[0] + ".store"))

    def _pretend_store(self, path):
        """A folder of somebody with names that a store has."""
        if os.path.lexists(path):
            return
        path.mkdir()
        for name in self.random.sample(["fields", "records", "checkpoints", "cases", "defaults", "store", "notes"], 3):
            if self.random.random() < 0.5:
                self._write(path/name, b"kept\n")
            else:
                (path/name).mkdir()
                self._write(path/name/self.random.choice(["0123456789abcdef.h5", "0123456789abcdef", "000001-000000.log", "x"]),
                            b"kept\n")

    def spoil(self, store):
        """Put a foreign entry into a store: a file, or a link in place of one of its folders."""
        store, random = self.folder/store, self.random
        part = store/random.choice(["records", "fields", "checkpoints", ".", "cases", "defaults", "lock", "store"])
        if random.random() < 0.5 and part.is_dir():
            self._write(part/self._name().replace("/", ""), b"kept\n")
        elif part != store and os.path.lexists(part):
            shutil.rmtree(part) if part.is_dir() else part.unlink()
            part.symlink_to(self.folder/random.choice(["sub", "sub/deep", *self.inputs]))
        self._before = snapshot(self.folder)

    def path(self):
        """A path as typed by a user: an existing name or a new one, in any spelling."""
        random = self.random
        name = random.choice(self.existing()) if random.random() < 0.6 else str(self._place()/self._name())
        if random.random() < 0.15:
            name = random.choice(["r", "out", "sub/r"]) + random.choice(self.suffixes)
        parent, _, last = name.rpartition("/")
        spelling = random.choice(["plain"]*5 + ["dot", "dots", "slash", "double", "absolute", "case"])
        return {"plain": name, "dot": "./" + name, "dots": f"sub/../{name}", "slash": name + "/",
                "double": (parent + "//" if parent else ".//") + last, "absolute": str(self.folder/name),
                "case": name.swapcase()}[spelling]

    def damage(self, allowed=None):
        """List changed files that existed and are no results. A file `allowed` may be replaced."""
        after = snapshot(self.folder)
        if allowed is not None:
            allowed = os.path.relpath(os.path.join(os.path.realpath(self.folder/os.path.dirname(allowed)), os.path.basename(allowed)),
                                      os.path.realpath(self.folder))
            if not stat.S_ISREG(self._before.get(allowed, (0,))[0]):
                allowed = None
        return [f"{name!r}: {'changed' if name in after else 'gone'}" for name, facts in self._before.items()
                if name not in self.ours and name != allowed and after.get(name) != facts]

    def listing(self):
        """The scene in lines, for the message of a test that fails."""
        return "\n".join(f"   {name!r} {oct(mode)} {content or ''}"[:140] for name, (mode, content) in sorted(self._before.items()))


def _copy(source, target):
    if Path(source).is_dir():
        shutil.copytree(source, target, symlinks=True)
    else:
        shutil.copyfile(source, target)
