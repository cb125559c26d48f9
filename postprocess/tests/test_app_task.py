"""Answers of the page without the page: numbers, contacts, files, threads."""

import asyncio
import io
import json
import re
import threading
from pathlib import Path

import numpy as np
import pytest
from app_traces import examples
from contact import BALL

import ehlwave
from ehlwave.app import page, quantities
from ehlwave.app.contacts import Given, made, source
from ehlwave.app.messages import failure, plain
from ehlwave.app.quantities import in_si
from ehlwave.app.saving import document, script
from ehlwave.app.shown import change, compared, decided, headline, numbers, tables
from ehlwave.app.task import Task, answered
from ehlwave.app.uploads import LARGEST_BYTES, Upload, file_name, read_upload
from ehlwave.app.work import SMALL_BYTES, Pools
from ehlwave.contact.conditions_from_keys import KNOWN_KEYS
from ehlwave.errors import ResultsError, SurfaceError
from ehlwave.surface.read import ReadOptions


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("12.7", -3, 0.0127),
        ("226", 9, 2.26e11),
        ("22", -9, 2.2e-8),
        ("1.1e3", -6, 0.0011),
        ("60", None, 333.15),
        (" 7 ", 0, 7.0),
        ("12,7", -3, "12,7"),
        ("nan", -3, "nan"),
        ("-1e9999", 0, "-1e9999"),
        ("1e999999999999999999", 0, "1e999999999999999999"),
    ],
)
def test_units_lose_no_digit(text: str, unit: int | None, value: float | str) -> None:
    assert in_si(text, unit) == value


def test_every_field_has_a_key_a_label_and_an_example_that_is_a_number() -> None:
    found = [one for one in vars(quantities).values() if isinstance(one, quantities.Quantity)]
    assert len(found) > 10
    for one in found:
        assert one.key
        assert one.label
        if one.example:
            assert isinstance(in_si(one.example, next(iter(one.units.values()), 0)), float)


def test_bodies_and_oils_are_those_of_the_package() -> None:
    ball = {"material": "steel", "radius_x_m": 0.0127, "radius_y_m": 0.0127}
    sheet = {"iso_vg": 68.0, "temperature_k": 333.15, "kind": "mineral"}
    given = Given(
        {"load_n": 40.0, "speeds_m_per_s": (4.2, 3.8), "eyring_stress_pa": 5e6},
        (ball, {"material": "glass"}),
        sheet,
        "from_grade",
    )
    expected = ehlwave.Contact.from_bodies(
        ehlwave.Body(**ball),
        ehlwave.Body(material="glass"),
        oil=ehlwave.Oil.from_grade(**sheet),
        load_n=40,
        speeds_m_per_s=(4.2, 3.8),
        eyring_stress_pa=5e6,
    )
    assert made(given).film() == expected.film()
    names = {"ehlwave": ehlwave}
    exec(source(given), names)
    assert names["contact"].film() == expected.film()


def test_the_saved_script_and_document_repeat_the_film() -> None:
    oil = {"name": "heavy machine oil 153", "temperature_k": 323.15}
    keys = {key: value for key, value in BALL.items() if key != "viscosity_pa_s"}
    answer = answered(Task(Given(keys, oil=oil, maker="named")))
    names: dict[str, object] = {}
    exec(script(answer), names)
    assert names["film"] == answer.film
    saved = json.loads(document(answer))
    assert saved["film"]["central_m"] == answer.film.central_m
    assert saved["surface"] is None
    assert f"{answer.film.central_m * 1e6:.4g} um" in headline(answer)
    for name in ("Central", "Minimum film", "Friction coefficient", "0 in pure rolling"):
        assert name in numbers(answer)
    assert "Error of" not in numbers(answer)


def test_heat_and_starvation_are_answered() -> None:
    ball = {"material": "steel", "radius_x_m": 0.0127, "radius_y_m": 0.0127}
    sheet = {"iso_vg": 68.0, "temperature_k": 333.15, "kind": "mineral"}
    keys = {"load_n": 40.0, "speeds_m_per_s": (4.2, 3.8), "eyring_stress_pa": 5e6, "heat": True}
    warm = answered(Task(Given(keys, (ball, {"material": "steel"}), sheet, "from_grade")))
    names: dict[str, object] = {}
    exec(script(warm), names)
    assert names["film"] == warm.film
    assert warm.film.heated is not None
    assert "With heat" in numbers(warm)
    with_heat = [name for name, _ in tables(warm)["With heat"]]
    assert not [name for name in with_heat if "error" in name.lower()]
    assert json.loads(document(warm))["film"]["heated"]["friction"] == warm.film.heated.friction
    starved = answered(Task(Given(BALL | {"oil_over_flooded": 0.5})))
    assert starved.film == ehlwave.Contact(**BALL, oil_over_flooded=0.5).film()


