"""The shape of the house: who may import whom, what things are called, what a start-up loads."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from tests.support.paths import ROOT

# Each floor of `waiter_cli` may use the floors below it, and no room beside it on its own floor.
FLOORS = (
    ("errors", "spelling", "optional_packages"),
    ("model",),
    ("console", "translators", "rules", "room", "yaml_reading", "file_access"),
    ("files", "labels", "encoding", "bounds"),
    ("problems", "answersets", "diagnosis", "flow_bounds", "drawing", "fleets", "domain_execution"),
    ("planning", "domain_tests"),
    ("execution", "explanation", "layout_tools", "evenings"),
    ("editing", "serve", "simulation"),
    ("pictures", "boundary", "command_line"),
    ("studio", "study"),
    ("commands",),
    ("app",),
)
RANK = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
FREE = {"__init__", "__main__"}  # the front doors, which lead everywhere

# What lies outside, and the modules that own it: nothing else imports it at all, or at its start.
OWNERS = {
    "difflib": {"sparc/spelling.py"},
    "pybullet": {"waiter_cli/simulation/bullet.py"},
    "highspy": {"waiter_cli/flow_bounds/programme.py"},
}
LEAST, MOST = 3, 18  # modules in a package
TOP_LEVEL = 8  # modules of `waiter_cli` itself


@cache
def modules() -> dict[str, Path]:
    """Every module of the product by its dotted name."""
    found = {}
    for package in ("sparc", "waiter_cli"):
        for path in sorted((ROOT / package).rglob("*.py")):
            found[".".join(path.relative_to(ROOT).with_suffix("").parts)] = path
    return found


@cache
def tree_of(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def target(module: str, name: str) -> str | None:
    """The product's module that an import of ``name`` from ``module`` loads."""
    for candidate in (
        f"{module}.{name}",
        f"{module}.{name}.__init__",
        module,
        f"{module}.__init__",
    ):
        if candidate in modules():
            return candidate
    return None


@cache
def nodes(path: Path, *, at_import: bool) -> tuple[ast.AST, ...]:
    """The nodes of a file: all, or those that run when it is imported."""
    return tuple(ast.walk(tree_of(path)) if not at_import else _run_at_import(path))


def _run_at_import(path: Path) -> Iterator[ast.AST]:
    todo: list[ast.AST] = [tree_of(path)]
    while todo:
        node = todo.pop()
        yield node
        functions = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
        for child in ast.iter_child_nodes(node):
            if isinstance(child, functions):
                continue
            if isinstance(child, ast.If) and "TYPE_CHECKING" in ast.dump(child.test):
                todo.extend(child.orelse)
                continue
            todo.append(child)


@cache
def imports(path: Path, *, at_import: bool = False) -> tuple[tuple[str, str], ...]:
    """Each (module, name) that a file imports; the name is empty for ``import module``."""
    return tuple(_imports(path, at_import=at_import))


