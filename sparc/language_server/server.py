"""Speaks the Language Server Protocol over standard input and output, by pygls. Entry point `serve`.

Follows the Language Server Protocol 3.17.  Everything that is answered is worked out by `editor_answers`;
here offsets become lines and columns, and values become messages.
"""

from __future__ import annotations

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer

from sparc.errors import SourceError, SourceErrors
from sparc.language_server import editor_answers as answers
from sparc.language_server.document import Document, Finding
from sparc.language_server.symbols import Occurrence

__all__ = ["SparcServer", "serve"]

_SYMBOLS = {
    "sort": lsp.SymbolKind.Enum,
    "predicate": lsp.SymbolKind.Function,
    "constant": lsp.SymbolKind.Constant,
    "label": lsp.SymbolKind.Key,
}
_PROPOSALS = {
    "sort": lsp.CompletionItemKind.Enum,
    "predicate": lsp.CompletionItemKind.Function,
    "constant": lsp.CompletionItemKind.Constant,
    "variable": lsp.CompletionItemKind.Variable,
    "value": lsp.CompletionItemKind.EnumMember,
    "keyword": lsp.CompletionItemKind.Keyword,
}
_COLOURS = {
    "sort": "type",
    "predicate": "function",
    "constant": "macro",
    "variable": "variable",
    "label": "label",
    "value": "enumMember",
}
_LEGEND = lsp.SemanticTokensLegend(
    [_COLOURS[kind] for kind in answers.TOKEN_KINDS], ["declaration"]
)


class SparcServer(LanguageServer):
    """A language server with the documents that are open, by address."""

    def __init__(self, version: str) -> None:
        super().__init__("sparc", version)
        self.documents: dict[str, Document] = {}

    def keep(self, uri: str) -> Document:
        """Returns the document as the editor has it now; its faults are sent to the editor."""
        open_file = self.workspace.get_text_document(uri)
        document = Document(
            uri,
            open_file.source,
            self.documents.get(uri),
            lsp.PositionEncodingKind(self.workspace.position_encoding).value,
        )
        self.documents[uri] = document
        diagnostics = [_diagnostic(document, finding) for finding in document.findings]
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(uri, diagnostics, open_file.version)
        )
        return document

    def document(self, uri: str) -> Document:
        """Returns the document as it was kept last."""
        return self.documents.get(uri) or self.keep(uri)

    def place(self, at: lsp.TextDocumentIdentifier, position: lsp.Position) -> tuple[Document, int]:
        """Returns the document and the offset that a request is about."""
        document = self.document(at.uri)
        return document, document.positions.offset(position.line, position.character)


def _range(document: Document, start: int, end: int) -> lsp.Range:
    return lsp.Range(
        lsp.Position(*document.positions.of(start)), lsp.Position(*document.positions.of(end))
    )


def _diagnostic(document: Document, finding: Finding) -> lsp.Diagnostic:
    severity = lsp.DiagnosticSeverity
    return lsp.Diagnostic(
        range=_range(document, finding.start, finding.end),
        message=finding.message + (f"\n{finding.mend}" if finding.mend else ""),
        severity=severity.Error if finding.severity == "error" else severity.Warning,
        source="sparc",
    )


def _locations(uri: str, document: Document, names: tuple[Occurrence, ...]) -> list[lsp.Location]:
    return [lsp.Location(uri, _range(document, each.start, each.end)) for each in names]


def serve(version: str) -> None:
    """Answers an editor over standard input and output until it says that it goes.

    The streams are copies: pygls closes what it speaks through.
    """
    import os

    with open(os.dup(0), "rb") as heard, open(os.dup(1), "wb") as said:
        make(version).start_io(heard, said)


def make(version: str) -> SparcServer:
    """Returns a server with everything that it can be asked."""
    server = SparcServer(version)
    _documents(server)
    _questions(server)
    _changes(server)
    return server


def _documents(server: SparcServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: lsp.DidOpenTextDocumentParams) -> None:
        server.keep(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: lsp.DidChangeTextDocumentParams) -> None:
        server.keep(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        uri = params.text_document.uri
        server.documents.pop(uri, None)
        server.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri, []))


