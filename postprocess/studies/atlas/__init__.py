"""The atlas of computed responses that the package ships: ``scripts/study atlas``."""