def test_the_page_asks_for_all_that_contacts_are_given_by() -> None:
    every = [one for one in vars(quantities).values() if isinstance(one, quantities.Quantity)]
    every += [
        one for group in vars(quantities).values() if isinstance(group, tuple) for one in group
    ]
    asked = {one.key for one in every if isinstance(one, quantities.Quantity)}
    errors = {key for key in KNOWN_KEYS if key.endswith("_error")}
    other_words = {"central_film_m", "slip_parameter"} | errors
    assert set(KNOWN_KEYS) - asked == other_words


def test_messages_are_those_of_the_command_line_and_name_a_field() -> None:
    with pytest.raises(SurfaceError, match="load_n = '4O' is not a number") as caught:
        answered(Task(Given(BALL | {"load_n": "4O"})))
    said = failure(str(caught.value), [quantities.MODULUS, quantities.LOAD])
    assert "Field: Load" in said
    assert "load_n" not in said
    assert plain("give heat data (heat=)") == "choose 'with heat' under Film and friction"
    assert plain("DeepGrooveBallBearing: bore_m is 0") == "deep groove ball bearing: Bore d is 0"
    assert "<script>" not in failure("<script>alert(1)</script>", [])


def test_messages_have_the_units_of_the_page_and_no_python() -> None:
    fields = [quantities.RADIUS_X, quantities.VISCOSITY, quantities.TEMPERATURE, quantities.LOAD]
    alpha = next(one for one in quantities.OIL if one.key == "pressure_viscosity_per_pa")

    def said(**keys: float) -> str:
        with pytest.raises(ResultsError) as caught:
            ehlwave.Contact(**BALL | keys).film(by="laws")
        return failure(str(caught.value), [*fields, alpha])

    assert "Viscosity = 1e+06 mPa s: contacts have 0.01 to 20000 mPa s<" in said(viscosity_pa_s=1e3)
    text = said(pressure_viscosity_per_pa=5e-7)
    assert "Pressure coefficient = 500 1/GPa gives L" in text
    assert "(of 10 to 30 1/GPa)" in text
    assert "holds 10 to 29.9 1/GPa; or compute it with the program ehlwave-case" in text
    used = plain("A law is used when named: by='two-waves'.")
    assert used == "A law is used when chosen under Judged by."
    assert "Radius" not in said(load_n=1e9)
    assert "contacts have 1e-06 to 1e+08 N<" in said(load_n=1e9)
    warm = failure(
        "temperature_k = 60: did you mean 333.15 (60 C)? contacts have 200 to 600 K", fields
    )
    assert "= -213.15 C: contacts have -73.15 to 326.85 C<" in warm
    bodies = [quantities.body("12.7")[0], quantities.Quantity("radius_x_m", "Radius", "", {"m": 0})]
    assert "= 4 must" in failure("radius_x_m = 4 must be less", bodies)
    ball = {"radius_x_m": 0.0127, "radius_y_m": 0.0127}
    steel = ball | {"material": "steel"}
    own = ball | {"elastic_modulus_pa": 2e11, "poisson_ratio": 0.3}
    keys = {"load_n": 40.0, "mean_speed_m_per_s": 4.0, "heat": True}
    plain_oil = {"viscosity_pa_s": 0.05, "pressure_viscosity_per_pa": 2.2e-8}
    sheet = {"iso_vg": 68.0, "temperature_k": 333.15}
    for given, expected in (
        (Given(keys | plain_oil, (steel, steel)), "needs 'Grade or data sheet' or"),
        (Given(keys, (own, steel), sheet, "from_grade"), "needs a known material of body 1"),
    ):
        with pytest.raises(ResultsError) as caught:
            answered(Task(given))
        cold = plain(str(caught.value))
        assert expected in cold
        assert not re.search(r"ehlwave|=|\(\.", cold)
    need = plain("need speeds_m_per_s=(u1, u2), or compute it (ehlwave.Case, a harmonic table)")
    assert need == "need Surface speed, or compute it with the program ehlwave-case"


def test_the_answer_has_hertz_one_friction_and_a_variant_beside_it() -> None:
    oil = {"eyring_stress_pa": 5e6, "slide_to_roll_ratio": 0.1}
    first, second = (answered(Task(Given(BALL | oil | {"load_n": n}))) for n in (40, 80))
    contact = tables(first)["Contact"]
    assert [name for name, _ in contact] == [
        "Hertz pressure",
        "Semi-axis a, along rolling",
        "Semi-axis b, across",
        "M, L, D",
    ]
    film = dict(tables(first)["Smooth contact"])
    assert [name for name in film if "riction" in name] == ["Friction coefficient"]
    for name in ("Friction coefficient", "Central film", "Minimum film (Moes)"):
        assert " within " in film[name]
    both = compared(first, second)
    for answer in (first, second):
        for _, value in tables(answer)["Contact"]:
            assert value in both
    pressure = change(
        *(dict(tables(each)["Contact"])["Hertz pressure"] for each in (first, second))
    )
    assert pressure == "+26 %"  # 2^(1/3)
    assert f"<td>{pressure.replace(' ', '&nbsp;')}</td>" in both
    assert decided(first) == "neutral"


