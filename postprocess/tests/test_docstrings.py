"""Public names are documented: examples print their stated output, no parameter is missing."""

import doctest
import importlib.util
import inspect
import os
import pkgutil
from collections.abc import Iterator
from pathlib import Path

import pytest

import ehlwave
from ehlwave.programs.programs import find_program
from studies.programs import ONE_RANK

USES_PROGRAMS = ("ehlwave.Case(", "ehlwave.Study(")


def has_programs() -> bool:
    try:
        return bool(find_program("ehlwave-case")) and bool(find_program("ehlwave-sweep"))
    except ehlwave.ProgramError:
        return False


def public_names() -> Iterator[tuple[str, object]]:
    """Yield the names of the package, and the public methods and properties of its classes."""
    for name in ehlwave.__all__:
        item = getattr(ehlwave, name)
        yield name, item
        bases = inspect.getmro(item) if inspect.isclass(item) else ()
        for base in bases:
            for member, value in vars(base).items() if _is_ours(base) else ():
                if not member.startswith("_") and inspect.getdoc(value) and _is_documented(value):
                    yield f"{name}.{member}", value


def _is_ours(base: type) -> bool:
    return base.__module__.startswith("ehlwave.")


def _is_documented(value: object) -> bool:
    return inspect.isfunction(value) or isinstance(value, (property, classmethod, staticmethod))


NAMES = dict(public_names())


@pytest.mark.parametrize("name", NAMES)
def test_examples_print_what_they_say(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = inspect.getdoc(NAMES[name]) or ""
    assert ">>> import ehlwave" in text, f"{name} has no example that runs by itself"
    assert "+SKIP" not in text
    if any(use in text for use in USES_PROGRAMS):
        if not has_programs():
            pytest.skip("the programs are not built")
        folder = find_program("ehlwave-case").parent
        monkeypatch.setenv("EHLWAVE_PROGRAMS", os.fspath(folder.resolve()))
        for variable, value in ONE_RANK.items():
            monkeypatch.setenv(variable, value)
    monkeypatch.chdir(tmp_path)
    examples = doctest.DocTestParser().get_doctest(text, {}, name, None, None)
    said: list[str] = []
    failed, tried = doctest.DocTestRunner().run(examples, out=said.append)
    assert tried > 0
    assert failed == 0, "".join(said)


def inner_modules() -> Iterator[str]:
    """Yield modules whose docstrings have examples."""
    for module in pkgutil.walk_packages(ehlwave.__path__, "ehlwave."):
        spec = importlib.util.find_spec(module.name)
        if spec is not None and ">>>" in Path(spec.origin or "").read_text(encoding="utf-8"):
            yield module.name


@pytest.mark.parametrize("name", list(inner_modules()))
def test_examples_of_inner_functions(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Examples of functions that are not public, which the test above does not see."""
    public = {inspect.getdoc(item) for item in NAMES.values()}
    monkeypatch.chdir(tmp_path)
    module = importlib.import_module(name)
    said: list[str] = []
    for examples in doctest.DocTestFinder(exclude_empty=True).find(module):
        if inspect.cleandoc(examples.docstring or "") not in public:
            doctest.DocTestRunner().run(examples, out=said.append)
    assert said == []


@pytest.mark.parametrize("name", NAMES)
def test_no_parameter_is_missing(name: str) -> None:
    validate = pytest.importorskip("numpydoc.validate").validate
    owner, _, member = name.partition(".")
    item = getattr(ehlwave, owner)
    path = ".".join(filter(None, (item.__module__, item.__qualname__, member)))
    wrong = [error for error in validate(path)["errors"] if error[0] in ("EX01", "PR01", "PR02")]
    assert wrong == []
