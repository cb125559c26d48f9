"""The former name of :mod:`ehlwave`: ``ehlwave_post.x`` is the module ``ehlwave.x`` itself."""

import importlib
import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType

import ehlwave


class _Renamed(MetaPathFinder, Loader):
    """Finds a module of the former name and returns the present module."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return a spec for ``ehlwave_post.x``, None for anything else."""
        return ModuleSpec(fullname, self) if fullname.startswith("ehlwave_post.") else None

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """Return ``ehlwave.x``; ModuleNotFoundError when there is none."""
        self._own = importlib.import_module(spec.name.replace("ehlwave_post", "ehlwave", 1))
        self._spec = self._own.__spec__
        return self._own

    def exec_module(self, module: ModuleType) -> None:
        """Give the module its own spec back; it has been executed under its name of today."""
        module.__spec__ = self._spec


sys.meta_path.insert(0, _Renamed())
sys.modules[__name__] = ehlwave