def _questions(server: SparcServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        document, offset = server.place(params.text_document, params.position)
        text = answers.hover(document, offset)
        if text is None:
            return None
        return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, text))

    @server.feature(
        lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=["#", "("])
    )
    def complete(params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
        document, offset = server.place(params.text_document, params.position)
        start = offset
        while start > 0 and (
            document.text[start - 1].isalnum() or document.text[start - 1] in "_#"
        ):
            start -= 1
        stretch = _range(document, start, offset)
        return [
            lsp.CompletionItem(
                each.text,
                kind=_PROPOSALS[each.kind],
                detail=each.detail or None,
                sort_text=f"{number:05}",
                filter_text=each.text,
                text_edit=lsp.TextEdit(stretch, each.text),
            )
            for number, each in enumerate(answers.complete(document, offset))
        ]

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> list[lsp.Location]:
        document, offset = server.place(params.text_document, params.position)
        one = document.at(offset)
        occurrence = document.definition(one) if one is not None else None
        return _locations(params.text_document.uri, document, (occurrence,) if occurrence else ())

    @server.feature(lsp.TEXT_DOCUMENT_REFERENCES)
    def references(params: lsp.ReferenceParams) -> list[lsp.Location]:
        document, offset = server.place(params.text_document, params.position)
        one = document.at(offset)
        same = document.same(one) if one is not None else ()
        references = tuple(e for e in same if params.context.include_declaration or not e.defines)
        return _locations(params.text_document.uri, document, references)

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
    def highlight(params: lsp.DocumentHighlightParams) -> list[lsp.DocumentHighlight]:
        document, offset = server.place(params.text_document, params.position)
        one = document.at(offset)
        same = document.same(one) if one is not None else ()
        return [lsp.DocumentHighlight(_range(document, e.start, e.end)) for e in same]

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def symbols(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        document = server.document(params.text_document.uri)
        symbols = []
        for each in answers.declared(document):
            stretch = _range(document, each.start, each.end)
            name = f"#{each.name}" if each.kind == "sort" else each.name
            symbols.append(lsp.DocumentSymbol(name, _SYMBOLS[each.kind], stretch, stretch))
        return symbols

    @server.feature(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, _LEGEND)
    def tokens(params: lsp.SemanticTokensParams) -> lsp.SemanticTokens:
        document = server.document(params.text_document.uri)
        data: list[int] = []
        line = column = 0
        for each in answers.marked(document):
            (at, start), (_, end) = (
                document.positions.of(each.start),
                document.positions.of(each.end),
            )
            kind = answers.TOKEN_KINDS.index(each.kind)
            data += [
                at - line,
                start - column if at == line else start,
                end - start,
                kind,
                int(each.defines),
            ]
            line, column = at, start
        return lsp.SemanticTokens(data)


def _changes(server: SparcServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_PREPARE_RENAME)
    def prepare(params: lsp.PrepareRenameParams) -> lsp.Range | None:
        document, offset = server.place(params.text_document, params.position)
        one = document.at(offset)
        return _range(document, one.start, one.end) if one is not None else None

    @server.feature(lsp.TEXT_DOCUMENT_RENAME, lsp.RenameOptions(prepare_provider=True))
    def rename(params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
        document, offset = server.place(params.text_document, params.position)
        one = document.at(offset)
        new = params.new_name.removeprefix("#")
        if one is None:
            told = "there is no name here: put the cursor on one"
            raise JsonRpcException(told, code=lsp.LSPErrorCodes.RequestFailed)
        refusal = answers.refusal_of_name(document, one, new)
        if refusal is not None:
            raise JsonRpcException(refusal, code=lsp.LSPErrorCodes.RequestFailed)
        edits = [lsp.TextEdit(_range(document, e.start, e.end), new) for e in document.same(one)]
        return lsp.WorkspaceEdit(changes={params.text_document.uri: edits})

    @server.feature(lsp.TEXT_DOCUMENT_FORMATTING)
    def formatting(params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
        from sparc.syntax.formatter import format_program

        document = server.keep(params.text_document.uri)
        try:
            text = format_program(document.source)
        except (SourceError, SourceErrors):  # its faults are shown already
            return []
        if text == document.text:
            return []
        return [lsp.TextEdit(_range(document, 0, len(document.text)), text)]

    @server.feature(
        lsp.TEXT_DOCUMENT_CODE_ACTION, lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix])
    )
    def actions(params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        uri = params.text_document.uri
        document = server.document(uri)
        wanted = params.range
        start = document.positions.offset(wanted.start.line, wanted.start.character)
        end = document.positions.offset(wanted.end.line, wanted.end.character)
        return [
            lsp.CodeAction(
                fix.title,
                kind=lsp.CodeActionKind.QuickFix,
                diagnostics=[_diagnostic(document, finding)],
                edit=lsp.WorkspaceEdit(
                    changes={uri: [lsp.TextEdit(_range(document, fix.start, fix.end), fix.new)]}
                ),
                is_preferred=True,
            )
            for finding in document.findings
            if finding.start <= end and start <= finding.end
            for fix in answers.fixes(document, finding)
        ]
