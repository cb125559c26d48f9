"""Exports of many makers' instruments are read unchanged, without a question."""

from pathlib import Path

import numpy as np
import pytest
from instrument_exports import MAP_UM, MAPS, PROFILES, STEP_UM, Z_UM

from ehlwave.surface import read_surface


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "utf-16-be"])
@pytest.mark.parametrize("maker", PROFILES)
def test_profiles(tmp_path: Path, maker: str, encoding: str) -> None:
    (tmp_path / "t.csv").write_text(PROFILES[maker], encoding=encoding)
    found = read_surface(tmp_path / "t.csv")
    assert found.height.shape == (Z_UM.size, 1)
    np.testing.assert_allclose(found.height[:, 0], 1e-6 * Z_UM, atol=2e-13)
    assert found.step_x_m == pytest.approx(1e-6 * STEP_UM)


@pytest.mark.parametrize("maker", MAPS)
def test_maps(tmp_path: Path, maker: str) -> None:
    (tmp_path / "t.txt").write_text(MAPS[maker], encoding="utf-8")
    found = read_surface(tmp_path / "t.txt")
    np.testing.assert_allclose(found.height, 1e-6 * MAP_UM.T, atol=2e-13)
    assert (found.step_x_m, found.step_y_m) == pytest.approx((1e-6 * STEP_UM, 1e-6 * STEP_UM))


def test_japanese_headings_in_their_own_encoding(tmp_path: Path) -> None:
    for maker in ("kosaka", "tokyo-seimitsu", "mitutoyo-japanese"):
        text = PROFILES[maker].replace("\u00b5", "\u03bc").replace("測定条件", "高さデータ")
        (tmp_path / "t.csv").write_bytes(text.encode("cp932"))
        found = read_surface(tmp_path / "t.csv")
        np.testing.assert_allclose(found.height[:, 0], 1e-6 * Z_UM, atol=2e-13)
