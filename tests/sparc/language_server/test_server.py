"""A whole editing session: a real client starts the server and talks to it."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Awaitable, Callable, Iterable
from typing import Any

import pytest

pytest.importorskip("pygls", reason="the extra lsp is not installed")

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.client import LanguageClient

from sparc.source import Source
from sparc.syntax.formatter import format_program
from tests.support.paths import ROOT
from tests.support.sampling import mostly_wide

URI = "file:///family.sparc"
PROGRAM = """\
sorts
% Those who live here.
#person = {ann, ben, carla}.
predicates
% X is a parent of Y.
parent(#person, #person).
old(#person).
rules
parent(ann, ben). parent(ben, carla).
old(X) :- parent(X, Y), parent(Y, Z), X != Z.
"""


class Session:
    """One client, one server, one document."""

    def __init__(self, client: LanguageClient) -> None:
        self.client = client
        self.version = 0
        self.found: asyncio.Queue[lsp.PublishDiagnosticsParams] = asyncio.Queue()

    async def show(self, text: str) -> list[lsp.Diagnostic]:
        """Gives the server a text and returns what it finds in it."""
        self.version += 1
        if self.version == 1:
            item = lsp.TextDocumentItem(URI, "sparc", self.version, text)
            self.client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        else:
            whole = lsp.TextDocumentContentChangeWholeDocument(text)
            versioned = lsp.VersionedTextDocumentIdentifier(self.version, URI)
            self.client.text_document_did_change(
                lsp.DidChangeTextDocumentParams(versioned, [whole])
            )
        while True:
            params = await asyncio.wait_for(self.found.get(), 20)
            if params.version == self.version:
                return list(params.diagnostics)

    def at(self, text: str, piece: str, behind: int = 0) -> dict[str, Any]:
        """The place of a piece of a text, as requests take it."""
        offset = text.index(piece) + behind
        before = text[:offset]
        line = before.count("\n")
        place = lsp.Position(line, offset - (before.rfind("\n") + 1))
        return {"text_document": lsp.TextDocumentIdentifier(URI), "position": place}


def session(
    steps: Callable[[Session], Awaitable[None]],
    encoding: lsp.PositionEncodingKind = lsp.PositionEncodingKind.Utf16,
) -> None:
    """Runs steps with a server that was started for them, and sees it end well."""

    async def run() -> int | None:
        client = LanguageClient("tests", "1")
        await client.start_io(sys.executable, "-m", "waiter_cli", "sparc", "lsp", cwd=str(ROOT))
        process = client._server
        talk = Session(client)

        @client.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def published(params: lsp.PublishDiagnosticsParams) -> None:
            talk.found.put_nowait(params)

        general = lsp.GeneralClientCapabilities(position_encodings=[encoding])
        begun = await client.initialize_async(
            lsp.InitializeParams(lsp.ClientCapabilities(general=general))
        )
        assert begun.capabilities.position_encoding == encoding
        client.initialized(lsp.InitializedParams())
        await steps(talk)
        await client.shutdown_async(None)
        client.exit(None)
        code = await asyncio.wait_for(process.wait(), 20) if process is not None else None
        await client.stop()
        return code

    assert asyncio.run(run()) == 0


def spans(diagnostics: list[lsp.Diagnostic]) -> list[tuple[int, int]]:
    return [(each.range.start.line, each.range.start.character) for each in diagnostics]


def test_a_whole_session() -> None:
    async def steps(talk: Session) -> None:
        client = talk.client
        # Writing: three slips, each at its place; a fix; then none is left.
        bad = PROGRAM.replace(":-", "<-").replace("parent(ann, ben).", "parent(ann ben).")
        found = await talk.show(bad)
        assert spans(found) == [(8, 11), (9, 7)]
        assert all(each.severity is lsp.DiagnosticSeverity.Error for each in found)
        fixes = await client.text_document_code_action_async(
            lsp.CodeActionParams(
                lsp.TextDocumentIdentifier(URI), found[1].range, lsp.CodeActionContext(found)
            )
        )
        (fix,) = fixes or []
        assert isinstance(fix, lsp.CodeAction) and fix.edit and fix.edit.changes
        assert [edit.new_text for edit in fix.edit.changes[URI]] == [":-"]
        misspelt = PROGRAM.replace("parent(X, Y)", "parnt(X, Y)")
        found = await talk.show(misspelt)
        assert spans(found) == [(9, 10)]
        fixes = await client.text_document_code_action_async(
            lsp.CodeActionParams(
                lsp.TextDocumentIdentifier(URI), found[0].range, lsp.CodeActionContext(found)
            )
        )
        assert [fix.title for fix in fixes or []] == ["Write parent"]
        assert await talk.show(PROGRAM) == []

        # Asking.
        hover = await client.text_document_hover_async(
            lsp.HoverParams(**talk.at(PROGRAM, "parent(X, Y)", 2))
        )
        assert hover is not None and isinstance(hover.contents, lsp.MarkupContent)
        assert "parent(#person,#person)" in hover.contents.value.replace(" ", "")
        assert "X is a parent of Y." in hover.contents.value
        hover = await client.text_document_hover_async(
            lsp.HoverParams(**talk.at(PROGRAM, "#person, ", 3))
        )
        assert hover is not None and isinstance(hover.contents, lsp.MarkupContent)
        assert "{ann, ben, carla}" in hover.contents.value
        assert "Those who live here." in hover.contents.value
        defined = await client.text_document_definition_async(
            lsp.DefinitionParams(**talk.at(PROGRAM, "old(X)"))
        )
        assert isinstance(defined, list)
        assert [(at.range.start.line, at.range.start.character) for at in defined] == [(6, 0)]
        used = await client.text_document_references_async(
            lsp.ReferenceParams(
                **talk.at(PROGRAM, "parent(ann"), context=lsp.ReferenceContext(False)
            )
        )
        assert [at.range.start.line for at in used or []] == [8, 8, 9, 9]
        symbols = await client.text_document_document_symbol_async(
            lsp.DocumentSymbolParams(lsp.TextDocumentIdentifier(URI))
        )
        assert [each.name for each in symbols or []] == ["#person", "parent", "old"]

        # Completing: sorts behind a hash, the values of the argument's sort, variables.
        async def proposed(text: str, piece: str) -> list[str]:
            await talk.show(text)
            place = talk.at(text, piece, len(piece))
            items = await client.text_document_completion_async(lsp.CompletionParams(**place))
            assert isinstance(items, list)
            return [item.label for item in items]

        assert (await proposed(PROGRAM + "old(X) :- #pe", ":- #pe"))[0] == "#person"
        assert (await proposed(PROGRAM + "old(", "\nold("))[:3] == ["ann", "ben", "carla"]
        assert "parent" in await proposed(PROGRAM + "old(X) :- pa", ":- pa")
        await talk.show(PROGRAM)

        # Changing.
        renamed = await client.text_document_rename_async(
            lsp.RenameParams(**talk.at(PROGRAM, "X) :-"), new_name="Elder")
        )
        assert renamed is not None and renamed.changes is not None
        assert len(renamed.changes[URI]) == 3
        for piece, name, why in (
            ("X) :-", "lower", "from a capital letter on"),
            ("X) :-", "Z", "there is a variable Z in this rule already"),
            ("old(X)", "parent", "there is a predicate parent already"),
            ("ann, ben)", "carla", "there is a value carla already"),
            ("person, ", "sum", "a word of the language"),
            ("% Those", "name", "there is no name here"),
        ):
            with pytest.raises(JsonRpcException, match=why):
                await client.text_document_rename_async(
                    lsp.RenameParams(**talk.at(PROGRAM, piece), new_name=name)
                )
        await talk.show(PROGRAM.replace("X != Z", "X!=Z"))
        edits = await client.text_document_formatting_async(
            lsp.DocumentFormattingParams(
                lsp.TextDocumentIdentifier(URI), lsp.FormattingOptions(4, True)
            )
        )
        assert edits is not None and "X != Z" in edits[0].new_text
        tokens = await client.text_document_semantic_tokens_full_async(
            lsp.SemanticTokensParams(lsp.TextDocumentIdentifier(URI))
        )
        assert tokens is not None and len(tokens.data) % 5 == 0 and len(tokens.data) > 50
        assert {type(number) for number in tokens.data} == {int}, "the protocol knows integers"

    session(steps)


def applied(text: str, edits: Iterable[lsp.TextEdit], encoding: str) -> str:
    """The text after an editor's edits, by the columns of an encoding."""
    unit = {"utf-8": 1, "utf-16-le": 2, "utf-32-le": 4}[encoding]
    lines = [line.encode(encoding) for line in text.splitlines(keepends=True)] or [b""]

    def offset(at: lsp.Position) -> int:
        return len(b"".join(lines[: at.line])) + at.character * unit

    whole = text.encode(encoding)
    for edit in edits:  # one at most
        start, end = offset(edit.range.start), offset(edit.range.end)
        whole = whole[:start] + edit.new_text.encode(encoding) + whole[end:]
    return whole.decode(encoding)


@pytest.mark.parametrize(
    "kind", mostly_wide(lsp.PositionEncodingKind, lsp.PositionEncodingKind.Utf16)
)
def test_columns_are_counted_as_the_editor_counts(kind: lsp.PositionEncodingKind) -> None:
    """Signs of several bytes, and beyond the basic plane, before a name, a fault and the end."""
    encoding = kind.value if kind.value == "utf-8" else f"{kind.value}-le"
    unit = {"utf-8": 1, "utf-16": 2, "utf-32": 4}[kind.value]
    slip = (
        PROGRAM + "old(ann) :\u2013 old(ben). \u2013 \U0001f600 olt(ann).\n% caf\u00e9 \U0001f600"
    )
    line = slip.splitlines()[10]

    async def steps(talk: Session) -> None:
        client = talk.client
        found = await talk.show(slip)
        columns = [each.range.start.character for each in found if each.range.start.line == 10]
        places = [line.index(":\u2013"), line.index("\u2013 \U0001f600")]
        assert columns[:2] == [len(line[:at].encode(encoding)) // unit for at in places]
        good = PROGRAM.replace("X != Z", "X!=Z") + "old(ann). % caf\u00e9 \U0001f600"
        assert await talk.show(good) == []
        edits = await client.text_document_formatting_async(
            lsp.DocumentFormattingParams(
                lsp.TextDocumentIdentifier(URI), lsp.FormattingOptions(4, True)
            )
        )
        assert applied(good, edits or [], encoding) == format_program(Source("f", good))

    session(steps, kind)


@pytest.mark.parametrize("end", mostly_wide(["\r\n", "\n"], "\r\n"))
def test_lines_end_as_the_file_has_it(end: str) -> None:
    text = (PROGRAM + "old(X) :- parnt(X, ben).\n").replace("\n", end)

    async def steps(talk: Session) -> None:
        assert spans(await talk.show(text)) == [(10, 10)]

    session(steps)
