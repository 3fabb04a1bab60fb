"""Files of cases: what they mean, and every mistake told with its place."""

from __future__ import annotations

import random

import pytest

from sparc.errors import SourceError, SourceErrors
from sparc.source import Source
from tests.support.domain_cases import LAYOUT, domain, restaurant_verdicts
from waiter_cli.domain_tests.case_reader import read_cases
from waiter_cli.domain_tests.verdicts import run_cases
from waiter_cli.errors import InputError

FIRST = LAYOUT.count("\n") + 1  # the line on which the cases begin


def red(cases: str) -> list[str]:
    """The messages of the failures, each with what is so instead."""
    return [
        failure.message + (f" | {failure.instead}" if failure.instead else "")
        for verdict in restaurant_verdicts(cases)
        for failure in verdict.failures
    ]


def faults(cases: str) -> list[str]:
    """Each fault with its line, counted from the cases on, and its column."""
    with pytest.raises(InputError) as caught:
        restaurant_verdicts(cases)
    found = []
    for fault in caught.value.faults:
        assert fault.where is not None and fault.where.name == "mine.yaml"
        line = fault.where.line - FIRST + 1
        found.append(f"{line}:{fault.where.column}: {fault.message}; {fault.hint}")
    return found


# ------------------------------------------------------------ what a case means


GREEN = {
    "commas inside parentheses keep an item together": """
- {name: a, when: [go_to(agent, n3)], then: [holds(currentlocation(agent, n3), 1), near(table1, 1)]}
""",
    "a list may be written line by line, with or without quotes": """
- name: a
  when:
    - go_to(agent, n3)
  then:
    - holds(currentlocation(agent, n3), 1)
    - "-holds(currentlocation(agent, n2), 1)."
""",
    "a single text is a list of one": """
- {name: a, when: nothing, then: "holds(currentlocation(agent, n2), 1)"}
""",
    "arithmetic is worked out": """
- {name: a, when: nothing, then: ["holds(currentlocation(agent, n2), 2-1)"]}
""",
    "a variable under never stands for every value": """
- {name: a, never: ["occurs(pick(agent, C), 0)", "holds(isattable(C, C), 0)"]}
""",
    "a fact may be a rule": """
- name: a
  given: {facts: ["holds(wantsbill(T), 0) :- #table(T)"]}
  then: ["holds(wantsbill(table1), 0)"]
""",
    "free to choose at two steps": """
- {name: a, steps: 2, some: ["occurs(go_to(agent, n1), 1)", "occurs(go_to(agent, n2), 1)"], exactly: 7}
""",
    "a case has a layout of its own": """
- name: a
  layout: {nodes: [x], edges: [], entrance: x, tables: {t: {capacity: 1, nodes: [x]}}, agent: x}
  then: [near(t, 0)]
- name: b
  layout: report
  then: ["entrance(n5)"]
""",
    "cases do not hear of each other": """
- {name: a, given: {state: {waiting: [[c1]]}}, then: ["holds(iswaiting(c1), 0)"]}
- {name: b, given: {state: {agent: n1}}, never: ["holds(iswaiting(C), 0)"]}
- {name: c, given: {facts: ["holds(wantsbill(table1), 0)"]}, then: ["holds(wantsbill(table1), 1)"]}
- {name: d, never: ["holds(wantsbill(T), 0)", "holds(currentlocation(agent, n1), 0)"]}
""",
}


@pytest.mark.parametrize("cases", GREEN.values(), ids=GREEN.keys())
def test_green(cases: str) -> None:
    assert red(cases) == []