def _imports(path: Path, *, at_import: bool) -> Iterator[tuple[str, str]]:
    for node in nodes(path, at_import=at_import):
        if isinstance(node, ast.Import):
            yield from ((alias.name, "") for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield from ((node.module, alias.name) for alias in node.names)
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
            first = node.args[0]
            if isinstance(first, ast.Constant):
                yield first.value, ""


def outside(path: Path, *, at_import: bool) -> set[str]:
    """The top-level packages of what a file imports."""
    return {module.split(".")[0] for module, _ in imports(path, at_import=at_import)}


@cache
def arrows() -> dict[str, set[str]]:
    """For each module the modules of the product that it imports anywhere, lazily or not."""
    out: dict[str, set[str]] = {}
    for name, path in modules().items():
        found = {target(module, what) for module, what in imports(path)}
        out[name] = {other for other in found if other is not None and other != name}
    return out


def room(module: str) -> str:
    """The package or top-level module of `waiter_cli` in which a module stands."""
    return module.split(".")[1]


def test_there_are_modules_to_look_at() -> None:
    assert len(modules()) > 200
    assert sum(map(len, arrows().values())) > 500


def test_sparc_knows_nothing_of_restaurants() -> None:
    assert not [
        name
        for name, others in arrows().items()
        if name.startswith("sparc.") and any(other.startswith("waiter_cli") for other in others)
    ]


def test_imports_go_down() -> None:
    """An import, lazy or not, goes to a lower floor or stays in its room."""
    wrong = [
        f"{name} -> {other}"
        for name, others in arrows().items()
        if name.startswith("waiter_cli.") and room(name) not in FREE
        for other in others
        if other.startswith("waiter_cli.")
        and room(other) != room(name)
        and other != "waiter_cli.__init__"
        and RANK[room(other)] >= RANK[room(name)]
    ]
    assert not wrong


def test_no_import_is_relative() -> None:
    """The rules above read absolute names; an import such as ``from . import x`` would hide from them."""
    hidden = [
        name
        for name, path in modules().items()
        for node in nodes(path, at_import=False)
        if isinstance(node, ast.ImportFrom) and node.level
    ]
    assert not hidden


def test_every_room_has_a_floor() -> None:
    rooms = {room(name) for name in modules() if name.startswith("waiter_cli.")}
    assert rooms - FREE == set(RANK)
    assert len(FLOORS) <= 12


def circles(graph: dict[str, set[str]]) -> list[list[str]]:
    """The circles of a graph: its strong components of more than one node."""
    order: list[str] = []
    seen: set[str] = set()

    def visit(start: str, edges: dict[str, set[str]], out: list[str]) -> None:
        todo = [(start, iter(sorted(edges.get(start, ()))))]
        seen.add(start)
        while todo:
            node, rest = todo[-1]
            following = next((other for other in rest if other not in seen), None)
            if following is None:
                out.append(node)
                todo.pop()
            else:
                seen.add(following)
                todo.append((following, iter(sorted(edges.get(following, ())))))

    for node in graph:
        if node not in seen:
            visit(node, graph, order)
    back: dict[str, set[str]] = defaultdict(set)
    for node, others in graph.items():
        for other in others:
            back[other].add(node)
    seen.clear()
    found = []
    for node in reversed(order):
        if node not in seen:
            component: list[str] = []
            visit(node, back, component)
            if len(component) > 1:
                found.append(sorted(component))
    return found


def test_circles_are_found() -> None:
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"b"}, "d": {"a"}}) == [["b", "c"]]


def test_no_modules_import_each_other_in_a_circle() -> None:
    """Lazy imports count; the two front doors load everything by name and do not."""
    doors = {"sparc.__init__", "waiter_cli.__init__"}
    graph = {name: others - doors for name, others in arrows().items() if name not in doors}
    assert circles(graph) == []


def test_packages_are_of_a_size_that_can_be_seen() -> None:
    sizes = Counter(
        path.parent.relative_to(ROOT).as_posix()
        for path in modules().values()
        if path.name not in ("__init__.py", "__main__.py")
    )
    top = sizes.pop("waiter_cli")
    assert top <= TOP_LEVEL
    groups = {
        "sparc",
        "waiter_cli/commands/layout",
        "waiter_cli/commands/sparc",
        "waiter_cli/commands/study",
        "waiter_cli/commands",
    }
    assert not {k: n for k, n in sizes.items() if not LEAST <= n <= MOST and k not in groups}
    assert not {k: n for k, n in sizes.items() if k in groups and n < LEAST}


def test_module_names_are_unique() -> None:
    """Commands are called after what they do, so their files may share a name with a stage."""
    for package in ("sparc.", "waiter_cli."):
        stems = [
            name.rsplit(".", 1)[1]
            for name in modules()
            if name.startswith(package) and not name.startswith("waiter_cli.commands.")
        ]
        double = [stem for stem, n in Counter(stems).items() if n > 1 and not stem.startswith("__")]
        assert not double, package


def test_class_names_are_unique() -> None:
    for package in ("sparc.", "waiter_cli."):
        names = [
            node.name
            for module, path in modules().items()
            if module.startswith(package)
            for node in tree_of(path).body
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
        ]
        assert not [name for name, n in Counter(names).items() if n > 1], package


