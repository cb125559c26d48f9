"""Files are written, and HDF5 files of others opened, each in a single place of the package."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
WRITER = ROOT / "src/ehlwave/writing.py"
READER = ROOT / "src/ehlwave/hdf5.py"
OWN_DATA = {ROOT / "src/ehlwave/laws/atlas/stored.py", ROOT / "studies/atlas/store.py"}
"""Modules that read classic NetCDF, which has no links."""

WRITING = {
    "write_text",
    "write_bytes",
    "savefig",
    "save",
    "savez",
    "savez_compressed",
    "savetxt",
    "tofile",
    "to_hdf",
    "to_excel",
    "to_parquet",
    "to_pickle",
    "to_feather",
    "mkdir",
    "makedirs",
    "unlink",
    "remove",
    "rename",
    "renames",
    "symlink",
    "symlink_to",
    "link",
    "hardlink_to",
    "touch",
    "rmdir",
    "rmtree",
    "copyfile",
    "copy2",
    "copytree",
    "move",
    "truncate",
    "chmod",
}
WRITING_WITH_A_PATH = {"to_csv", "to_json", "to_html", "to_latex", "to_netcdf", "to_zarr"}
MODE = re.compile(r"[rbt]*[wax+][rwaxbt+]*$")


def faults(path: Path, text: str) -> Iterator[str]:
    """Yield the calls of a module that only the writer, or the reader, may have."""
    for node in ast.walk(ast.parse(text)):
        if not isinstance(node, ast.Call):
            continue
        called = node.func
        name = getattr(called, "attr", getattr(called, "id", ""))
        owner = getattr(getattr(called, "value", None), "id", "")
        place = f"{path.name}:{node.lineno}: {ast.unparse(node)[:60]}"
        first = [ast.unparse(one) for one in node.args[:1]]
        if path != WRITER:
            of_columns = name == "rename" and not node.args
            if name in WRITING and isinstance(called, ast.Attribute) and not of_columns:
                yield place
            if name in WRITING_WITH_A_PATH and (first not in ([], ["None"])):
                yield place
            if name == "open" and (owner == "os" and first != ["os.devnull"]):
                yield place
            if name == "open" and _has_mode(node, owner):
                yield place
            if name == "replace" and (owner == "os" or (len(node.args) == 1 and owner != "self")):
                yield place
        if name == "File" and owner == "h5py" and path != READER:
            yield place
        if name == "open_dataset" and path not in {READER, *OWN_DATA}:
            yield place
        if name == "load" and "allow_pickle=True" in ast.unparse(node):
            yield place


def _has_mode(node: ast.Call, owner: str) -> bool:
    is_method = isinstance(node.func, ast.Attribute) and owner not in ("io", "gzip", "codecs")
    words = node.args[0 if is_method else 1 :][:1]
    words += [word.value for word in node.keywords if word.arg == "mode"]
    texts = [word.value for word in words if isinstance(word, ast.Constant)]
    return any(isinstance(text, str) and MODE.match(text) for text in texts)


@pytest.mark.parametrize("folder", ["src/ehlwave", "studies"])
def test_nothing_else_writes_files_or_opens_hdf5(folder: str) -> None:
    modules = sorted((ROOT / folder).rglob("*.py"))
    assert len(modules) > 20
    found = [fault for path in modules for fault in faults(path, path.read_text(encoding="utf-8"))]
    # a copy of a field of a dataclass, by its only positional argument
    found = [fault for fault in found if not re.search(r": (dataclasses\.)?replace\(", fault)]
    assert not found, "\n".join(found)


@pytest.mark.parametrize(
    "statement",
    [
        "open('a', 'w')",
        "path.open('a')",
        "path.open(mode='r+')",
        "io.open(path, 'xb')",
        "os.open(path, flags)",
        "path.write_text('a')",
        "figure.savefig(path)",
        "table.to_csv(path)",
        "data.to_netcdf(path, engine='h5netcdf')",
        "h5py.File(path)",
        "xr.open_dataset(path)",
        "os.replace(a, b)",
        "part.replace(place)",
        "shutil.copyfile(a, b)",
        "np.save(path, a)",
        "np.load(path, allow_pickle=True)",
    ],
)
def test_the_check_finds_what_it_looks_for(statement: str) -> None:
    assert list(faults(Path("m.py"), statement))


@pytest.mark.parametrize(
    "statement",
    [
        "path.open()",
        "open('a', 'rb')",
        "table.to_csv(None)",
        "'a'.replace('b', 'c')",
        "file.write(a)",
    ],
)
def test_the_check_leaves_the_rest(statement: str) -> None:
    assert not list(faults(Path("m.py"), statement))
