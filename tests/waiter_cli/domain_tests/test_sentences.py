"""A template's statements with the sentences above them: read, found, and shown."""

from __future__ import annotations

from tests.support.domain_cases import domain
from waiter_cli.domain_tests.sentences import page, read_blocks, sentence_at, shown_lines

TEXT = """\
% What it is about.
sorts
#node = {a, b}.
rules
% ---- walking ----

% It walks
% along edges.
at(N) :- go(N).
at(M) :- go(M).   % a comment beside it

% Seldom.
%? bar
% It fills jugs.
full(J) :- fill(J).
%.

bare(x).
"""


def test_blocks_have_their_section_sentence_and_lines() -> None:
    blocks = read_blocks(TEXT)
    assert [(block.section, block.sentence, [n for n, _ in block.lines]) for block in blocks] == [
        ("sorts", "", [3]), ("walking", "It walks along edges.", [9, 10]),
        ("walking", "It fills jugs.", [15]), ("walking", "", [18]),
    ]  # fmt: skip
    assert [block.line for block in blocks] == [3, 7, 14, 18]


def test_a_block_inside_a_part_belongs_to_it() -> None:
    assert [block.parts for block in read_blocks(TEXT)] == [(), (), ("bar",), ()]


def test_a_line_has_the_sentence_above_it() -> None:
    blocks = read_blocks(TEXT)
    assert sentence_at(blocks, 10) == "It walks along edges."
    assert sentence_at(blocks, 18) == "" == sentence_at(blocks, 1)


def test_a_text_is_found_in_all_that_is_said_of_a_block() -> None:
    _, walking, bar, _ = read_blocks(TEXT)
    for text in ("WALK", "along", "go(m)"):
        assert walking.mentions(text)
    assert bar.mentions("bar") and not bar.mentions("along")


def test_lines_are_shown_with_their_numbers_and_fit() -> None:
    shown = list(shown_lines(read_blocks(TEXT), 40))
    assert ("section", "walking") in shown and ("sentence", "      It walks along edges.") in shown
    assert ("text", "   9  at(N) :- go(N).") in shown
    assert ("sentence", "      It fills jugs. [only with: bar]") in shown
    assert all(len(line) <= 40 for _, line in shown)


def test_long_statements_are_folded_outside_of_parentheses() -> None:
    text = f"rules\nat(N) :- {', '.join(f'edge(n{k}, n{k + 1})' for k in range(9))}.\n"
    lines = [line for style, line in shown_lines(read_blocks(text), 50) if style == "text"]
    assert len(lines) > 3 and all(len(line) <= 50 for line in lines)
    assert all(line.count("(") == line.count(")") for line in lines)
    assert "".join("".join(line.split()) for line in lines)[1:] == "".join(text.split())[5:]


def test_a_page_has_a_heading_for_each_section() -> None:
    text = page(read_blocks(TEXT))
    assert text.count("## ") == 2 and "## Walking\n\nIt walks along edges.\n\n```\nat(N)" in text
    assert "It fills jugs. *(Only with bar.)*" in text


def test_every_statement_of_a_shipped_domain_stands_in_some_block() -> None:
    template = domain("restaurant")[0].text
    listed = {number for block in read_blocks(template) for number, _ in block.lines}
    for number, line in enumerate(template.split("\n"), 1):
        bare = line.strip()
        if bare and bare[0] != "%" and bare not in ("sorts", "predicates", "rules", "display"):
            assert number in listed, line
