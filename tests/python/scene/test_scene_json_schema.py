"""The JSON Schema of scene files has the core's bounds in the file's units, and all data for a form."""

import json
import math

from punctura._core import scene_keys
from punctura.files.units import split_key
from punctura.scene import ServoSettings, scene_json_schema

TABLES = {
    "needle": "NeedleTable", "coupling": "CouplingTable", "servo": "ServoTable", "display": "DisplayTable",
    "syringe": "SyringeTable", "membrane": "MembraneTable",
}  # fmt: skip


def properties(table):
    return scene_json_schema()["$defs"][table]["properties"]


def test_the_schema_is_json():
    assert json.loads(json.dumps(scene_json_schema())) == scene_json_schema()


def test_unknown_keys_are_forbidden_everywhere():
    schema = scene_json_schema()
    assert all(table["additionalProperties"] is False for table in [schema, *schema["$defs"].values()])


def test_every_key_has_title_help_and_type():
    for table in TABLES.values():
        for key, entry in properties(table).items():
            assert entry["title"] and entry["description"] and (entry.get("type") or entry["anyOf"]), key


def test_every_number_of_the_core_is_in_the_schema_with_its_bounds_in_its_unit():
    seen = 0
    for key in scene_keys():
        if key.kind not in ("number", "number_or_word", "column"):
            continue
        seen += 1
        entry = properties(TABLES[key.table])[key.key]
        scale = float(split_key(key.key)[1].si)
        number = entry["anyOf"][0] if "anyOf" in entry else entry.get("items", entry)
        if math.isfinite(key.min):
            assert math.isclose(number["exclusiveMinimum" if key.min_open else "minimum"] * scale, key.min)
        if math.isfinite(key.max):
            assert math.isclose(number["exclusiveMaximum" if key.max_open else "maximum"] * scale, key.max)
        assert entry["x-reason"] == key.reason
    assert seen == 39


def test_the_tip_angle_in_degrees_stays_below_90():
    assert properties("NeedleTable")["tip_angle_deg"]["exclusiveMaximum"] == 90
    assert properties("NeedleTable")["tip_angle_deg"]["x-unit"] == "deg"


def test_defaults_are_those_of_the_core():
    servo, defaults = properties("ServoTable"), ServoSettings()
    assert servo["rate_hz"]["default"] == defaults.rate
    assert servo["low_pass_hz"]["default"] == defaults.low_pass
    assert servo["solver"]["default"] == defaults.solver
    assert servo["conditioning"]["default"] == defaults.conditioning
    assert servo["conditioning"]["enum"] == ["low_pass", "line_fit"]
    assert math.isclose(servo["encoder_step_mm"]["default"] * 1e-3, defaults.encoder_step)


def test_of_two_ways_to_say_a_thing_exactly_one_is_asked_for():
    pairs = [{key for way in both["oneOf"] for key in way["required"]} for both in
             scene_json_schema()["$defs"]["NeedleTable"]["allOf"]]  # fmt: skip
    assert pairs == [{"diameter_mm", "gauge"}, {"tip_angle_rad", "tip_angle_deg"}]
    assert properties("NeedleTable")["gauge"]["enum"] == list(range(10, 35))


def test_units_and_symbols_are_named():
    membrane = properties("MembraneTable")
    assert (membrane["stiffness_N_per_mm"]["x-unit"], membrane["stiffness_N_per_mm"]["x-symbol"]) == ("N/mm", "kappa")
    assert membrane["friction"]["x-symbol"] == "mu" and "x-unit" not in membrane["friction"]


def test_a_gauge_says_what_it_is_in_mm():
    gauge = properties("NeedleTable")["gauge"]
    assert dict(zip(gauge["enum"], gauge["x-diameters-mm"], strict=True))[21] == 0.8
