"""Options given more often than they can be meant: refused in words, by every command alike."""

from __future__ import annotations

from typing import Any

import pytest

from sparc.__main__ import main as sparc_main
from tests.support.cli import waiter
from tests.support.helps import command_tree

TREE = {words: tree for words, tree in command_tree().items() if not hasattr(tree, "commands")}


def value_of(option: Any) -> str:
    """A value that the option takes."""
    choices = getattr(option.type, "choices", None)
    if choices:
        return str(next(iter(choices)))
    least = getattr(option.type, "min", None)
    if least is not None:
        return str(least)
    return "1" if option.type.name in ("integer", "float") else "x"


def options(words: str) -> list[Any]:
    return [p for p in TREE[words].params if p.param_type_name == "option"]


@pytest.mark.parametrize("words", sorted(TREE))
def test_one_value_is_given_once(words: str) -> None:
    for option in options(words):
        if option.is_flag or option.multiple:
            continue
        for first in option.opts:
            given = (first, value_of(option), option.opts[-1], value_of(option))
            ran = waiter(*words.split(), *given)
            assert ran.code == 2 and ran.out == "", given
            assert "is given twice\n  hint: give it once" in ran.err, (given, ran.err)


@pytest.mark.parametrize("words", sorted(TREE))
def test_a_switch_is_not_said_with_its_opposite(words: str) -> None:
    for option in options(words):
        if option.secondary_opts:
            ran = waiter(*words.split(), option.secondary_opts[0], option.opts[0])
            assert ran.code == 2 and "exclude each other" in ran.err


def test_switches_and_lists_may_be_given_again() -> None:
    ran = waiter("plan", "-l", "report", "--enter", "1", "--enter", "2", "--json", "--json")
    assert ran.code == 0 and len(ran.json()["initial_state"]["waiting"]) == 2


def test_every_repetition_is_told_and_json_has_them() -> None:
    scenarios = ("-s", "b1", "-s", "b2", "--scenario", "b3")
    ran = waiter("plan", *scenarios, "--json", "--max-steps", "3", "--max-steps", "4")
    assert ran.code == 2
    assert [fault["message"] for fault in ran.json()["errors"]] == [
        "--scenario is given three times",
        "--max-steps is given twice",
    ]


def test_help_comes_first() -> None:
    ran = waiter("plan", "-s", "b1", "-s", "b2", "--help")
    assert ran.code == 0 and ran.out.startswith("Usage: waiter plan")


@pytest.mark.parametrize(
    "given", ["-n 1 -n 2", "--query p(a) --query q(a)", "--show ast --show asp"]
)
def test_the_tool_chain_by_itself(given: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        sparc_main(["-", *given.split()])
    assert ended.value.code == 2
    assert f"{given.split()[0]} is given again; give it once" in capsys.readouterr().err
