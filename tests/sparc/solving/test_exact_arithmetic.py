"""Arithmetic beyond 32 bits: the value of whole numbers, or a fault with its place."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator

import pytest

import sparc
from sparc.checking.typed_program import Undefined, apply_operator
from sparc.errors import NumberError, SourceErrors

MAX = 2**31 - 1
NUMBERS = (
    0,
    1,
    2,
    3,
    7,
    10,
    255,
    46340,
    46341,
    65536,
    99999,
    10**6,
    2**30,
    2**30 + 1,
    2 * 10**9,
    MAX,
)
OPERATORS = ("=", "!=", "<", "<=", ">", ">=")
Tree = int | str | tuple


def shown(program: str) -> set[str]:
    (answer_set,) = sparc.solve(program)
    return set(map(str, answer_set.literals))


def program(rules: str, sorts: str = "#n = 0..70000.", predicates: str = "p(#n). q(#n).") -> str:
    return f"#maxint = {MAX}.\nsorts\n{sorts}\npredicates\n{predicates}\nrules\n{rules}\n"


@pytest.mark.parametrize(
    ("rules", "expected"),
    [
        pytest.param("p(65536). q(X*X) :- p(X).", {"p(65536)"}, id="a product in a head"),
        pytest.param("p(65536). q(X) :- p(X), X*X < 10.", {"p(65536)"}, id="a comparison"),
        pytest.param("p(65536). q(X) :- p(X), X*X > 10.", {"p(65536)", "q(65536)"}, id="the other"),
        pytest.param("p(65536). q(X*X/X) :- p(X).", {"p(65536)", "q(65536)"}, id="there and back"),
        pytest.param("p(7). q(X) :- p(X), X+2147483647 > X.", {"p(7)", "q(7)"}, id="a sum"),
        pytest.param("p(7). q(X) :- p(X), 0-2147483647-X < X.", {"p(7)", "q(7)"}, id="a difference"),
        pytest.param("p(7). q(X) :- p(X), not q(X+2147483647).", {"p(7)"}, id="a guard of a sum"),
        pytest.param("p(7). q(X) :- p(X), not p(X*400000000).", {"p(7)"}, id="under not"),
        pytest.param("p(0). q(X) :- p(X*65536).", {"p(0)", "q(0)"}, id="in a positive literal"),
        pytest.param("p(7). q(X) :- p(X), #count{Y : p(Y), Y*Y*Y*Y*X*1000000 > 5} = 1.",
                     {"p(7)", "q(7)"}, id="in the condition of an aggregate"),
        pytest.param("p(65536). q(X) :- p(X), #count{Y : p(Y)} < X*X.", {"p(65536)", "q(65536)"},
                     id="as the bound of an aggregate"),
        pytest.param("p(65536). X*X{q(X)} :- p(X). q(3).", None, id="as the bound of a choice"),
        pytest.param("p(65536). q(Y) :- p(X), Y = X*X.", {"p(65536)"}, id="a name for it"),
        pytest.param("p(10). p(65536). q(X) :- p(X), p(Y), (Y-46341)*1000000 < X - 10.",
                     {"p(10)", "p(65536)", "q(10)", "q(65536)"}, id="a factor on a difference"),
    ],
)  # fmt: skip
def test_no_result_is_cut_to_32_bits(rules: str, expected: set[str] | None) -> None:
    if expected is None:
        assert not list(sparc.solve(program(rules)))
    else:
        assert shown(program(rules)) == expected


def test_records_count_exactly() -> None:
    text = program(
        "p(65536). at(f(X*X)) :- p(X). q(X) :- p(X), at(f(X*X)).",
        "#n = 0..70000. #f = f(#n).",
        "p(#n). q(#n). at(#f).",
    )
    assert shown(text) == {"p(65536)"}


def test_identifiers_come_behind_numbers_of_any_size() -> None:
    text = program(
        "p(65536). p(a). q(Y) :- p(X), p(Y), X*X < Y. ", "#n = {65536, 3, a}.", "p(#n). q(#n)."
    )
    assert shown(text) == {"p(65536)", "p(a)", "q(a)"}


def test_what_has_no_value_has_no_instance() -> None:
    text = program("p(65536). p(0). q(X) :- p(X), X*X*X/X > 3.")
    assert shown(text) == {"p(65536)", "p(0)", "q(65536)"}


def test_what_fits_is_left_to_clingo() -> None:
    text = sparc.to_asp(program("q(X*X+1) :- p(X).", "#n = 0..40000.")).text
    assert "@" not in text


def test_a_linear_form_that_does_not_fit_is_not_solved_by_clingo() -> None:
    text = program("p(2). q(X) :- r(X), p((X-1073741824)*2).",
                   "#n = 0..9. #r = 1073741820..1073741829.", "p(#n). q(#r). r(#r).")  # fmt: skip
    text += "r(1073741825). r(1073741824). "
    assert "q(1073741825)" in shown(text)


def test_a_range_too_long_to_be_listed_is_compared() -> None:
    text = program("p(3). q(X*1000) :- p(X). q(X*X*X*1000000000) :- p(X).", f"#n = 0..{MAX}.")
    assert shown(text) == {"p(3)", "q(3000)"}


# ------------------------------------------------------------------ sums and costs


@pytest.mark.parametrize(
    ("rule", "place"),
    [
        pytest.param("q(1) :- #sum{X : p(X)} > 10.", (7, 9), id="a sum"),
        pytest.param("q(X) :- p(X), #sum{Y,Z : p(Y), p(Z)} > X.", (7, 15), id="one for each X"),
        pytest.param("#minimize{X : p(X)}.", (7, 1), id="minimize"),
        pytest.param("#maximize{X@2,1 : p(X)}.", (7, 1), id="maximize"),
        pytest.param(":~ p(X). [X:1]", (7, 1), id="weak constraints"),
        pytest.param("q(1) :- #sum{70000*70000 : p(2)} > 10.", (7, 14), id="a weight"),
        pytest.param("r: q(1) :+ p(3). :~ p(2). [1:2147483647]", (7, 30), id="a level"),
    ],
)
def test_a_sum_that_may_not_fit_is_a_fault_at_its_place(rule: str, place: tuple[int, int]) -> None:
    text = program(rule + "\np(2). p(2000000000). p(1999999999).", f"#n = 0..{MAX}.")
    with pytest.raises(NumberError) as caught:
        list(sparc.solve(text))
    location = caught.value.span.location
    assert (location.line, location.column) == place


def test_a_sum_that_fits_is_exact_whatever_its_sort() -> None:
    text = program(
        "p(2000000000). p(147483647). q(3) :- #sum{Y : p(Y)} = 2147483647.", f"#n = 0..{MAX}."
    )
    assert shown(text) == {"p(2000000000)", "p(147483647)", "q(3)"}


def test_a_range_too_long_to_be_listed_holds_what_a_comparison_computes() -> None:
    text = program("p(40000). p(50000). q(Z) :- p(X), Z = X*X.", f"#n = 0..{MAX}.")
    assert shown(text) == {"p(40000)", "p(50000)", "q(1600000000)"}


def test_a_sum_outside_its_sort_has_no_instance() -> None:
    rules = "p(4). p(3). q(N) :- #sum{X : p(X)} = N."
    assert shown(program(rules, "#n = 0..6.")) == {"p(4)", "p(3)"}
    assert shown(program(rules, "#n = 0..7.")) == {"p(4)", "p(3)", "q(7)"}
    assert shown(program(rules, f"#n = 0..{MAX}.")) == {"p(4)", "p(3)", "q(7)"}


def test_ground_arguments_are_checked_exactly() -> None:
    with pytest.raises(SourceErrors, match="4294967296 is not in sort #n"):
        sparc.check(sparc.parse(program("p(65536*65536).")))


# ------------------------------------------------------------------ by chance


def trees(rng: random.Random, depth: int) -> Tree:
    if depth == 0 or rng.random() < 0.2:
        return rng.choice(("X", "Y", "X", "Y", rng.choice(NUMBERS)))
    return (rng.choice("+-**/"), trees(rng, depth - 1), trees(rng, depth - 1))


def written(tree: Tree) -> str:
    if isinstance(tree, tuple):
        return f"({written(tree[1])} {tree[0]} {written(tree[2])})"
    return str(tree)


def value(tree: Tree, given: dict[str, int]) -> int:
    if isinstance(tree, tuple):
        return apply_operator(tree[0], value(tree[1], given), value(tree[2], given), None)
    return given[tree] if isinstance(tree, str) else tree


def faulty(tree: Tree) -> bool:
    """Whether a part without variables has no value, which the checker finds."""
    if not isinstance(tree, tuple):
        return False
    if not {"X", "Y"} & set(written(tree)):
        try:
            value(tree, {})
        except Undefined:
            return True
    return faulty(tree[1]) or faulty(tree[2])


def holds(left: int, operator: str, right: int) -> bool:
    return {"=": left == right, "!=": left != right, "<": left < right, "<=": left <= right,
            ">": left > right, ">=": left >= right}[operator]  # fmt: skip


def by_chance(rng: random.Random) -> tuple[str, set[str]]:
    """A program, and what is in its answer set by the arithmetic of whole numbers."""
    elements = sorted(rng.sample(NUMBERS, 6))
    sort = f"{{{','.join(map(str, elements))}}}"
    members = set(elements)
    if rng.random() < 0.4:
        low, high = sorted(rng.sample(NUMBERS, 2))
        elements = [number for number in NUMBERS if low <= number <= high]
        members, sort = range(low, high + 1), f"{low}..{high}"  # type: ignore[assignment]
    xs, ys = rng.choices(elements, k=2), rng.choices(elements, k=2)
    one, two = trees(rng, rng.randint(1, 3)), trees(rng, rng.randint(0, 3))
    if not {"X", "Y"} & set(written(one)):
        one = (rng.choice("+-*/"), one, "X")  # a ground argument is a fault outside its sort
    if faulty(one) or faulty(two):
        return by_chance(rng)
    operator = rng.choice(OPERATORS)
    a, b = written(one), written(two)
    rules = [f"px({x})." for x in xs] + [f"py({y})." for y in ys]
    rules += [
        f"head({a}) :- px(X), py(Y).",
        f"test(X,Y) :- px(X), py(Y), {a} {operator} {b}.",
        f"free(X,Y) :- px(X), py(Y), not px({a}).",
        f"same(X,Y) :- px(X), py(Y), px({a}).",
        f"name(Z) :- px(X), py(Y), Z = {a}, px(X).",
        f"deep(f(X,{a})) :- px(X), py(Y).",
        f"many(X,Y) :- px(X), py(Y), #count{{Z : px(Z), {a} {operator} Z}} > 0.",
        f"over(X,Y) :- px(X), py(Y), #count{{Z : px(Z)}} {operator} {a}.",
    ]
    expected = {f"px({x})" for x in xs} | {f"py({y})" for y in ys}
    for x in xs:
        for y in ys:
            given = {"X": x, "Y": y}
            try:
                first = value(one, given)
            except Undefined:
                continue
            if first in members:
                expected |= {f"head({first})", f"name({first})", f"deep(f({x},{first}))"}
                expected.add(f"{'same' if first in xs else 'free'}({x},{y})")
            if any(holds(first, operator, z) for z in xs):
                expected.add(f"many({x},{y})")
            if holds(len(set(xs)), operator, first):
                expected.add(f"over({x},{y})")
            try:
                if holds(first, operator, value(two, given)):
                    expected.add(f"test({x},{y})")
            except Undefined:
                pass
    names = ["px", "py", "head", "name"], ["test", "free", "same", "many", "over"]
    predicates = " ".join([f"{n}(#v)." for n in names[0]] + [f"{n}(#v,#v)." for n in names[1]])
    text = program("\n".join(rules), f"#v = {sort}. #f = f(#v,#v).", predicates + " deep(#f).")
    return text, expected


def programs(seeds: Iterable[int]) -> Iterator[tuple[str, set[str]]]:
    for seed in seeds:
        yield by_chance(random.Random(seed))


@pytest.mark.wide
def test_random_arithmetic_is_that_of_whole_numbers() -> None:
    for text, expected in programs(range(30)):
        assert shown(text) == expected, text


@pytest.mark.slow
def test_more_random_arithmetic_is_that_of_whole_numbers() -> None:
    for text, expected in programs([*range(100), *range(1000, 3000)]):
        assert shown(text) == expected, text


def test_a_fact_over_a_range_that_ends_before_it_begins_is_empty_and_told() -> None:
    typed = sparc.check(sparc.parse(program("p(5..1). p(3).")))
    warning = next(each for each in sparc.find_warnings(typed) if "5..1" in each.message)
    assert warning.message.startswith("the range 5..1 ends before it begins")
    assert (warning.span.location.line, warning.span.location.column) == (7, 6)
    assert shown(program("p(5..1). p(3).")) == {"p(3)"}
    with pytest.raises(SourceErrors, match="ends before it begins") as caught:
        sparc.check(sparc.parse(program("p(3).", "#n = 5..1.")))
    assert caught.value.errors[0].span.location.column == 9


LAST = (
    "#maxint = 2147483647. sorts #n = 2147483645..2147483647. predicates w(#n). v(#n). z(). rules "
)


@pytest.mark.parametrize(
    ("rules", "count"),
    [
        ("w(X).", 3),
        ("w(2147483645..2147483647).", 3),
        ("w(2147483647..2147483647).", 1),
        ("-w(2147483646..2147483647). w(X) :- not -w(X).", 3),
        ("w(2147483645). w(X+1) :- w(X).", 3),
        ("{w(X)}. :- not w(2147483646). :- #count{X : w(X)} > 1.", 1),
    ],
)
def test_the_last_number_is_counted_to(rules: str, count: int) -> None:
    """clingo never ends to count in ``p(2147483645..2147483647)``."""
    (answer,) = sparc.solve(LAST + rules + " ", time_limit=20)
    assert len(answer.literals) == count


def test_the_last_number_is_explained() -> None:
    found = sparc.why(LAST + "w(2147483645..2147483647). ", "w(2147483647)", time_limit=20)
    assert found.holds and found.because[0].instance == "w(2147483647)"
    explained = sparc.explain(LAST + "w(2147483647). v(X+1) :- w(X). z :- v(X). :- not z. ")
    (cause,) = explained.causes
    assert [member.place.text for member in cause.members] == [":- not z."]
