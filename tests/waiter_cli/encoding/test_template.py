"""Templates: slots and parts, the lines they came from, and the faults of a broken one."""

from __future__ import annotations

import pytest

from sparc.source import Source
from tests.support.small_worlds import small_problem
from waiter_cli.encoding.domains import find_domain
from waiter_cli.encoding.slots import parts_of
from waiter_cli.encoding.template import fill_template
from waiter_cli.errors import InputError
from waiter_cli.problems.from_options import read_problem


def report(*enter: int):
    return read_problem("report", None, enter=enter)[0]


def test_a_slot_is_replaced_and_the_rest_stays() -> None:
    template = Source("t.sparc", "sorts\n%{ steps\n#step = 0..99.\n%}\nrules\n")
    filled = fill_template(template, report(1), 4)
    assert filled.text == "sorts\n#step = 0..4.\nrules\n"


def test_a_part_is_kept_only_where_the_problem_has_it() -> None:
    template = Source("t.sparc", "a.\n%? bar\nb.\n%? objects\nc.\n%.\n%.\nd.")
    assert fill_template(template, report(1), 1).text == "a.\nd."
    bistro = read_problem("bistro", None, enter=(1,))[0]
    assert {"bar", "objects"} <= parts_of(bistro)
    assert fill_template(template, bistro, 1).text == "a.\nb.\nc.\nd."


def test_lines_of_the_template_keep_their_place() -> None:
    template = Source("t.sparc", "a.\n%{ steps\n%}\n  b.")
    filled = fill_template(template, report(1), 1)
    place = filled.location(filled.text.index("b."))
    assert (place.name, place.line, place.column) == ("t.sparc", 4, 3)


def test_lines_made_from_yaml_point_at_the_yaml() -> None:
    problem = report(1)
    filled = fill_template(find_domain("restaurant").template, problem, 3)
    edge = filled.location(filled.text.index("edge(n2, n3)"))
    assert edge.name.endswith("report.yaml")
    assert edge.line == problem.layout.edge_where[1].line


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("%{ stpes\n%}", "1:4", "unknown slot stpes"),
        ("\n  %{  stpes\n%}", "2:7", "unknown slot stpes"),
        ("%{\n%}", "1:1", "a slot without a name"),
        ("  %? bra\n%.", "1:6", "unknown part bra"),
        ("%?\n%.", "1:1", "a part without a name"),
        ("\n   %{ steps\n", "2:4", "slot steps is never closed"),
        ("%? bar\n", "1:1", "part bar is never closed"),
        ("\n  %}\n", "2:3", "a slot ends that never began"),
        ("%.\n", "1:1", "a part ends that never began"),
        ("%{ steps\n%? bar\n%.\n", "2:1", "slot steps is still open here"),
    ],
)
def test_a_broken_template_is_refused_in_its_place(text: str, place: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        fill_template(Source("t.sparc", text), report(1), 1)
    fault = caught.value.faults[0]
    assert (str(fault.where), fault.message) == (f"t.sparc:{place}", message)
    assert fault.hint
    assert fault.excerpt == text.split("\n")[int(place[0]) - 1]


def test_a_misspelled_slot_gets_a_suggestion() -> None:
    with pytest.raises(InputError) as caught:
        fill_template(Source("t.sparc", "%{ stpes\n%}"), report(1), 1)
    assert caught.value.faults[0].hint == "did you mean steps?"


@pytest.mark.parametrize("domain", ["restaurant", "report"])
def test_the_template_itself_is_a_program(domain: str) -> None:
    from sparc.checking.checker import check
    from sparc.syntax.parser import parse

    assert check(parse(find_domain(domain).template))


@pytest.mark.parametrize("seed", range(20))
def test_every_small_world_makes_a_program(seed: int) -> None:
    from sparc.checking.checker import check
    from sparc.syntax.parser import parse

    source = fill_template(find_domain("restaurant").template, small_problem(seed), 3)
    assert check(parse(source))


def test_the_report_domain_refuses_what_it_has_no_words_for() -> None:
    problem = read_problem("bistro", None, goals=("chairs: {table1: 2}",))[0]
    with pytest.raises(InputError, match="knows no"):
        fill_template(find_domain("report").template, problem, 3)


def test_the_report_domain_has_togetherness_at_every_step() -> None:
    from sparc.solving.clingo_solver import Grounding
    from waiter_cli.translators.native import NativeTranslator

    source = fill_template(find_domain("report").template, report(2), 4)
    grounding = Grounding(NativeTranslator().translate(source), show="#show.")
    grounding.ground()
    atoms = grounding.control.symbolic_atoms.by_signature("holds", 2, True)
    steps = {
        a.symbol.arguments[1].number for a in atoms if a.symbol.arguments[0].name == "aretogether"
    }
    assert steps == {0, 1, 2, 3, 4}


@pytest.mark.parametrize("name", ["a", "i", "x", "n0_1", "horizon", "step", "holds", "success"])
def test_any_legal_name_works(tmp_path, name: str) -> None:
    from waiter_cli.planning.strategies import find_minimal_plan
    from waiter_cli.translators.native import NativeTranslator

    layout = tmp_path / "names.yaml"
    layout.write_text(
        f"name: names\nnodes: [{name}, other]\nedges: [[{name}, other]]\nentrance: {name}\n"
        f"tables: {{t: {{capacity: 2, nodes: [other]}}}}\nagent: other\n"
    )
    problem = read_problem(str(layout), None, enter=(1,))[0]
    result = find_minimal_plan(problem, NativeTranslator(), find_domain("restaurant"))
    assert result.plan is not None and result.plan.horizon == 4
