"""``waiter sparc format``: a program in the one style."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated

import typer

from waiter_cli.commands.options import JsonOption

if TYPE_CHECKING:
    from waiter_cli.errors import InputError

__all__ = ["format_file"]

BOM = b"\xef\xbb\xbf"


def format_file(
    files: Annotated[
        list[str],
        typer.Argument(metavar="FILE...", help="SPARC programs; - is standard input."),
    ],
    in_place: Annotated[
        bool, typer.Option("--in-place", "-i", help="Change the files themselves.")
    ] = False,
    as_json: JsonOption = False,
) -> int:
    """Lay programs out in one style; comments stay, and the program means the same.

    Lines are broken where the author broke them. A file with a fault of syntax is left as it is.

    \b
    Examples:
      waiter sparc format family.sparc
      waiter sparc format -i family.sparc
    """
    from waiter_cli.console.output import print_json, say

    if not in_place and len(files) > 1:
        raise _usage("several files are formatted in place only", "add -i")
    if in_place and "-" in files:
        raise _usage("standard input cannot be changed in place", "leave out -i")
    done = []
    for name in files:
        before, after = _formatted(name)
        if in_place and after != before:
            from waiter_cli.file_access.atomic import write_whole

            write_whole(name, after)
        done.append({"file": name, "changed": after != before})
        if not in_place and not as_json:
            _write_out(after)
        elif not as_json and after != before:
            say(f"formatted {name}")
    if as_json:
        print_json({"status": "formatted", "in_place": in_place, "files": done})
    return 0


def _write_out(data: bytes) -> None:
    """Writes bytes to standard output as they are, where that takes bytes and is no terminal."""
    stream = None if sys.stdout.isatty() else getattr(sys.stdout, "buffer", None)
    if stream is None:
        from waiter_cli.console.output import print_document

        print_document(data.decode("utf-8", "replace").replace("\r\n", "\n"))
    else:
        sys.stdout.flush()
        stream.write(data)
        stream.flush()


def _usage(message: str, mend: str) -> InputError:
    from waiter_cli.errors import Fault, InputError, Where

    return InputError([Fault(Where("waiter sparc format"), message, mend)])


def _formatted(name: str) -> tuple[bytes, bytes]:
    """Returns the bytes of a file before and after; bytes beyond ASCII stand in comments and stay."""
    from sparc.reading import program
    from sparc.source import Source
    from sparc.syntax.formatter import format_program
    from sparc.syntax.parser import parse
    from waiter_cli.file_access.sparc_file import read_program_bytes, require_no_other_kind

    before = read_program_bytes(name)
    shown = "<stdin>" if name == "-" else name
    source = program(before, shown)
    require_no_other_kind(source)
    parse(source)  # so that its faults are told as from every other door
    mark = BOM if before.startswith(BOM) else b""
    raw = before[len(mark) :]
    try:
        text, encoding = raw.decode("utf-8"), "utf-8"
    except UnicodeDecodeError:
        text, encoding = raw.decode("latin-1"), "latin-1"
    after = format_program(Source(shown, text))
    if "\r\n" in text:
        after = after.replace("\n", "\r\n")
    return before, mark + after.encode(encoding)
