"""Ridges along rolling are stationary: in a Newtonian oil slip does not affect them."""

from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from ehlwave.duals import np, placed
from ehlwave.laws.transfer import OfTwo, Transfer, Waves


@dataclass(frozen=True)
class StandingRidges(OfTwo):
    """A transfer under slip whose ridges along rolling have the transfer of pure rolling.

    Stationary patterns make no squeeze, and the flow along rolling of a Newtonian oil depends on
    the mean speed alone. So their response is the same for every S.
    """

    moving: Transfer
    standing: Transfer

    @property
    def name(self) -> str:
        """Return the description of both transfers."""
        return f"{self.moving.name}; ridges along rolling: {self.standing.name}"

    @property
    def parts(self) -> tuple[Transfer, Transfer]:
        """Return both transfers."""
        return self.moving, self.standing

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[Any]:
        """Return the transfer for waves per metre along x (any sign) and y."""
        return self._of_both("ratio", per_length_x, per_length_y)

    def pressure(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[Any]:
        """Return the pressure transfer, in units of ph/c."""
        return self._of_both("pressure", per_length_x, per_length_y)

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves:
        """Return the absolute error of the transfer."""
        return self._of_both("error", per_length_x, per_length_y)

    def rise(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return the contributions to the mean film; None where either transfer has none."""
        return self._of_both("rise", per_length_x, per_length_y)

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether the transfer of each wave is known rather than continued."""
        return self._of_both("is_covered", per_length_x, per_length_y)

    def _of_both(self, kind: str, per_length_x: Waves, per_length_y: Waves) -> Any:  # noqa: ANN401
        qx, qy = np.broadcast_arrays(np.asarray(per_length_x), np.asarray(per_length_y))
        stands = (qx == 0) & (qy != 0)
        moving = None if stands.all() else getattr(self.moving, kind)(qx, qy)
        if not stands.any():
            return moving
        standing = getattr(self.standing, kind)(qx[stands], qy[stands])
        if standing is None or (moving is None and not stands.all()):
            return None
        return placed(stands, standing, 0 if moving is None else moving)
