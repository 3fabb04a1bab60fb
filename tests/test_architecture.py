"""The shape of the house: who may import whom, and what a start-up may load."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
MODULES = sorted(p for package in ("sparc", "waiter_cli") for p in (ROOT / package).rglob("*.py"))

# What lies outside, and the module that owns it.  Nothing else imports it at all.
OWNERS = {
    "pybullet": {"waiter_cli/replay/bullet.py"},
}
HEAVY = {"clingo", "yaml", "rich", "numpy", "pybullet", "PIL", "imageio_ffmpeg"}


def imports(path: Path, *, at_import: bool) -> set[str]:
    """The modules that a file imports: when it is imported itself, or anywhere in it."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found: set[str] = set()
    todo: list[ast.AST] = [tree]
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


@pytest.mark.parametrize("path", MODULES, ids=name)
def test_sparc_knows_nothing_of_restaurants(path: Path) -> None:
    if name(path).startswith("sparc/"):
        assert not {m for m in imports(path, at_import=False) if m.startswith("waiter_cli")}


@pytest.mark.parametrize("path", MODULES, ids=name)
def test_stages_do_not_reach_back_to_commands(path: Path) -> None:
    if name(path).startswith("waiter_cli/commands/") or name(path) == "waiter_cli/app.py":
        return
    wanted = {m for m in imports(path, at_import=True) if m.startswith("waiter_cli.commands")}
    assert not wanted
    assert "waiter_cli.app" not in imports(path, at_import=False) or name(path).endswith(
        "__main__.py"
    )


@pytest.mark.parametrize("path", MODULES, ids=name)
def test_the_outside_world_has_owners(path: Path) -> None:
    for module, owners in OWNERS.items():
        if name(path) not in owners:
            assert module not in {m.split(".")[0] for m in imports(path, at_import=False)}


@pytest.mark.parametrize(
    "path",
    [
        p
        for p in MODULES
        if name(p).startswith("waiter_cli/commands/") or name(p) == "waiter_cli/app.py"
    ],
    ids=name,
)
def test_commands_import_heavy_things_in_their_bodies(path: Path) -> None:
    assert not {m.split(".")[0] for m in imports(path, at_import=True)} & HEAVY


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


@pytest.mark.parametrize("path", MODULES, ids=name)
def test_every_module_says_what_it_is(path: Path) -> None:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    assert not tree.body or ast.get_docstring(tree), "a module opens with one sentence of purpose"
