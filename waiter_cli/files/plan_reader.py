"""A plan file → `PlanDocument`: its actions, every fault with its place. Entry points `read_plan`, `read_plan_file`.

A plan file is the JSON that ``waiter plan --json`` prints.  Only what is played is read here:
``actions`` and ``horizon``; the situation it starts from is `problem`'s to read.  Whether the
actions are possible is not asked either: names that mean nothing are the validator's to judge.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from sparc.reading import read_capped
from waiter_cli.errors import Fault, InputError, LayoutError, ReplayError, Where
from waiter_cli.file_access.kinds import CERTAIN, kind_of
from waiter_cli.file_access.locate import decode
from waiter_cli.files.plan_origin import Memory, read_memory
from waiter_cli.model.plan import Action, Plan
from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import (
    Document,
    Mapping,
    Node,
    Scalar,
    compose,
    node_from_value,
)

if TYPE_CHECKING:
    from waiter_cli.model.layout import Layout
    from waiter_cli.model.state import State

__all__ = ["MAX_STEP", "PlanDocument", "read_final_state", "read_plan", "read_plan_file"]

MAX_BYTES = 1 << 24
MAX_STEP = 100_000


@dataclass(frozen=True)
class PlanDocument:
    """The content of a plan file.

    ``plan`` may have actions out of order and two at a step, just as the file has them.
    ``layout`` is the name of the layout it was made for, None where it does not say.  ``text`` is
    the file's text; where it is JSON but no YAML (a sign written as two escapes), the same JSON without.
    ``layout_file``, ``domain`` and ``domain_file`` are what it remembers of what it was made from.
    ``name`` is what messages call the file; ``remarks`` say what it contradicts itself in.
    """

    plan: Plan
    text: str
    layout: str | None = None
    name: str = ""
    layout_file: Memory | None = None
    domain: str | None = None
    domain_file: Memory | None = None
    remarks: tuple[str, ...] = ()


def read_plan_file(path: str) -> PlanDocument:
    """Returns the plan in a file, ``-`` for standard input.

    Raises `InputError` where it cannot be read, `ReplayError` with every fault of what it says.
    """
    name = "<stdin>" if path == "-" else path
    try:
        data = read_capped(path, MAX_BYTES)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        what = (getattr(error, "strerror", None) or str(error)).lower()
        mend = "make one with waiter plan … --json > plan.json"
        raise InputError([Fault(Where(repr(name)[1:-1]), what, mend)]) from None
    return read_plan(decode(data, name), name)


def read_plan(text: str, name: str) -> PlanDocument:
    """Returns the plan in the text of a file called ``name``.

    Raises `ReplayError` with every fault.
    """
    try:
        document, text = _document(text, name)
        return _read(document, text)
    except LayoutError as error:
        raise ReplayError(error.faults) from None


def _document(text: str, name: str) -> tuple[Document, str]:
    try:
        value = json.loads(text, parse_constant=_no_constant)
    except json.JSONDecodeError as error:
        place = Where(name, error.lineno, error.colno)
        kind = kind_of(text)
        if kind in CERTAIN and kind != "a plan":
            hint = "give what waiter plan --json printed"
            raise ReplayError([Fault(Where(name), f"this is {kind}, not a plan", hint)]) from None
        what = "the file is empty" if not text.strip() else "this is no JSON"
        raise ReplayError([Fault(place, what, "give what waiter plan --json printed")]) from None
    except (RecursionError, ValueError):  # nested without end, or a number without end
        place = Where(name, 1, 1)
        raise ReplayError([Fault(place, "this JSON is nested too deeply or too large")]) from None
    try:
        return compose(text, name), text
    except LayoutError:  # JSON that is no YAML, such as with a sign written as two escapes
        top = Where(name, 1, 1)
        return Document(name, (), node_from_value(value, top), ()), json.dumps(
            value, ensure_ascii=False
        )


def _no_constant(name: str) -> None:
    """Refuses ``NaN`` and ``Infinity``, which Python reads though JSON has neither."""
    raise ValueError(name)


def _read(document: Document, text: str) -> PlanDocument:
    name = document.name
    reader = NodeReader(document)
    root = document.root or Scalar("", True, Where(name, 1, 1))
    keys = reader.mapping(root, "a plan file")
    if keys is None:
        reader.finish()
    keys = keys or {}
    top = Where(name, 1, 1)
    status = keys.get("status")
    found = status.text if isinstance(status, Scalar) else None
    if found not in (None, "plan", "undecided") or (found == "undecided" and "horizon" not in keys):
        place = status.where if status is not None else top
        reader.fault(place, f"the file holds no plan: its status is {found}", "plan again first")
        reader.finish()
    actions: list[Action] = []
    remarks: list[str] = []
    if "actions" in keys:
        for node in reader.items(keys["actions"], "actions") or ():
            action = _action(reader, node)
            if action is not None:
                actions.append(action)
                remark = _other_text(node, action)
                remarks += [remark] if remark else []
    else:
        reader.fault(top, "the file has no actions", "give what waiter plan --json printed")
    horizon = max((action.step + 1 for action in actions), default=0)
    if "horizon" in keys:
        horizon = reader.integer(keys["horizon"], "horizon", 0, MAX_STEP) or 0
    memories = [read_memory(reader, keys.get(k), k) for k in ("layout_file", "domain_file")]
    reader.finish()
    plan = Plan(tuple(actions), horizon)
    named = [_named(keys.get(key)) for key in ("layout", "domain")]
    return PlanDocument(
        plan, text, named[0], document.name, memories[0], named[1], memories[1], tuple(remarks)
    )


def _named(node: Node | None) -> str | None:
    return node.text if isinstance(node, Scalar) and not node.is_nothing else None


def _action(reader: NodeReader, node: Node) -> Action | None:
    keys = reader.mapping(node, "an action", ("step", "name", "args", "text"))
    if keys is None:
        return None
    if "step" not in keys:
        reader.fault(node.where, "this action has no step", "add step: 0, 1, …")
        return None
    step = reader.integer(keys["step"], "step", 0, MAX_STEP - 1)
    if "name" not in keys and "text" in keys:
        term = reader.text(keys["text"], "text")
        parts = None if term is None else _parts(term)
        if term is not None and parts is None:
            reader.fault(keys["text"].where, f"{term} is no action", "write go_to(agent,n2)")
        return None if step is None or parts is None else Action(step, parts[0], parts[1:])
    for key in ("name", "args"):
        if key not in keys:
            reader.fault(node.where, f"this action has no {key}", "give step, name and args")
            return None
    called = reader.text(keys["name"], "name of an action")
    arguments = [
        reader.text(item, "argument of an action")
        for item in reader.items(keys["args"], "args") or ()
    ]
    if step is None or called is None:
        return None
    return Action(step, called, tuple(name for name in arguments if name is not None))


def _other_text(node: Node, action: Action) -> str | None:
    """Returns a remark where an action's text is that of another one: it is for the
    eye, and not played.
    """
    entries = node.entries if isinstance(node, Mapping) else ()
    said = next((value for key, value in entries if key.text == "text"), None)
    if not isinstance(said, Scalar) or "".join(said.text.split()) == action.text:
        return None
    return f"step {action.step} is {action.text} by its name and args, whatever its text says"


def _parts(term: str) -> tuple[str, ...] | None:
    """Returns name and arguments of ``go_to(agent,n2)``, None where the text has no such form."""
    name, bracket, rest = term.replace(" ", "").partition("(")
    if not name.isidentifier() or not bracket or not rest.endswith(")"):
        return None
    return (name, *rest[:-1].split(","))


def read_final_state(made: PlanDocument, layout: Layout) -> State | None:
    """Returns the final state that a plan file predicts, None where it says nothing of it.

    Raises `LayoutError` where it is no state of this restaurant.
    """
    from waiter_cli.files.names import Names
    from waiter_cli.files.state_reader import read_state

    document = compose(made.text, made.name)
    reader = NodeReader(document)
    keys = reader.mapping(document.root, "a plan file") if document.root is not None else None
    if not keys or "final_state" not in keys:
        return None
    state, _ = read_state(reader, keys["final_state"], Names(layout))
    reader.finish()
    return state
