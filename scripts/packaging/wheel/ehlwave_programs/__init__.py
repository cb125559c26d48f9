"""The programs of this wheel, as commands of its environment."""

import os
import sys
from pathlib import Path

BIN = Path(__file__).parent/"bin"


def case():
    """Become ehlwave-case."""
    os.execv(BIN/"ehlwave-case", sys.argv)


def accept():
    """Check the results of ehlwave-case."""
    script = BIN.parent/"share"/"ehlwave"/"scripts"/"accept"
    os.execv(sys.executable, [sys.executable, script, *sys.argv[1:]])