def defined(path: Path) -> set[str]:
    """The names that a module binds at its top level."""
    found = set()
    for node in tree_of(path).body:
        if isinstance(node, ast.If):
            for inner in [*node.body, *node.orelse]:
                found |= bound(inner)
        found |= bound(node)
    return found


def bound(node: ast.AST) -> set[str]:
    if isinstance(node, (ast.FunctionDef, ast.ClassDef, ast.AsyncFunctionDef)):
        return {node.name}
    if isinstance(node, ast.Assign):
        return {t.id for t in node.targets if isinstance(t, ast.Name)}
    if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
        return {node.target.id}
    if isinstance(node, (ast.Import, ast.ImportFrom)):
        return {alias.asname or alias.name for alias in node.names}
    return set()


def listed(path: Path) -> set[str] | None:
    """What a module's ``__all__`` lists; None where it has none."""
    for node in tree_of(path).body:
        if isinstance(node, ast.Assign) and any(
            isinstance(t, ast.Name) and t.id == "__all__" for t in node.targets
        ):
            return {str(e.value) for e in ast.walk(node.value) if isinstance(e, ast.Constant)}
    return None


def test_entry_points_that_docstrings_name_exist() -> None:
    wrong = []
    for name, path in modules().items():
        purpose = ast.get_docstring(tree_of(path)) or ""
        for sentence in re.findall(r"Entry points?:?\s+((?:`\w+`(?:,\s+|\s+and\s+)?)+)", purpose):
            for entry in re.findall(r"`(\w+)`", sentence):
                if entry not in defined(path):
                    wrong.append(f"{name}: {entry}")
    assert not wrong


def test_what_others_import_is_public() -> None:
    """A name that another module imports stands in ``__all__`` of the module that defines it."""
    wrong = set()
    for name, path in modules().items():
        for module, what in imports(path):
            home = target(module, what)
            if home is None or home == name or not what or home.endswith(f".{what}"):
                continue
            if home.endswith("__init__"):
                continue
            names = listed(modules()[home])
            if names is None or what not in names:
                wrong.add(f"{home}: {what}")
    assert not sorted(wrong)


TAKING_APART = {
    "startswith",
    "endswith",
    "removeprefix",
    "removesuffix",
    "split",
    "partition",
    "rpartition",
    "replace",
    "find",
    "index",
}
WORDING = {"message", "hint", "mend", "args"}
"""Attributes of exceptions and faults that are for people."""
MAKERS = {"did_you_mean", "format_message"}
"""What makes a sentence."""


def _told(node: ast.AST, sentences: frozenset[str]) -> bool:
    """Whether an expression is a sentence for people: of an error, a fault, or made by `MAKERS`."""
    match node:
        case ast.Attribute(attr=name):
            return name in WORDING
        case ast.Name(id=name):
            return name in sentences
        case ast.Call(func=ast.Name(id="str"), args=[ast.Name(id=name)]):
            return name in {"error", "fault", "cause", "refused", "failure"}
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)):
            return name in MAKERS
        case ast.BoolOp(values=values):
            return any(_told(each, sentences) for each in values)
    return False


def taken_apart(tree: ast.AST) -> Iterator[int]:
    """The lines at which a sentence for people is taken apart, searched, or compared with words.

    A name stands for a sentence from where it is given one, in the function at hand.
    """
    for function in ast.walk(tree):
        if not isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef)):
            continue
        inner = tuple(ast.walk(function))
        # Messages of arguments count too: `expected`, `hint`, `message` of a function.
        sentences = frozenset(
            target.id
            for node in inner
            if isinstance(node, ast.Assign) and _told(node.value, frozenset())
            for target in node.targets
            if isinstance(target, ast.Name)
        ) | {a.arg for a in function.args.args if a.arg in ("message", "hint", "mend", "expected")}
        folded = [  # `" ".join(text.split())` puts a text on one line
            node.args[0]
            for node in inner
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "' '.join"
        ]
        for node in inner:
            match node:
                case ast.Call(func=ast.Attribute(value=value, attr=name)) if (
                    name in TAKING_APART and node not in folded and _told(value, sentences)
                ):
                    yield node.lineno
                case ast.Compare(left=left, ops=[op], comparators=[right]):
                    words = [
                        each
                        for each in (left, right)
                        if isinstance(each, (ast.Constant, ast.JoinedStr))
                        and isinstance(getattr(each, "value", ""), str)
                    ]
                    searched = isinstance(op, (ast.In, ast.NotIn)) and _told(right, sentences)
                    same = isinstance(op, (ast.Eq, ast.NotEq)) and words
                    if searched or (same and (_told(left, sentences) or _told(right, sentences))):
                        yield node.lineno
                case ast.Subscript(value=value, slice=ast.Slice()) if _told(value, sentences):
                    yield node.lineno
                case ast.Call(func=ast.Attribute(value=ast.Name(id="re")), args=[_, text, *_]):
                    if _told(text, sentences):
                        yield node.lineno


