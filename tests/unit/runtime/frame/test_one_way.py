"""Libraries of protocols in which only one end speaks: a sensor that reports, a lamp that obeys."""

import importlib
from collections.abc import Iterator
from typing import Any

import pytest
from framegen.model import codec
from framegen.model.codec import NotAFrame
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import DEMO, data_of, files_of, imported, layout_of
from tests.lines.timed_line import client_of

WEATHER, LAMP = (data_of(DEMO.with_name(f"{name}.yaml")) for name in ("weather", "lamp"))
MODELS = {"weather": layout_of(WEATHER), "stage_lamp": layout_of(LAMP)}


@pytest.fixture(scope="module", autouse=True)
def libraries() -> Iterator[None]:
    """Return both libraries, imported under their own names."""
    with imported(files_of(WEATHER), files_of(LAMP)):
        yield


def lib(name: str, module: str = "") -> Any:
    return importlib.import_module(f"{name}.{module}" if module else name)


def public(kind: type) -> set[str]:
    return {name for name in vars(kind) if not name.startswith("_")}


def test_the_client_of_a_sensor_has_no_methods_and_its_device_no_handlers() -> None:
    weather = lib("weather")
    assert public(weather.Controller) == public(weather.AsyncController) == set()
    assert not [name for name in public(weather.Device) if name.startswith("on_")]
    assert "sends nothing, and listens" in " ".join(weather.Controller.__doc__.split())


# ------------------------------------------------------------------ a sensor that only reports
def test_what_a_sensor_sends_its_client_receives() -> None:
    weather = lib("weather")
    gale, gusts = weather.WindMeasured(speed=200, bearing=0), weather.GustsMeasured([210, 250])
    mast = weather.Device()
    with client_of(mast) as logger:
        noted: list[Any] = []
        logger.on_report(noted.append)
        mast.send(gale)
        mast.send(gusts)
        assert logger.wait_for(weather.GustsMeasured, timeout=1) == gusts
        mast.send(gale)
        assert logger.wait_for(weather.WindMeasured, timeout=1, bearing=0) == gale
        assert [*logger.reports(timeout=1)] == noted == [gale, gusts, gale]
        with pytest.raises(weather.NoReportError, match=r"no GustsMeasured\(\) came within 1"):
            logger.wait_for(weather.GustsMeasured, timeout=1)


# ------------------------------------------------------------------ the direction of nobody

SILENT = {"weather": "logger_to_mast", "stage_lamp": "lamp_to_desk"}


@pytest.mark.parametrize("name", SILENT)
def test_both_directions_exist_and_the_silent_one_has_no_strategy(name: str) -> None:
    direction = lib(name).Direction
    assert [way.value for way in direction] == [way.key for way in MODELS[name].roles.directions]
    silent = direction(SILENT[name])
    with pytest.raises(ValueError, match=f"no message goes in the direction {silent}"):
        lib(name, "strategies").messages(silent)


@pytest.mark.parametrize("name", SILENT)
@given(st.data())
def test_everything_in_the_silent_direction_is_noise(name: str, data: st.DataObject) -> None:
    library_ = lib(name)
    silent = library_.Direction(SILENT[name])
    frame = data.draw(lib(name, "strategies").messages().map(lambda each: each.encode()))
    stream = data.draw(st.binary(max_size=8)) + frame + data.draw(st.binary(max_size=8))
    decoder = library_.StreamDecoder(silent)
    events = [*decoder.feed(stream), *decoder.flush()]
    assert all(isinstance(event, library_.Noise) for event in events)
    assert b"".join(event.data for event in events) == stream
    for bytes_ in (stream, frame, frame[:-1]):
        [way] = [way for way in MODELS[name].roles.directions if way.key == SILENT[name]]
        with pytest.raises(NotAFrame) as there:
            codec.decode(MODELS[name], way, bytes_)
        with pytest.raises(library_.DecodeError) as here:
            library_.decode(bytes_, silent)
        assert (here.value.reason.value, here.value.offset) == (
            there.value.reason,
            there.value.offset,
        )
