"""``%@`` lines of a domain: how its actions look, and whether it is monotone."""

from __future__ import annotations

import pytest

from sparc.source import Source
from waiter_cli.encoding.declarations import (
    SECONDS,
    ActionLooks,
    declarations_of,
    place_of,
    require_places,
    words_for,
)
from waiter_cli.encoding.domains import Domain, find_domain
from waiter_cli.errors import InputError, Where
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.model.plan import Action
from waiter_cli.model.state import State

CLEAN = Action(0, "clean", ("agent", "table1"))


def domain(*lines: str) -> Domain:
    text = "\n".join([*lines, "sorts #action = clean(#agent, #table) + wash(#agent)."])
    return Domain("own", Source("own.sparc", text), built_in=False)


def test_all_parts_of_an_action() -> None:
    found = declarations_of(domain('%@ clean(agent,T): "wipe {T}" at T for 4.5 s as "wiping {T}"'))
    assert found.deed(CLEAN) == ActionLooks(
        "clean", ("agent", "T"), "wipe {T}", "T", 4.5, "wiping {T}"
    )
    assert not found.monotone


def test_defaults() -> None:
    own = domain('%@ clean(agent,T): "wipe"', "%@ monotone")
    deed = declarations_of(own).deed(CLEAN)
    assert deed is not None and (deed.place, deed.seconds, deed.caption) == (None, SECONDS, None)
    assert declarations_of(own).monotone
    assert declarations_of(own).deed(Action(0, "wash", ("agent",))) is None
    assert declarations_of(find_domain("restaurant")).deeds == ()


def test_words_and_places() -> None:
    report = read_layout_file("report")
    own = domain('%@ clean(agent,T): "wipe {T}" at T as "wiping {T}"')
    assert words_for(own, CLEAN, State("n1")) == "wipe table1"
    assert words_for(own, CLEAN, State("n1"), caption=True) == "wiping table1"
    assert words_for(own, Action(0, "go_to", ("agent", "n2")), State("n1")) == "walk from n1 to n2"
    assert words_for(domain(), Action(0, "wash_up", ("agent", "table1")), State("n1")) == (
        "wash up table1"
    )
    assert place_of(own, CLEAN, report) == place_of(domain(), CLEAN, report) == "table1"
    assert place_of(own, Action(0, "wash", ("agent",)), report) is None


@pytest.mark.parametrize(
    ("line", "column", "said", "hint"),
    [
        ("%@ monoton", 4, "unknown declaration monoton", "did you mean monotone?"),
        ("%@", 3, "this declares nothing", "%@ clean(agent,T)"),
        ("%@ clean(agent,T) wipe", 4, "this declares nothing", "%@ clean(agent,T)"),
        ("%@ clean(agent,T): wipe", 20, "clean has no words", "give them in quotes"),
        ('%@ cleen(agent,T): "w"', 4, "the domain has no action cleen", "did you mean clean?"),
        ('%@ clean(agent,T): "w {Q}"', 4, "clean has no parameter Q", "known: T, agent"),
        ('%@ clean(agent,T): "w" at Q', 4, "clean has no parameter Q", "known: T, agent"),
        ('%@ clean(T,T): "w"', 4, "clean has two parameters T", "a name of its own"),
        ('%@ clean(agent,T): "w {T"', 23, "a brace { stands alone", "such as {T}"),
        ('%@ clean(agent,T): "w" as "{T} }"', 32, "a brace } stands alone", "such as {T}"),
        ('%@ clean(agent,T): "w" for 0 s', 28, "it cannot take 0 s", "above 0"),
        ('%@ clean(agent,T): "w" for x s', 28, "it cannot take x s", "above 0"),
        ('%@ clean(agent,T): "w" for 3 s at T', 32, "at T is not understood", "in this order"),
    ],
)
def test_every_fault_has_its_place_and_mend(line: str, column: int, said: str, hint: str) -> None:
    with pytest.raises(InputError) as raised:
        declarations_of(domain(line))
    (fault,) = raised.value.faults
    assert fault.where == Where("own.sparc", 1, column)
    assert said in fault.message and hint in (fault.hint or "")


def test_an_action_is_declared_once() -> None:
    with pytest.raises(InputError, match="clean is declared twice"):
        declarations_of(domain('%@ clean(agent,T): "a"', '%@ clean(agent,T): "b"'))


@pytest.mark.parametrize(
    ("sorts", "line", "hint"),
    [
        ("#deed = go(#node(X), #node(Y)) : X != Y. #n = 0..4.", "go(M)", "go(#node, #node)"),
        ("#deed = {wait, nod}.", "wait(T)", "it is wait"),
        ("#deed = #one + #two. #one = a(#n). #two = b(#n) + c(#n, #n).", "c(X)", "c(#n, #n)"),
        ("#deed = a(#n). #fluent = lit(#n).", "lit(X)", "known: a"),
        ("#deed = a(#n).", "a", "it is a(#n)"),
    ],
)
def test_looks_fit_an_action_that_can_occur(sorts: str, line: str, hint: str) -> None:
    text = f'%@ {line}: "w"\nsorts {sorts} predicates occurs(#deed, #step). rules'
    with pytest.raises(InputError) as raised:
        declarations_of(Domain("own", Source("own.sparc", text), built_in=False))
    (fault,) = raised.value.faults
    assert fault.where == Where("own.sparc", 1, 4) and hint in (fault.hint or "")
    fit = {"go(M)": "go(M,N)", "wait(T)": "wait", "c(X)": "c(X,Y)", "lit(X)": "a(X)", "a": "a(X)"}
    right = Source("own.sparc", text.replace(line, fit[line], 1))
    assert len(declarations_of(Domain("own", right, built_in=False)).deeds) == 1


@pytest.mark.parametrize(
    ("line", "column", "hint"),
    [
        ('%@ clean(agent,T): "w" at tabel1 for 2 s', 27, "did you mean table1?"),
        ('%@ clean(agent,T): "w"  at oven', 28, "known: "),
        ('%@ clean(agent,T): "w" at agnet', 27, "did you mean agent?"),
    ],
)
def test_a_fixed_place_is_one_of_the_layout(line: str, column: int, hint: str) -> None:
    report = read_layout_file("report")
    with pytest.raises(InputError) as raised:
        require_places(domain(line).template, report)
    (fault,) = raised.value.faults
    assert fault.where == Where("own.sparc", 1, column)
    assert "which is no table or node of report" in fault.message and hint in (fault.hint or "")
    for place in ("table1", "n3", "T", "agent"):
        require_places(domain(f'%@ clean(agent,T): "w" at {place}').template, report)