RED = {
    "then does not hold": (
        "{name: a, when: [go_to(agent, n3)], then: [holds(currentlocation(agent, n1), 1)]}",
        "holds(currentlocation(agent, n1), 1) does not hold"
        " | instead: holds(currentlocation(agent, n3), 1)",
    ),
    "the contrary holds": (
        "{name: a, when: [go_to(agent, n3)], then: [holds(currentlocation(agent, n2), 1)]}",
        "holds(currentlocation(agent, n2), 1) does not hold"
        " | instead: -holds(currentlocation(agent, n2), 1)",
    ),
    "then holds in some answer sets only": (
        "{name: a, then: [holds(currentlocation(agent, n3), 1)]}",
        "holds(currentlocation(agent, n3), 1) does not hold",
    ),
    "never holds": (
        "{name: a, when: nothing, never: ['holds(currentlocation(agent, N), 1)']}",
        "holds(currentlocation(agent, n2), 1) holds",
    ),
    "some holds in none": (
        "{name: a, some: ['occurs(give_bill(agent, table1), 0)']}",
        "occurs(give_bill(agent, table1), 0) holds in no answer set",
    ),
    "too many answer sets": (
        "{name: a, exactly: 2}",
        "there are more than 2, not exactly 2 answer sets",
    ),
    "too few answer sets": (
        "{name: a, exactly: 9}",
        "there are 3, not exactly 9 answer sets",
    ),
    "what occurs cannot": (
        "{name: a, when: [go_to(agent, n3), go_to(agent, n1)], then: [success]}",
        "go_to(agent, n1) is impossible at step 1 | possible then: go_to(agent, n2)",
    ),
    "what is given cannot be": (
        "{name: a, given: {facts: ['taken(n2, 0)']}, when: nothing, then: [success]}",
        "what is given has no answer set at all | without its facts it has one",
    ),
    "goals that are too far away": (
        "{name: a, given: {state: {agent: n1}, goals: [{at: n3}]}, then: [success]}",
        "what is given has no answer set at all | its goals may be out of reach in 1 step",
    ),
    "the impossible is possible": (
        "{name: a, when: [go_to(agent, n3)], impossible: true}",
        "impossible, but there is an answer set: it can happen",
    ),
    "the impossible facts are possible": (
        "{name: a, given: {facts: ['holds(wantsbill(table1), 0)']}, impossible: true}",
        "impossible, but there is an answer set: the facts hold together",
    ),
    "impossible for the wrong reason: the step before": (
        "{name: a, when: [go_to(agent, n2), go_to(agent, n3)], impossible: true}",
        "it is impossible already before its last step",
    ),
    "impossible for the wrong reason: the state": (
        "{name: a, given: {facts: ['taken(n2, 0)']}, when: [go_to(agent, n3)], impossible: true}",
        "it is impossible already whatever is done",
    ),
    "impossible for the wrong reason: without the facts": (
        "{name: a, given: {goals: [{seated: {party: c1, table: table1}}], state: {waiting: [[c1]]},"
        " facts: ['holds(isattable(c1, table1), 0)']}, impossible: true}",
        "it is impossible already without its facts",
    ),
}


@pytest.mark.parametrize(("case", "said"), RED.values(), ids=RED.keys())
def test_red(case: str, said: str) -> None:
    (message,) = red(f"- {case}")
    assert message.startswith(said)


# ------------------------------------------------------------ mistakes


WRONG = {
    "a literal of no predicate": (
        "- {name: a, then: [success, 'hold(isfree(table1), 0)']}",
        "1:30: unknown predicate hold",
    ),
    "a name outside of its sort": (
        "- {name: a, then: ['holds(isfree(tabel1), 0)']}",
        "1:21: isfree(tabel1) is not in sort #fluent (argument 1 of holds); did you mean table1?",
    ),
    "a step after the last": (
        "- {name: a, never: ['holds(isfree(table1), 2)']}",
        "1:22: 2 is not in sort #step",
    ),
    "an action of no such kind": ("- {name: a, when: ['go_to(agent)'], then: [success]}", "1:21: "),
    "an action that is misspelt": (
        "- {name: a, when: ['goto(agent, n3)'], then: [success]}",
        "1:21: goto(agent,n3) is not in sort #action (argument 1 of occurs); did you mean go_to?",
    ),
    "an action that is no term": ("- {name: a, when: ['go_to('], then: [success]}", "1:2"),
    "no literal at all": ("- {name: a, then: ['p, q']}", "1:21: this must be one literal"),
    "a variable under then": (
        "- {name: a, then: ['holds(isfree(T), 0)']}",
        "1:21: a variable stands here; name one literal",
    ),
    "a case that expects nothing": (
        "- {name: a, when: nothing}",
        "1:3: a case that expects nothing",
    ),
    "a misspelt key": (
        "- {name: a, than: [success]}",
        "1:13: unknown key than in a case; did you mean then?",
    ),
    "a misspelt key of given": (
        "- {name: a, given: {sate: {}}, then: [success]}",
        "1:21: unknown key sate in given; did you mean state?",
    ),
    "an unknown node": (
        "- {name: a, given: {state: {agent: n9}}, then: [success]}",
        "1:36: unknown node n9",
    ),
    "a case without a name": ("- {then: [success]}", "1:3: a case without a name"),
    "two cases of one name": (
        "- {name: a, then: [success]}\n- {name: a, then: [success]}",
        "2:3: two cases are called a",
    ),
    "impossible and yet": (
        "- {name: a, when: nothing, impossible: true, then: [success]}",
        "1:40: impossible, and yet something follows",
    ),
    "nothing said to be impossible": (
        "- {name: a, impossible: true}",
        "1:3: nothing is said to be impossible",
    ),
    "steps beside when": (
        "- {name: a, when: nothing, steps: 2, then: [success]}",
        "1:35: when tells how many steps there are",
    ),
    "an unknown layout": (
        "- {name: a, layout: reprot, then: [success]}",
        "1:21: there is no layout reprot; did you mean report?",
    ),
    "an observation that cannot be": (
        "- {name: a, given: {observe: [{free: table1}], state: {seated: {table1: [c1]}}}, then: [success]}",
        "1:",
    ),
    "a list where a text stands": (
        "- {name: a, then: [[success]]}",
        "1:20: an item of then must be",
    ),
    "exactly none": (
        "- {name: a, exactly: 0}",
        "1:22: exactly, the number of answer sets, must be",
    ),
    "division by zero": ("- {name: a, then: ['holds(isfree(table1), 1/0)']}", "1:"),
}


