"""Input files that commands refuse, by the rules of the programs."""

import json
from pathlib import Path

import numpy as np
import pytest

from ehlwave.cli import main
from ehlwave.contact.file_keys import keys_of_file
from ehlwave.errors import ArgumentError, SurfaceError
from ehlwave.inputs.namelist import read_namelist
from ehlwave.traction import read_keys

CONDITIONS = (
    b"&conditions radius_x_m=0.0127, radius_y_m=0.0127, reduced_modulus_pa=2.26e11, load_n=40,\n"
    b"mean_speed_m_per_s=4, viscosity_pa_s=0.05 /\n"
)
OPEN = CONDITIONS.replace(b" /", b"")
OIL = b"&lubricant pressure_viscosity_per_pa = 1.8e-8 /\n"

REFUSED = [
    (OPEN + OIL, "3: group &conditions of line 1 is not closed: put '/'"),
    (CONDITIONS + OIL + OIL, "4: group &lubricant is given twice .first on line 3.: put all its"),
    (OPEN + b", LOAD_N = 50 /", "3: key 'load_n' is given twice .first on line 1.: remove one"),
    (OPEN + b", slip_parameter = 1/2 /", "3: '/' ends a group: .* write fractions as decimal"),
    (OPEN + b", slip_parameter = nan /", "3: key 'slip_parameter' in &conditions: 'nan' does not"),
    (OPEN + b", slip_parameter = 1, 2 /", "3: key 'slip_parameter' in &conditions: 2 values"),
    (OPEN + b", slip_parameter = '1' /", "'1' in quotes is text: write a number such as 1.5"),
    (OPEN + b", slip_parameter = 1e400 /", "1e400 is too large: write a number below 1e308"),
    (OPEN + b", slip_parameter(1) = 1 /", "array elements are not accepted"),
    (CONDITIONS + b"&grid cells_x = 64.0 /", "'64.0' does not fit: write a whole number such as 4"),
    (CONDITIONS + b"&grid edges = 'open' /", "'open' is not one of the choices: write one of 'flo"),
    (CONDITIONS + b"&grid edges = flooded /", "flooded is not in quotes: write 'flooded'"),
    (CONDITIONS + b"&output fields = 1 /", "'1' does not fit: write true or false"),
    (CONDITIONS + b"&grid load_n = 3 /", "3: unknown key 'load_n' in &grid: it belongs to &condit"),
    (b"", "is empty"),
    (b"load_n = 3", "1: 'load_n' stands outside a group"),
    (CONDITIONS + b"\0", "holds zero bytes"),
]


@pytest.mark.parametrize(("text", "said"), REFUSED)
def test_commands_refuse_what_the_programs_refuse(tmp_path: Path, text: bytes, said: str) -> None:
    path = tmp_path / "c.nml"
    path.write_bytes(text)
    with pytest.raises(SurfaceError, match=said):
        keys_of_file(path)
    with pytest.raises(ArgumentError, match=said):
        read_keys(path)


@pytest.mark.parametrize(
    "text",
    [
        b"\xef\xbb\xbf" + CONDITIONS,
        b"! oil at 40 \xb0C\n" + CONDITIONS,
        CONDITIONS.replace(b"\n", b"\r\n").replace(b"0.0127", b"1.27d-2"),
        OPEN.replace(b",", b"\t") + b"! no / here\n/",
    ],
)
def test_odd_files_have_the_same_values(tmp_path: Path, text: bytes) -> None:
    plain, odd = tmp_path / "plain.nml", tmp_path / "odd.nml"
    plain.write_bytes(CONDITIONS)
    odd.write_bytes(text)
    assert keys_of_file(odd) == keys_of_file(plain) == read_keys(odd)


def test_a_command_names_line_and_change(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    x = np.arange(0, 2, 0.002)
    trace = np.column_stack([x, 0.05 * np.cos(20 * np.pi * x)])
    np.savetxt(tmp_path / "t.csv", trace, delimiter=",")
    path = tmp_path / "c.nml"
    words = ["lambda", str(tmp_path / "t.csv"), "--length-unit", "mm", "--height-unit", "um"]
    path.write_bytes(OPEN + OIL)
    assert main([*words, "--conditions", str(path)]) == 2
    assert "c.nml:3: group &conditions of line 1 is not closed" in capsys.readouterr().err
    path.write_bytes(b"\xef\xbb\xbf! 40 \xb0C\n" + CONDITIONS + OIL)
    assert main([*words, "--conditions", str(path), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["conditions"]


def test_large_files_take_linear_time(tmp_path: Path) -> None:
    path = tmp_path / "large.nml"
    path.write_bytes(CONDITIONS + b"! " + b"x / & '" * 200_000 + b"\n&a x = '" + b"''" * 500_000)
    with pytest.raises(SurfaceError, match="4: quote without its partner"):
        read_namelist(path)
