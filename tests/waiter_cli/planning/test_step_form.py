"""Which statements are about any step and the next, and what leaves the question open."""

from __future__ import annotations

import pytest

import sparc
from waiter_cli.planning.step_form import OpenQuestion, StepForm

HEADER = """\
sorts
#step = 0..5.
#thing = {a, b}.
#fluent = inertial(#thing) + defined(#thing).
#deed = do(#thing).
predicates
holds(#fluent, #step).
occurs(#deed, #step).
warm(#thing, #step).
wish(#thing).
success().
rules
"""


def form_of(*rules: str) -> tuple[StepForm, dict[str, str]]:
    """The form of a program, and its rules by their place in the text."""
    text = HEADER + "\n".join(rules) + "\n"
    form = StepForm(sparc.check(sparc.parse(text)))
    return form, {str(s.span): rule for s, rule in zip(form.typed.program.statements, rules)}


def left_out(*rules: str) -> list[str]:
    form, texts = form_of(*rules)
    return [rule for span, rule in texts.items() if span in set(map(str, form.left_out))]


def test_predicates_whose_last_sort_is_a_step_are_timed() -> None:
    form, _ = form_of("wish(a).")
    assert form.timed == {"holds", "occurs", "warm"}


def test_a_rule_from_a_step_to_the_next_carries_its_head_on() -> None:
    form, _ = form_of(
        "holds(inertial(T), I+1) :- occurs(do(T), I).",
        "warm(T, I+1) :- warm(T, I), not -warm(T, I+1).",
    )
    assert form.carried == {"holds", "warm"} and not form.left_out


def test_a_rule_about_one_step_carries_nothing_on() -> None:
    form, _ = form_of("warm(T, I) :- holds(inertial(T), I).")
    assert form.carried == {"holds"} and not form.left_out


def test_what_is_about_step_0_only_is_left_out_and_what_it_says_is_frozen() -> None:
    first, second = "holds(inertial(a), 0).", "wish(a) :- holds(inertial(a), 0)."
    assert left_out(first, second) == [first, second]
    form, _ = form_of(first, second)
    assert form.frozen == {"wish"}


def test_a_rule_without_steps_is_kept() -> None:
    assert left_out("wish(a).", "wish(b) :- wish(a).") == []


def test_what_is_said_of_the_whole_plan_is_left_out_with_what_it_demands() -> None:
    rule, demand = "success :- holds(inertial(a), I).", ":- not success."
    form, _ = form_of(rule, demand)
    assert form.about_plans == {"success"} and left_out(rule, demand) == [rule, demand]
    assert len(form.demands) == 1


@pytest.mark.parametrize(
    ("constraint", "kept"),
    [
        (":- holds(inertial(a), I), occurs(do(b), I).", True),
        (":- holds(inertial(a), I+1), occurs(do(b), I).", True),
        (":- holds(inertial(a), I+2), occurs(do(b), I).", False),
        (":- holds(inertial(a), 3).", False),
        (":- holds(inertial(a), I), occurs(do(b), J).", False),
        (":- holds(inertial(a), I), I > 2.", False),
        (":- #step(I), not holds(inertial(a), I).", True),
    ],
)
def test_constraints_of_time_are_left_out(constraint: str, kept: bool) -> None:
    assert left_out(constraint) == ([] if kept else [constraint])


@pytest.mark.parametrize(
    "rule",
    [
        "warm(a, 3).",
        "warm(T, I+2) :- holds(inertial(T), I).",
        "warm(T, I) :- holds(inertial(T), I+1).",
        "warm(T, I) :- holds(inertial(T), J), #step(I).",
        "warm(T, I) :- holds(inertial(T), I), I > 2.",
        "warm(T, I) :- holds(inertial(T), 0), #step(I), holds(inertial(T), I).",
        "warm(T, I) :- #count{J : holds(inertial(T), J)} > 1, #step(I).",
        "wish(a) :- success.\nsuccess :- holds(inertial(a), I).",
    ],
)
def test_a_rule_of_another_form_leaves_the_question_open(rule: str) -> None:
    with pytest.raises(OpenQuestion):
        form_of(rule)


def test_a_program_without_steps_leaves_it_open() -> None:
    text = "sorts\n#s = {a}.\npredicates\np(#s).\nrules\np(a).\n"
    with pytest.raises(OpenQuestion):
        StepForm(sparc.check(sparc.parse(text)))


def test_a_weak_constraint_leaves_it_open() -> None:
    text = "sorts\n#step = 0..2.\npredicates\np(#step).\nrules\np(I) :- #step(I).\n:~ p(I). [1:1]\n"
    with pytest.raises(OpenQuestion):
        StepForm(sparc.check(sparc.parse(text)))