@pytest.mark.parametrize(
    "line",
    [
        "error.message.split()", "'no home' in error.message", "error.hint == 'words'",
        "str(error).removeprefix('x')", "did_you_mean(name, known).startswith('did')",
        "(did_you_mean(name, known) or '').startswith('did')", "error.format_message()[:5]",
        "re.search('not one of', message)", "expected.startswith('a pair')",
        "near.replace('known', 'inside')", "'zero' in str(error)",
    ],
)  # fmt: skip
def test_what_is_taken_apart_is_seen(line: str) -> None:
    body = f"def f(message, expected):\n  near = did_you_mean(name, known) or ''\n  {line}\n"
    assert list(taken_apart(ast.parse(body))) == [3]


OTHERS = {  # a foreign program's text is all that it gives
    "sparc.solving.clingo_solver",
    "sparc.solving.jar_output",
}


def test_no_logic_hangs_on_the_words_of_a_message() -> None:
    """Nothing takes a message or a hint of the house apart, or compares it with words."""
    wrong = [
        f"{name}:{line}"
        for name, path in modules().items()
        if name not in OTHERS
        for line in taken_apart(tree_of(path))
    ]
    assert not wrong


SPEAKERS = {  # each escapes what it shows, or shows its own words alone
    "waiter_cli.app",  # has to speak where nothing can be loaded
    "waiter_cli.console.limit_report",
    "waiter_cli.console.output",
    "waiter_cli.console.progress",
    "waiter_cli.pictures.film",
    "waiter_cli.pictures.output_files",
    "sparc.__main__",
}


def test_what_is_shown_is_escaped() -> None:
    """Only `SPEAKERS` write on stdout or stderr; all others go by way of `console.output`."""
    speaking = {
        name
        for name, path in modules().items()
        for node in nodes(path, at_import=False)
        if isinstance(node, ast.Call)
        and (
            ast.unparse(node.func) == "print"
            or re.fullmatch(r"(sys\.)?(stdout|stderr)\.write", ast.unparse(node.func))
        )
    }
    assert speaking == SPEAKERS


def test_tests_mirror_modules() -> None:
    """Each test file under a package's folder is called after a module of that package."""
    wrong = []
    for package in ("sparc", "waiter_cli"):
        folder = ROOT / "tests" / package
        for path in sorted(folder.rglob("test_*.py")):
            inner = path.relative_to(folder)
            module = ROOT / package / inner.with_name(inner.name.removeprefix("test_"))
            if not module.exists() and not module.with_suffix("").is_dir():
                wrong.append(path.relative_to(ROOT).as_posix())
    assert set(wrong) == MIRROR_NOTHING


MIRRORED = (
    "sparc",
    *(
        f"sparc/{package}"
        for package in (
            "checking",
            "explaining",
            "language_server",
            "solving",
            "sorts",
            "syntax",
            "translation",
        )
    ),
    *(
        f"waiter_cli/{package}"
        for package in (
            "answersets",
            "bounds",
            "console",
            "diagnosis",
            "domain_tests",
            "drawing",
            "encoding",
            "evenings",
            "explanation",
            "file_access",
            "files",
            "labels",
            "layout_tools",
            "model",
            "planning",
            "problems",
            "room",
            "rules",
            "translators",
            "yaml_reading",
        )
    ),
)
SMALL = 60  # lines; what is shorter is tested through what uses it


