"""What a domain of one's own has words for."""

from __future__ import annotations

from dataclasses import replace

import waiter_cli
from sparc.source import Source
from waiter_cli.domain_execution.vocabulary import Vocabulary, vocabulary_of
from waiter_cli.encoding.domains import Domain
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.files.state_reader import state_of_layout

REPORT = read_layout_file("report")


def vocabulary(domain: Domain) -> Vocabulary:
    return vocabulary_of(domain, REPORT, state_of_layout(REPORT)[0])


def terms(found: Vocabulary, *guests: str) -> tuple[list[str], list[str]]:
    """The observables and the fluents, with these guests inside."""
    seen, kept = (
        [phrase.term for form in forms for phrase in form.phrases(guests)]
        for forms in (found.observables, found.fluents)
    )
    return seen, kept


def test_what_only_the_domain_knows_is_listed() -> None:
    found = vocabulary(waiter_cli.find_domain("housekeeping"))
    seen, kept = terms(found)
    assert seen == ["spilled(table1)", "spilled(table2)"]
    assert kept == ["isdirty(table1)", "isdirty(table2)"]


def test_guests_are_those_who_are_inside_and_names_alone_are_words_too() -> None:
    shipped = waiter_cli.find_domain("housekeeping")
    more = "+ isdirty(#table) + isangry(#customer) + {closed}."
    text = shipped.template.text.replace("+ isdirty(#table).", more)
    found = vocabulary(replace(shipped, template=Source("own.sparc", text)))
    assert terms(found)[1] == ["isdirty(table1)", "isdirty(table2)", "closed"]
    assert "isangry(ada)" in terms(found, "ada")[1]


def test_the_house_has_no_words_of_its_own() -> None:
    assert vocabulary(waiter_cli.find_domain("restaurant")) == Vocabulary()
