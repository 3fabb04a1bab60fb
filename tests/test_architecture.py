"""The shape of the house: who may import whom, and what a start-up may load."""

from __future__ import annotations

import ast
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
MODULES = sorted(p for package in ("sparc", "waiter_cli") for p in (ROOT / package).rglob("*.py"))

# What lies outside, and the module that owns it.  Nothing else imports it at all.
OWNERS = {
    "pybullet": {"waiter_cli/replay/bullet.py"},
}
HEAVY = {"clingo", "yaml", "rich", "numpy", "pybullet", "PIL", "imageio_ffmpeg"}


@cache
def tree_of(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def imports(path: Path, *, at_import: bool) -> set[str]:
    """The modules that a file imports: when it is imported itself, or anywhere in it."""
    found: set[str] = set()
    todo: list[ast.AST] = [tree_of(path)]
    while todo:
        node = todo.pop()
        if isinstance(node, ast.Import):
            found.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.add(node.module)
        functions = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
        for child in ast.iter_child_nodes(node):
            if at_import and isinstance(child, functions):
                continue
            if at_import and isinstance(child, ast.If) and "TYPE_CHECKING" in ast.dump(child.test):
                todo.extend(child.orelse)
                continue
            todo.append(child)
    return found


def name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def of_commands(path: Path) -> bool:
    return name(path).startswith("waiter_cli/commands/") or name(path) == "waiter_cli/app.py"


def packages(path: Path, *, at_import: bool) -> set[str]:
    """The packages of what a file imports."""
    return {module.split(".")[0] for module in imports(path, at_import=at_import)}


def test_there_are_modules_to_look_at() -> None:
    assert len(MODULES) > 150
    assert sum(map(of_commands, MODULES)) > 15


def test_sparc_knows_nothing_of_restaurants() -> None:
    assert not [
        name(path)
        for path in MODULES
        if name(path).startswith("sparc/") and "waiter_cli" in packages(path, at_import=False)
    ]


def test_stages_do_not_reach_back_to_commands() -> None:
    stages = [path for path in MODULES if not of_commands(path)]
    assert not [
        name(path)
        for path in stages
        if any(m.startswith("waiter_cli.commands") for m in imports(path, at_import=True))
    ]
    calling = [name(p) for p in stages if "waiter_cli.app" in imports(p, at_import=False)]
    assert calling == ["waiter_cli/__main__.py"]


@pytest.mark.parametrize("module", OWNERS)
def test_the_outside_world_has_owners(module: str) -> None:
    assert {name(path) for path in MODULES if module in packages(path, at_import=False)} == OWNERS[
        module
    ]


def test_commands_import_heavy_things_in_their_bodies() -> None:
    assert not [
        name(path)
        for path in MODULES
        if of_commands(path) and packages(path, at_import=True) & HEAVY
    ]


def test_the_validator_shares_no_code_with_the_translator() -> None:
    for path in (ROOT / "waiter_cli/verify.py", ROOT / "waiter_cli/rules.py"):
        allowed = {"sparc.values"}
        wanted = {m for m in imports(path, at_import=False) if m.startswith(("sparc", "clingo"))}
        assert wanted <= allowed
        made = {"waiter_cli.template", "waiter_cli.slots", "waiter_cli.slot_facts"}
        assert not made & imports(path, at_import=False)


def test_importing_the_library_is_nearly_free() -> None:
    code = "import sys, sparc; assert not {m for m in sys.modules if m[:6] in ('sparc.', 'clingo')}"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=False
    )
    assert done.returncode == 0, done.stderr


def test_every_module_says_what_it_is() -> None:
    """A module opens with one sentence of purpose."""
    trees = {name(path): tree_of(path) for path in MODULES}
    assert not [file for file, tree in trees.items() if tree.body and not ast.get_docstring(tree)]
