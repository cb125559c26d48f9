"""The recipes of scripts/packaging agree with the project: versions, options of CMake, Python packages, files."""

import json
import re
import subprocess
import sys
import types
import unittest
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGING = ROOT/"scripts"/"packaging"
SPACK = PACKAGING/"spack"/"packages"/"ehlwave"/"package.py"
VERSION = re.search(r"project\(ehlwave VERSION (\S+)", (ROOT/"CMakeLists.txt").read_text())[1]
OTHER_NAME = {"matplotlib-base": "matplotlib"}   # conda-forge's name of a package without its windows


def wanted(text):
    """{package: version} of a list of Python packages, one per line or in quotes."""
    found = re.findall(r"[\"\s-](?:py-)?([A-Za-z][\w-]+?)(?:>=| >=|@)([\d.]+)", text)
    return {OTHER_NAME.get(name, name): version for name, version in found}


def dependencies(*extras):
    """The packages of the core and of some extras."""
    text = (ROOT/"postprocess"/"pyproject.toml").read_text()
    lists = [re.search(rf"^{name} = \[(.*?)\]$", text, re.DOTALL | re.MULTILINE)[1] for name in ("dependencies", *extras)]
    return wanted("\n".join(lists))


class Recorder:
    """Substitute for spack.package: notes every directive that the recipe calls."""

    def __init__(self):
        self.calls = []

    def directive(self, name):
        def call(*arguments, **_):
            self.calls.append((name, *arguments))
            return self
        return call

    def __call__(self, function):
        return function

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return None


def spack_recipe():
    """The class of the recipe and the directives it calls, with a stand-in for Spack."""
    recorder = Recorder()
    package = types.ModuleType("spack.package")
    names = ("license", "version", "variant", "depends_on", "extends", "conflicts", "requires", "generator", "when", "default_args",
             "run_after", "on_package_attributes")
    package.__dict__.update({name: recorder.directive(name) for name in names},
                            CMakePackage=type("CMakePackage", (), {}), PythonExtension=type("PythonExtension", (), {}))
    package.__all__ = [name for name in vars(package) if not name.startswith("_")]
    sys.modules.update({"spack": types.ModuleType("spack"), "spack.package": package})
    scope = {}
    exec(compile(SPACK.read_text(), SPACK, "exec"), scope)
    return scope["Ehlwave"], recorder.calls


