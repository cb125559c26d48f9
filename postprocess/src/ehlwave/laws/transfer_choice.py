"""Which atlas or law judges the components of a surface."""

from ehlwave.choices import LAWS, chosen
from ehlwave.contact.conditions import Conditions
from ehlwave.errors import RangeError
from ehlwave.laws.atlas.atlas import Atlas, atlas_for
from ehlwave.laws.atlas_transfer import AtlasTransfer
from ehlwave.laws.starved_transfer import StarvedTransfer
from ehlwave.laws.transfer import FormulaTransfer, RecommendedTransfer, Transfer
from ehlwave.laws.two_wave_transfer import TwoWaveTransfer


def transfer_of(conditions: Conditions, by: str, own_atlas: Atlas | None) -> Transfer:
    """Return what :meth:`ehlwave.Contact.transfer` does, by another atlas where one is given."""
    chosen(by, "by", LAWS)
    if conditions.is_starved:
        if by != "atlas":
            raise RangeError(
                f"by = {by!r} is for flooded contacts, and oil_over_flooded is given: leave by "
                "out; the law of starved contacts answers"
            )
        return StarvedTransfer(conditions)
    if by == "atlas" and conditions.has_atlas:
        try:
            return AtlasTransfer(conditions, atlas_for(conditions, own_atlas))
        except RangeError as error:
            law = "recommended" if conditions.slip_parameter == 1 else "two-waves"
            raise RangeError(f"{error}. A law is used when named: by={law!r}") from error
    if by in ("atlas", "two-waves"):
        return TwoWaveTransfer(conditions)
    if by == "recommended":
        return RecommendedTransfer(conditions)
    return FormulaTransfer(conditions)
