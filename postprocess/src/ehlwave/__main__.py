"""``python -m ehlwave`` is the command ``ehlwave``."""

import sys

from ehlwave.cli import main

if __name__ == "__main__":
    sys.exit(main())