def test_names_of_files_cannot_lead_elsewhere() -> None:
    assert file_name("../../etc/passwd") == "passwd"
    assert file_name("C:\\data\\trace 1.csv") == "trace 1.csv"
    assert file_name("/") == file_name("..") == file_name("") == "trace"
    assert file_name(".ehlwave-results") == "ehlwave-results"
    assert "\n" not in file_name("a\nb.csv")
    assert "\0" not in file_name("a\0b.csv")
    assert len(file_name("long" * 500 + ".csv")) <= 100


def test_files_leave_nothing_behind_and_their_folder_is_not_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with pytest.raises(SurfaceError) as caught:
        read_upload(Upload("../bad.csv", b"no numbers at all"), ReadOptions())
    assert str(caught.value).startswith("bad.csv: ")
    assert str(tmp_path) not in str(caught.value)
    trace = np.column_stack([np.arange(100), np.sin(np.arange(100.0))])
    text = "x_um,z_nm\n" + "\n".join(f"{a},{b}" for a, b in trace)
    found = read_upload(Upload("trace.csv", text.encode()), ReadOptions())
    assert found.name == "trace.csv"
    assert list(tmp_path.iterdir()) == []


def test_what_is_too_large_is_refused_before_it_is_unpacked() -> None:
    with pytest.raises(SurfaceError, match=r"t\.csv: 16\.0 MB, more than the 16 MB"):
        read_upload(Upload("t.csv", bytes(LARGEST_BYTES + 1)), ReadOptions())
    packed = io.BytesIO()
    np.savez_compressed(packed, height=np.zeros((4000, 4000)))
    assert len(packed.getvalue()) < 1e6
    with pytest.raises(SurfaceError, match=r"z\.npz: unpacked 128\.0 MB"):
        read_upload(Upload("z.npz", packed.getvalue()), ReadOptions())
    plain = io.BytesIO()
    np.save(plain, np.zeros((1, 4_200_000), dtype=np.float16))
    options = ReadOptions(length_unit="um", height_unit="um", step=1.0)
    with pytest.raises(SurfaceError, match="4200000 points, more than"):
        read_upload(Upload("p.npy", plain.getvalue()), options)


def test_a_parted_file_above_the_limit_is_dropped_by_the_server() -> None:
    pytest.importorskip("panel", reason="the page needs Panel: pip install './postprocess[app]'")
    from panel.models.file_dropper import UploadEvent

    from ehlwave.app.widgets import FileField

    field = FileField()

    def part(number: int, size: int, name: str = "a.csv") -> None:
        data = {"name": name, "chunk": number, "total_chunks": 20, "type": "", "data": bytes(size)}
        field._process_event(UploadEvent(None, data))

    for number in range(1, 20):
        part(number, 10**6)
    assert field.refused.startswith("17.0 MB, more than the 16 MB")
    assert not field._file_buffer
    part(2, 10, "b.csv")  # no beginning
    assert not field._file_buffer
    for number in range(1, 21):
        part(number, 10, "c.csv")
    upload = field.upload()
    assert upload is not None
    assert (upload.name, len(upload.data), field.refused) == ("c.csv", 200, "")


def test_large_surfaces_do_not_keep_small_ones_waiting() -> None:
    pools, held = Pools(workers=1), threading.Event()
    try:
        slow = [pools.of(SMALL_BYTES + 1).submit(held.wait, 60) for _ in range(5)]
        assert pools.of(0).submit(lambda: 42).result(60) == 42
        assert not any(one.done() for one in slow)
    finally:
        held.set()
        pools.close()


def test_an_answer_that_takes_too_long_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    pools, held = Pools(workers=1), threading.Event()
    monkeypatch.setattr(page, "LONGEST_S", 0.1)
    monkeypatch.setattr(page, "answered", lambda task: held.wait(60))
    try:
        with pytest.raises(SurfaceError, match="no answer within"):
            asyncio.run(page.Page(pools)._worked(Task(Given(BALL | {"load_n": 40.0}), None)))
    finally:
        held.set()
        pools.close()


def test_sessions_in_threads_get_the_numbers_of_one_alone(tmp_path: Path) -> None:
    example = examples(tmp_path)[0]
    upload = Upload(example.path.name, example.path.read_bytes())
    tasks = [Task(Given(BALL | {"load_n": 40.0 + load}), upload) for load in range(3)]
    alone = [document(answered(task)) for task in tasks]
    pools = Pools(workers=4)
    try:
        together = list(pools.small.map(answered, tasks))
    finally:
        pools.close()
    assert [document(one) for one in together] == alone
    assert len(set(alone)) == len(alone)
    assert all(set(one.pictures) == set(together[0].pictures) for one in together)