def test_modules_have_tests_of_their_own() -> None:
    """In these packages each module of some size has the test file of its name."""
    missing = [
        path.relative_to(ROOT).as_posix()
        for package in MIRRORED
        for path in sorted((ROOT / package).glob("[a-z]*.py"))
        if len(path.read_text(encoding="utf-8").splitlines()) > SMALL
        and not (ROOT / "tests" / package / f"test_{path.name}").exists()
    ]
    assert not missing
    assert all(list((ROOT / package).glob("[a-z]*.py")) for package in MIRRORED)


def left_out(decorators: list[ast.expr]) -> bool:
    """Whether a test is marked as no part of the default run, all of it."""
    return any(ast.unparse(each) in ("pytest.mark.slow", "pytest.mark.wide") for each in decorators)


def runs_by_default(tree: ast.Module) -> bool:
    """Whether a file has a test that is not left out of the default run."""
    return any(
        node.name.startswith("test_") and not left_out(node.decorator_list)
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
    )


def test_no_file_of_tests_is_left_out_of_the_default_run() -> None:
    """What is wide or slow is the long form of something that runs at each change."""
    files = sorted((ROOT / "tests").rglob("test_*.py"))
    assert not [path for path in files if not runs_by_default(tree_of(path))]
    assert not [
        path
        for path in files
        if re.search(r"^pytestmark.*(slow|wide)", path.read_text(encoding="utf-8"), re.M)
    ]


def test_a_file_that_is_left_out_is_seen() -> None:
    only = "@pytest.mark.{}\ndef test_long():\n    pass\n"
    assert not any(runs_by_default(ast.parse(only.format(tier))) for tier in ("wide", "slow"))
    assert runs_by_default(ast.parse(only.format("jar")))


MIRROR_NOTHING = {  # what they test is no single module
    "tests/sparc/test_front_door.py",
    "tests/sparc/test_golden.py",
    "tests/sparc/test_mistakes.py",
    "tests/waiter_cli/test_front_door.py",
    "tests/waiter_cli/bounds/test_find_bounds.py",
    "tests/waiter_cli/commands/test_help.py",
}


def test_modules_that_packages_name_exist() -> None:
    gone = []
    for name, path in modules().items():
        if path.name != "__init__.py":
            continue
        tree = tree_of(path)
        known = bound_at_all(tree) | {"waiter"} | {each.stem for each in path.parent.iterdir()}
        named = re.findall(r"(?<!`)`([a-z]\w*)`(?!`)", ast.get_docstring(tree) or "")
        gone += [f"{name}: {word}" for word in named if word not in known]
    assert gone == []


def bound_at_all(tree: ast.Module) -> set[str]:
    """The names that a module defines or imports, those inside of functions too."""
    return {word for node in ast.walk(tree) for word in bound(node)}


@pytest.mark.parametrize("module", OWNERS)
def test_the_outside_world_has_owners(module: str) -> None:
    users = {
        path.relative_to(ROOT).as_posix()
        for path in modules().values()
        if module in outside(path, at_import=False)
    }
    assert users == OWNERS[module]


def frozen_by_the_library(path: Path) -> list[str]:
    """The frozen classes of a file that are not made by `sparc.lazy_dataclass`."""
    lazy = any(what == ("sparc.lazy_dataclass", "dataclass") for what in imports(path))
    return [
        node.name
        for node in nodes(path, at_import=False)
        if isinstance(node, ast.ClassDef)
        for decorator in map(ast.unparse, node.decorator_list)
        if "frozen=True" in decorator
        and (not lazy or not decorator.startswith("dataclass(") or "slots=" in decorator)
    ]


def test_every_frozen_class_is_cheap_to_define() -> None:
    """What changes is a standard dataclass; what does not is one of `sparc.lazy_dataclass`."""
    found = {name: frozen_by_the_library(path) for name, path in modules().items()}
    assert not {name: classes for name, classes in found.items() if classes}