@pytest.mark.parametrize(("cases", "said"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_told_with_its_place(cases: str, said: str) -> None:
    found = faults(cases)
    assert len(found) == 1
    assert found[0].startswith(said), found[0]


def test_all_mistakes_are_told_at_once() -> None:
    found = faults(
        "- {name: a, then: ['p(x)', 'q(x)']}\n- {name: b, when: ['fly(agent)'], then: [success]}"
    )
    assert [line.split(":")[0] for line in found] == ["1", "1", "2"]


@pytest.mark.parametrize(
    ("fact", "column"),
    [("holds(isfree(tabel1), 0)", 42), ("leader(c1) leader(c2)", None), (":-", None)],
)
def test_a_fact_that_is_wrong_is_told_with_its_place(fact: str, column: int | None) -> None:
    with pytest.raises((SourceError, SourceErrors)) as caught:
        restaurant_verdicts(f"- {{name: a, given: {{facts: ['{fact}']}}, then: [success]}}")
    error = caught.value
    span = (error.errors[0] if isinstance(error, SourceErrors) else error).span
    assert span is not None
    assert (span.location.name, span.location.line) == ("mine.yaml", FIRST)


# ------------------------------------------------------------ domains of other people


LAMP = """\
sorts
%{ steps
#step = 0..1.
%}
#fluent = {on}.
#action = {press}.
predicates
holds(#fluent, #step).
occurs(#action, #step).
rules
% Pressing the button lights the lamp, or puts it out.
holds(on, I+1) :- occurs(press, I), not holds(on, I).
-holds(on, I+1) :- occurs(press, I), holds(on, I).
holds(on, I+1) :- holds(on, I), not -holds(on, I+1).
{ occurs(A, I) } 1 :- #step(I).
"""


def test_a_domain_of_the_users_own_needs_no_restaurant() -> None:
    cases = read_cases(
        LAYOUT
        + """
- {name: lit, when: [press], then: ["holds(on, 1)"], never: ["holds(on, 0)"]}
- {name: out, when: [press, press, nothing], then: ["-holds(on, 2)"], never: ["holds(on, 3)"]}
- {name: stays, given: {facts: ["holds(on, 0)"]}, when: [nothing], then: ["holds(on, 1)"]}
""",
        "lamp.yaml",
    )
    assert [v.failures for v in run_cases(Source("lamp.sparc", LAMP), cases)] == [(), (), ()]
    broken = LAMP.replace("-holds(on, I+1) :- occurs(press, I), holds(on, I).\n", "")
    verdicts = run_cases(Source("lamp.sparc", broken), cases)
    assert [verdict.passed for verdict in verdicts] == [True, False, True]


def test_preferences_are_refused() -> None:
    cases = read_cases(LAYOUT + "- {name: a, then: ['holds(on, 0)']}", "lamp.yaml")
    with pytest.raises(InputError, match="preferences"):
        run_cases(Source("lamp.sparc", LAMP + ":~ occurs(press, I). [1:1]\n"), cases)


def test_the_built_in_cases_have_names_that_read_as_sentences() -> None:
    for name in ("restaurant", "report"):
        for case in domain(name)[1]:
            assert len(case.name.split()) >= 3 and not case.name.endswith("."), case.where


def test_spoilt_files_are_refused_or_judged_but_never_crash() -> None:
    """Pieces of a good file taken out, doubled or swapped: a fault, or a verdict."""
    good = LAYOUT + "\n".join(
        f"- {text}" for text in ("{name: z, when: [go_to(agent, n3)], then: [near(table1, 1)]}",)
    )
    template = domain("restaurant")[0]
    generator = random.Random(7)
    refused = judged = 0
    for _ in range(60):
        text = good
        for _ in range(generator.randint(1, 3)):
            at = generator.randrange(FIRST * 20, len(text))
            piece = generator.choice(
                ["", "(", ")", ",", "'", "X", "-", "1", ".", ": ", text[at:][:3]]
            )
            text = text[:at] + piece + text[at + generator.randint(0, 2) :]
        try:
            run_cases(template, read_cases(text, "mine.yaml"))
            judged += 1
        except (InputError, SourceError, SourceErrors):
            refused += 1
    assert refused and judged
