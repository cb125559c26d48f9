"""Whether tests take all of their samples and largest sizes: ``scripts/test --long``."""

import os

IS_LONG = bool(os.environ.get("EHLWAVE_LONG_TESTS"))
