"""A whole editing session: a real client starts the server and talks to it."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Awaitable, Callable
from typing import Any

import pytest

pytest.importorskip("pygls", reason="the extra lsp is not installed")

from lsprotocol import types as lsp
from pygls.lsp.client import LanguageClient

from tests.support.paths import ROOT

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


def session(steps: Callable[[Session], Awaitable[None]]) -> None:
    """Runs steps with a server that was started for them, and sees it end well."""

    async def run() -> int | None:
        client = LanguageClient("tests", "1")
        await client.start_io(sys.executable, "-m", "waiter_cli", "sparc", "lsp", cwd=str(ROOT))
        process = client._server
        talk = Session(client)

        @client.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def published(params: lsp.PublishDiagnosticsParams) -> None:
            talk.found.put_nowait(params)

        await client.initialize_async(lsp.InitializeParams(lsp.ClientCapabilities()))
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
        refused = await client.text_document_rename_async(
            lsp.RenameParams(**talk.at(PROGRAM, "X) :-"), new_name="lower")
        )
        assert refused is None
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

    session(steps)
