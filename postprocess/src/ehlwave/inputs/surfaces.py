"""Surfaces that keys take: objects with heights, as types."""

from typing import Any, Protocol


class SurfaceLike(Protocol):
    """Heights on a uniform grid in metres, as :class:`ehlwave.surface.Surface` has them."""

    @property
    def height(self) -> Any:  # noqa: ANN401
        """Heights over x and y, m."""

    @property
    def step_x_m(self) -> float:
        """Step along x, m."""

    @property
    def step_y_m(self) -> float:
        """Step along y, m."""


class TopographyLike(Protocol):
    """Use of objects of SurfaceTopography: only equidistant points."""

    @property
    def is_uniform(self) -> bool:
        """Whether points are equidistant."""

    @property
    def unit(self) -> str | None:
        """Unit of lengths and heights."""

    @property
    def pixel_size(self) -> Any:  # noqa: ANN401
        """Steps along x and y."""

    def heights(self) -> Any:  # noqa: ANN401
        """Return heights over x and y."""
