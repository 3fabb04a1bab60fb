"""Values that stand for several options of a command."""

from __future__ import annotations

import inspect
from typing import Annotated, Optional

import typer
from typer.testing import CliRunner

from sparc.lazy_dataclass import dataclass
from waiter_cli.command_line.folding import folded


@dataclass(frozen=True)
class Place:
    """Where."""

    room: Annotated[Optional[str], typer.Option("--room", help="Which room.")] = None
    floor: Annotated[int, typer.Option("--floor", "-f", min=0)] = 1


@folded
def find(what: str, place: Place, loud: bool = False) -> int:
    """Find something."""
    print(f"{what} in {place.room} on {place.floor}{'!' if loud else ''}")
    return 0


def test_a_value_is_an_option_for_each_of_its_fields() -> None:
    assert list(inspect.signature(find).parameters) == ["what", "room", "floor", "loud"]
    app = typer.Typer()
    app.command()(find)
    run = CliRunner().invoke
    assert run(app, ["hat", "--room", "hall", "-f", "3", "--loud"]).output == "hat in hall on 3!\n"
    assert run(app, ["hat"]).output == "hat in None on 1\n"
    assert run(app, ["hat", "-f", "-1"]).exit_code == 2
    told = run(app, ["--help"]).output
    assert "Find something." in told and "Which room." in told
