"""The atlas: responses of smooth contacts to small waves, computed once and learned by networks."""

from ehlwave.laws.atlas.atlas import Atlas, load_atlas

__all__ = ["Atlas", "load_atlas"]
