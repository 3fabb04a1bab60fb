"""What a template has no words for is told with its place, and only where it has a slot for it."""

from __future__ import annotations

import pytest

import waiter_cli
from sparc.source import Source
from waiter_cli.encoding.domains import find_domain
from waiter_cli.encoding.house_words import require_house_words
from waiter_cli.encoding.template import slot_names
from waiter_cli.errors import InputError

REPORT = waiter_cli.read_layout("report")
EMPTY = Source("t.sparc", "sorts\nrules\n% iswaiting(x) has_entered(x)\n")


@pytest.mark.parametrize(
    ("seen", "slots", "said"),
    [
        ("enter: [ada]", ("observations",), "enter in observe"),
        ("bill: table1", ("observations", "state"), "bill in observe"),
        ("enter: [ada]", ("goals",), None),
        ("enter: [ada]", (), None),
    ],
)
def test_only_what_has_a_slot_needs_a_word(
    seen: str, slots: tuple[str, ...], said: str | None
) -> None:
    problem = waiter_cli.pose_problem(REPORT, seen=[seen])
    if said is None:
        require_house_words(EMPTY, slots, problem)
        return
    with pytest.raises(InputError, match=f"no word for {said}"):
        require_house_words(EMPTY, slots, problem)


def test_the_restaurant_has_all_words() -> None:
    template = find_domain("restaurant").template
    for name in ("lunch", "b1", "b3"):
        problem = waiter_cli.pose_problem(*waiter_cli.read_scenario(name))
        require_house_words(template, slot_names(template), problem)