# What takes long to load, and where it may be loaded as soon as a module is.
AT_START = {
    "clingo": ("sparc.solving.clingo_solver", "sparc.solving.exact_arithmetic"),
    "PIL": ("waiter_cli.pictures.",),
    "numpy": ("waiter_cli.pictures.",),
    "pygls": ("sparc.language_server.",),
    "lsprotocol": ("sparc.language_server.",),
    "starlette": ("waiter_cli.studio.",),
    "uvicorn": (),
    "dask": (),
    "distributed": (),
    "highspy": (),
    "imageio_ffmpeg": (),
    "matplotlib": (),
    "pybullet": (),
    "rich": (),
    "yaml": (),
}


def test_what_takes_long_is_loaded_where_it_is_needed() -> None:
    for package, owners in AT_START.items():
        users = [n for n, path in modules().items() if package in outside(path, at_import=True)]
        assert not [name for name in users if not name.startswith(owners or ("-",))], package
        assert users or not owners, f"nothing loads {package} any more"


def test_commands_import_heavy_things_in_their_bodies() -> None:
    commands = [
        p for n, p in modules().items() if n.startswith(("waiter_cli.commands.", "waiter_cli.app"))
    ]
    assert len(commands) > 15
    assert not [path.name for path in commands if outside(path, at_import=True) & set(AT_START)]


def test_the_rules_in_plain_python_stand_by_themselves() -> None:
    """The validator shares nothing with what it judges: no SPARC, no clingo, no encoding."""
    allowed = {"sparc.lazy_dataclass"}
    assert sum(name.startswith("waiter_cli.rules.") for name in arrows()) >= LEAST
    for name, others in arrows().items():
        if name.startswith("waiter_cli.rules."):
            assert "clingo" not in outside(modules()[name], at_import=False)
            beyond = {o for o in others if o.startswith("sparc.")} - allowed
            rooms = {room(o) for o in others if o.startswith("waiter_cli.")}
            assert not beyond and rooms <= {"rules", "model", "errors", "__init__"}, name


@pytest.mark.parametrize("library", ["sparc", "waiter_cli"])
def test_importing_the_library_is_nearly_free(library: str) -> None:
    loaded = (
        "{m for m in sys.modules if m.startswith(('sparc.', 'waiter_cli.', 'clingo', 'typing'))}"
    )
    code = f"import sys; before = {loaded}; import {library}; assert {loaded} == before"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=False
    )
    assert done.returncode == 0, done.stderr


def test_the_version_is_told_before_typing_is_loaded() -> None:
    """Which would take longer than all the rest of it."""
    code = (
        "import sys; there = 'typing' in sys.modules; from waiter_cli.app import run; "
        "run(['--version']); assert there or 'typing' not in sys.modules"
    )
    done = subprocess.run(
        [sys.executable, "-S", "-c", code], capture_output=True, text=True, cwd=ROOT, check=False
    )
    assert done.returncode == 0, done.stderr


def test_every_module_says_what_it_is() -> None:
    """A module opens with one sentence of purpose."""
    silent = [
        n for n, p in modules().items() if tree_of(p).body and not ast.get_docstring(tree_of(p))
    ]
    assert not silent


QUESTIONS = re.compile(r"(What|Who|Whom|Whose|How|Where|Whether|Which|If|Why|When)\b")
Documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def questions(tree: ast.Module) -> Iterator[int]:
    """The lines of docstrings that begin with a question's word."""
    for node in ast.walk(tree):
        if isinstance(node, Documented) and QUESTIONS.match(ast.get_docstring(node) or ""):
            yield node.body[0].lineno


def test_docstrings_begin_with_their_subject() -> None:
    """They begin with what is returned, raised or done: ``Returns …``, not ``What …``."""
    assert not [
        f"{name}:{line}" for name, path in modules().items() for line in questions(tree_of(path))
    ]


def test_a_question_is_seen() -> None:
    text = 'def f():\n    """Where it goes."""\ndef g():\n    """Returns where it goes."""\n'
    assert list(questions(ast.parse(text))) == [2]
