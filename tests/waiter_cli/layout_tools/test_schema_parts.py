"""``waiter layout schema``: documents of their draft, and the line for editors."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.schemas import schema_faults
from waiter_cli.file_access.locate import find
from waiter_cli.layout_tools.generate import SIZES, UNSOLVABLE, generate_instance
from waiter_cli.layout_tools.layout_schema import layout_schema
from waiter_cli.layout_tools.scenario_schema import scenario_schema
from waiter_cli.layout_tools.schema_parts import MODELINE, list_of, object_of, whole

jsonschema = pytest.importorskip("jsonschema")


def test_both_are_schemas_of_their_draft() -> None:
    for schema in (layout_schema(), scenario_schema()):
        jsonschema.Draft202012Validator.check_schema(schema)
        assert schema["$schema"].endswith("2020-12/schema")
        json.dumps(schema)


@pytest.mark.parametrize("size", SIZES)
def test_generated_files_fit(size: str) -> None:
    for seed, reason in enumerate((None, *UNSOLVABLE)):
        if size == "XL" and seed > 1:
            continue
        layout, scenario = generate_instance(seed, size, bar=seed % 2 == 0, unsolvable=reason)
        assert schema_faults(layout_schema(), layout) == []
        assert schema_faults(scenario_schema(), scenario) == []


def test_the_command_prints_the_schema_and_the_line_for_editors(tmp_path: Path) -> None:
    ran = waiter("layout", "schema")
    assert ran.code == 0
    assert ran.json() == layout_schema()
    assert f"{MODELINE}layout.schema.json" in ran.err
    target = tmp_path / "s.json"
    ran = waiter("layout", "schema", "--scenario", "-o", str(target))
    assert (ran.code, ran.out) == (0, "")
    assert json.loads(target.read_text()) == scenario_schema()
    assert f"{MODELINE}s.json" in ran.err


def test_a_file_with_the_line_is_read_as_before(tmp_path: Path) -> None:
    with open(find("report", "layout"), encoding="utf-8") as file:
        text = f"{MODELINE}layout.schema.json\n" + file.read()
    assert waiter("layout", "check", "-", stdin=text).code == 0


@pytest.mark.parametrize(
    ("text", "fits"),
    [("a: [1, 2]", True), ("{}", False), ("a: [1, 1]", False), ("a: [0]", False), ("a: [4]", False),
     ("{a: [], b: 1}", False), ("a: 1", False), ("a: [one]", False)],
)  # fmt: skip
def test_a_mapping_of_a_list_of_numbers(text: str, fits: bool) -> None:
    schema = object_of({"a": list_of(whole(1, 3, "A number."))}, ("a",), required=("a",))
    assert bool(schema_faults(schema, text)) is not fits


def test_the_keys_are_those_of_the_reader() -> None:
    with pytest.raises(AssertionError, match="b"):
        object_of({"a": {}}, ("a", "b"))
