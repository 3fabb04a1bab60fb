"""What became of a run in words: differences of states, observations, what the robot says."""

from __future__ import annotations

from dataclasses import replace

import pytest

from waiter_cli.model.plan import Action
from waiter_cli.model.state import Observation, State
from waiter_cli.simulation.outcome import differences, sentence, told, words


def test_states_differ_in_what_is_named() -> None:
    state = State(agent="n1", paid=frozenset({"table2", "table1"}))
    assert differences(state, state) == ""
    other = replace(state, agent="n2", paid=frozenset({"table1"}))
    assert differences(state, other) == (
        "agent is n1, not n2; paid is ['table1', 'table2'], not ['table1']"
    )


@pytest.mark.parametrize(
    ("seen", "event", "text"),
    [
        (("enter", "c1", "c2"), {"party": ["c1", "c2"]}, "a party of 2 came in"),
        (("leave", "c1"), {"party": ["c1"]}, "the party of c1 left"),
        (("at", "anna", "n3"), {"who": "anna", "node": "n3"}, "anna is at n3"),
        (("bill", "table1"), {"table": "table1"}, "table1 wants its bill"),
        (("ready", "table1", "plate"), {"table": "table1", "object": "plate"},
         "the plate for table1 is ready"),
    ],
)  # fmt: skip
def test_an_observation_as_an_event_and_a_sentence(
    seen: tuple[str, ...], event: dict[str, object], text: str
) -> None:
    found = Observation(seen[0], seen[1:])
    assert told(found) == {"kind": seen[0], **event}
    assert sentence(found) == text


def test_the_robot_names_what_it_acts_on() -> None:
    assert words(Action(0, "bring", ("agent", "jug", "table3"))) == "the jug, enjoy!"
    assert words(Action(0, "take_up", ("agent", "jug", "table3"))) == "the jug for table3"
    assert words(Action(0, "bring_chairs", ("agent", "table3", "2"))) == "more chairs for table3"