class Packaging(unittest.TestCase):
    def test_versions(self):
        places = {"CITATION.cff": r"^version: (\S+)", ".zenodo.json": r'^  "version": "(.*)"', "CHANGELOG.md": r"^## (\d\S+)", "postprocess/pyproject.toml": r'^version = "(.*)"',
                  "scripts/packaging/wheel/pyproject.toml": r'^version = "(.*)"',
                  "scripts/packaging/conda/recipe.yaml": r"^  version: (\d\S+)",
                  "scripts/packaging/spack/packages/ehlwave/package.py": r'^    version\("([^"]*)"'}
        for path, pattern in places.items():
            self.assertEqual(re.search(pattern, (ROOT/path).read_text(), re.MULTILINE)[1], VERSION, path)

    def test_each_wheel_has_a_name_of_its_own_and_the_licence(self):
        licence = (ROOT/"LICENSE").read_text()
        for folder, name in ((ROOT/"postprocess", "ehlwave"), (PACKAGING/"wheel", "ehlwave-programs")):
            text = (folder/"pyproject.toml").read_text()
            self.assertIn(f'\nname = "{name}"\n', text)
            self.assertIn('\nlicense-files = ["LICENSE"]\n', text)
            self.assertEqual((folder/"LICENSE").read_text(), licence)
            self.assertTrue((folder/"README.md").is_file())

    def test_citations_agree(self):
        citation = (ROOT/"CITATION.cff").read_text()
        archive = json.loads((ROOT/".zenodo.json").read_text())
        for text in (f'title: "{archive["title"]}"', f"license: {archive['license']}", *(f"name: {one['name']}" for one in archive["creators"])):
            self.assertIn(text, citation)
        paper = (ROOT/"postprocess"/"paper"/"paper.md").read_text()
        entries = set(re.findall(r"^@\w+\{(\w+),", (ROOT/"postprocess"/"paper"/"paper.bib").read_text(), re.MULTILINE))
        self.assertEqual(set(re.findall(r"@([A-Z]\w+)", paper)), entries)
        for author in re.findall(r"^  - name: (.*)$", paper.split("affiliations:")[0], re.MULTILINE):
            self.assertIn(f"name: {author}", citation)

    def test_options_of_cmake(self):
        known = set(re.findall(r"^\s*(?:option|set)\((EHLWAVE_\w+)", (ROOT/"CMakeLists.txt").read_text() +
                               (ROOT/"scripts"/"cmake"/"install.cmake").read_text(), re.MULTILINE))
        for path in (SPACK, PACKAGING/"conda"/"recipe.yaml", PACKAGING/"wheel"/"pyproject.toml", PACKAGING/"container"):
            used = set(re.findall(r"(EHLWAVE_(?!HOME|PYTHON\b)\w+)", path.read_text()))
            self.assertGreater(len(used), 0)
            self.assertLessEqual(used, known, path)

    def test_python_packages(self):
        expected = dependencies("figures")
        run = (PACKAGING/"conda"/"recipe.yaml").read_text().split("\n  run:\n")[1].split("\ntests:")[0]
        self.assertEqual({name: version for name, version in wanted(run).items() if name != "python"}, expected)
        self.assertEqual({name: version for name, version in wanted(SPACK.read_text()).items() if name in expected}, expected)

    def test_the_recipe_of_spack(self):
        recipe, calls = spack_recipe()
        self.assertIn(("version", VERSION), calls)
        self.assertIn(("depends_on", "fftw-api@3"), calls)
        variants = {call[1] for call in calls if call[0] == "variant"}
        instance = recipe()
        instance.run_tests = False
        instance.define = lambda name, value: f"-D{name}={value}"
        instance.define_from_variant = lambda name, variant: f"-D{name}={variants.intersection([variant]).pop()}"
        instance.spec = types.SimpleNamespace(satisfies=lambda _: False)
        self.assertEqual(instance.cmake_args(), ["-DEHLWAVE_MPI=mpi", "-DEHLWAVE_PETSC=petsc", "-DEHLWAVE_NATIVE=native",
                                                 "-DEHLWAVE_TESTS=False", "-DCMAKE_REQUIRE_FIND_PACKAGE_PETSc=False",
                                                 "-DHDF5_PREFER_PARALLEL=False"])
        # Spack names a folder by its whole path, the installation by that below its prefix.
        instance.spec.satisfies = lambda _: True
        instance.prefix = "/opt/ehlwave"
        recipe.cmake_args.__globals__["python_purelib"] = "/opt/ehlwave/lib/python3.12/site-packages"
        self.assertEqual(instance.cmake_args()[-1], "-DEHLWAVE_INSTALL_PYTHONDIR=lib/python3.12/site-packages")

    def test_the_container(self):
        text = (PACKAGING/"container").read_text().replace("\\\n", " ")
        instructions = [line.split(" ", 1) for line in text.splitlines() if line and not line.startswith("#")]
        self.assertEqual(instructions[0][0], "FROM")
        self.assertLessEqual({word for word, _ in instructions}, {"FROM", "RUN", "COPY", "ENV", "WORKDIR", "CMD"})
        for word, rest in instructions:
            if word == "RUN":
                subprocess.run(["bash", "-n", "-c", rest], check=True)
            elif word == "COPY" and not rest.startswith("--from"):
                self.assertTrue((ROOT/rest.split()[0]).exists(), rest)


if __name__ == "__main__":
    unittest.main()
