"""Prints the output of ``waiter answersets``: answer sets as they come, and how the search ended.

Two writers, one for people and one for programs; stdout has the results, stderr what a person
should know of them.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from waiter_cli.console.output import print_text, say
from waiter_cli.model.wording import counted

if TYPE_CHECKING:
    from sparc.answer_sets import AnswerSet, GroundLiteral
    from waiter_cli.answersets.enumerate import AnswerListing
    from waiter_cli.answersets.timeline import Filter, Timeline

__all__ = ["COMPARED", "JsonWriter", "TextWriter", "Writer"]

HELD = 300_000
"""So many literals of answer sets are held to be put in order; a longer listing is written as it
comes."""
COMPARED = 10 * HELD
"""So many literals of answer sets are compared with each other at most."""


class Writer:
    """A writer of answer sets as they come, and of how the search ended.

    ``exit_code`` is right after `finish`, `count`, `differences`, `nothing` or `undecided`.
    """

    timeline: Timeline
    exit_code = 0

    def write(self, answer_set: AnswerSet) -> None:
        raise NotImplementedError

    def finish(self, answers: AnswerListing, inconsistent: str) -> None:
        raise NotImplementedError

    def count(self, answers: AnswerListing, number: int, inconsistent: str) -> None:
        raise NotImplementedError

    def differences(
        self, answers: AnswerListing, found: list[AnswerSet], inconsistent: str
    ) -> None:
        raise NotImplementedError

    def broken_off(self) -> bool:
        """Ends what was begun, as far as it came; whether anything was."""
        return False

    def note(self, message: str) -> None:
        """Writes a remark about the answer on stderr."""
        _say(message)

    def nothing(self, message: str, reasons: Sequence[Any] = ()) -> None:
        """Writes that there is no answer set, and for which reasons."""
        from waiter_cli.errors import Exit

        self.exit_code = Exit.PROVED
        _say(f"{message}.")
        for reason in reasons:
            where = f"{reason.where}: " if reason.where else ""
            _say(f"  {where}{reason.message}", prefix="")

    def undecided(self, limit: str, found: str = "", most: int | None = None) -> None:
        """A limit came first; ``most`` is the number of --max-steps."""
        from waiter_cli.errors import Exit

        self.exit_code = Exit.UNDECIDED
        words = {
            "time": "the time limit was reached",
            "memory": "the memory ran out",
            "max_steps": f"no plan was found within --max-steps {most}",
        }
        _say(f"{words.get(limit, limit)}{found}.")

    def ended(self, answers: AnswerListing, inconsistent: str, found: str = "") -> None:
        """Sets the exit code, and says what a person should know of it on stderr."""
        if answers.limit_reached is not None:
            Writer.undecided(self, answers.limit_reached, found)
        elif answers.satisfiable is False:
            Writer.nothing(self, inconsistent)
        elif answers.overlooked():
            _say("no literal matches; some would with -i, which takes a for A.")


def _say(message: str, prefix: str = "waiter: ") -> None:
    import sys

    from waiter_cli.console.output import say

    say(f"{prefix}{message}", sys.stderr)


class JsonWriter(Writer):
    """One document, or with ``lines`` one object a line.

    The document is written at the end, in an order of its own; one of more than `HELD` literals is
    written piece by piece, in the order in which the answer sets are found.
    """

    def __init__(self, *, lines: bool) -> None:
        self.lines = lines
        self.found: list[AnswerSet] = []
        self.held = 0
        self.begun = False

    def _texts(self, literals: frozenset[GroundLiteral]) -> list[str]:
        return [str(literal) for literal in self.timeline.sort(literals)]

    def _object(self, answer_set: AnswerSet) -> dict[str, Any]:
        return {"literals": self._texts(answer_set.literals), "cost": list(answer_set.cost)}

    def _print(self, document: dict[str, Any]) -> None:
        print_text(_json(document))
        sys.stdout.flush()

    def write(self, answer_set: AnswerSet) -> None:
        if self.lines:
            self._print(self._object(answer_set))
        elif self.begun:
            print_text(f", {_json(self._object(answer_set))}", end="")
        else:
            self.found.append(answer_set)
            self.held += len(answer_set.literals) + 1
            if self.held > HELD:
                self._begin()

    def _begin(self) -> None:
        """Writes what is held, as the beginning of the document."""
        from sparc.limits import settle

        pieces = ", ".join(_json(self._object(answer_set)) for answer_set in self.found)
        self.found.clear()
        settle()  # a limit ends the search between two answer sets, never half a document
        self.begun = True  # only now: a signal before ends a document that has no beginning
        print_text(f'{{"answer_sets": [{pieces}', end="")

    def _document(self, answers: AnswerListing, **more: Any) -> None:
        document: dict[str, Any] = {
            "satisfiable": answers.satisfiable,
            "complete": answers.complete,
            **more,
        }
        if answers.limit_reached is not None:
            document["limit"] = answers.limit_reached
        self._print(document)

    def _end(self, document: dict[str, Any]) -> None:
        """Writes the rest of a document that has begun."""
        self.begun = False
        print_text(f"], {_json(document)[1:]}")
        sys.stdout.flush()

    def finish(self, answers: AnswerListing, inconsistent: str) -> None:
        if self.begun:
            limit = {} if answers.limit_reached is None else {"limit": answers.limit_reached}
            self._end({"satisfiable": True, "complete": answers.complete, **limit})
        elif self.lines:
            self._document(answers)
        else:
            self._document(answers, answer_sets=self._sorted(answers))
        self.ended(answers, inconsistent)

    def broken_off(self) -> bool:
        if not self.begun:
            return False
        self._end({"satisfiable": True, "complete": False})
        return True

    def _sorted(self, answers: AnswerListing) -> list[dict[str, Any]]:
        """Returns the answer sets as found; in an order of their own where all of them are here."""
        if answers.complete:
            key = self.timeline.key
            self.found.sort(key=lambda each: sorted(map(key, each.literals)))
        return [self._object(answer_set) for answer_set in self.found]

    def count(self, answers: AnswerListing, number: int, inconsistent: str) -> None:
        self._document(answers, count=number)
        self.ended(answers, inconsistent)

    def differences(
        self, answers: AnswerListing, found: list[AnswerSet], inconsistent: str
    ) -> None:
        from sparc.answer_sets import AnswerSet
        from waiter_cli.answersets.timeline import differences

        common, own = differences(found)
        self.found = [AnswerSet(each, whole.cost) for each, whole in zip(own, found, strict=True)]
        self._document(answers, common=self._texts(common), answer_sets=self._sorted(answers))
        self.ended(answers, inconsistent)

    def nothing(self, message: str, reasons: Sequence[Any] = ()) -> None:
        super().nothing(message, reasons)
        from waiter_cli.files.documents import message_document

        listed = [message_document(reason.message, reason.where) for reason in reasons]
        document = {"satisfiable": False, "complete": True}
        self._print({**document, **({} if self.lines else {"answer_sets": []}), "reasons": listed})

    def undecided(self, limit: str, found: str = "", most: int | None = None) -> None:
        super().undecided(limit, found, most)
        document = {"satisfiable": None, "complete": False}
        self._print({**document, **({} if self.lines else {"answer_sets": []}), "limit": limit})


def _json(document: dict[str, Any]) -> str:
    import json

    from waiter_cli.console.streams import printable_json

    return printable_json(json.dumps(document, ensure_ascii=False))


class TextWriter(Writer):
    """A heading for each answer set and each step, one literal a line."""

    def __init__(self, chosen: Filter, negative: bool) -> None:
        self.chosen = chosen
        self.negative = negative
        self.number = 0
        self._left_out = False

    def write(self, answer_set: AnswerSet) -> None:
        from waiter_cli.console.styling import styled

        if self.number:
            print_text("")
        self.number += 1
        cost = f" (cost {', '.join(map(str, answer_set.cost))})" if any(answer_set.cost) else ""
        print_text(styled(f"Answer set {self.number}{cost}", "bold"))
        self._literals(answer_set.literals)

    def _literals(self, literals: frozenset[GroundLiteral]) -> None:
        import sys

        from waiter_cli.console.styling import styled

        visible = [each for each in literals if self.negative or not each.negated]
        self._left_out |= len(visible) < len(literals)
        lines = []
        indent = self._indent()
        for group in self.timeline.groups(visible):
            if self.timeline.has_steps:
                heading = "without a step" if group.step is None else f"step {group.step}"
                lines.append(f"  {styled(heading, 'cyan')}")
            lines.extend(f"{indent}{self._highlighted(str(each))}" for each in group.literals)
        if not visible:
            lines.append(f"{indent}{'(no literal matches)' if self.chosen else '(empty)'}")
        print_text("\n".join(lines))
        sys.stdout.flush()

    def _indent(self) -> str:
        """Returns the literals as text, below the heading of their step where there
        are steps at all.
        """
        return "    " if self.timeline.has_steps else "  "

    def _highlighted(self, text: str) -> str:
        from waiter_cli.console.styling import styled

        pieces, at = [], 0
        for start, end in self.chosen.matches(text):
            pieces += [text[at:start], styled(text[start:end], "bold red")]
            at = end
        return "".join([*pieces, text[at:]])

    def finish(self, answers: AnswerListing, inconsistent: str) -> None:
        if self.number:
            say(f"\n{self._more(answers, self.number)}")
            sys.stdout.flush()
        self.ended(answers, inconsistent, f" after {_sets(self.number)}")

    def _more(self, answers: AnswerListing, number: int) -> str:
        if answers.complete:
            known = "there are no more."
        elif answers.limit_reached or answers.open_end:
            known = "whether there are more is not settled."
        else:
            known = "there are more (-n 0 shows all)."
        hidden = " Negative literals are left out (--negative)." if self._left_out else ""
        return f"{_sets(number)}; {known}{hidden}"

    def count(self, answers: AnswerListing, number: int, inconsistent: str) -> None:
        exact = answers.complete
        print_text(_sets(number) if exact else f"at least {_sets(number)}")
        self.ended(answers, inconsistent)

    def differences(
        self, answers: AnswerListing, found: list[AnswerSet], inconsistent: str
    ) -> None:
        from waiter_cli.answersets.timeline import differences
        from waiter_cli.console.styling import styled

        common, own = differences(found)
        if found:
            shared = counted(len(common), "literal")
            shown = "all of them" if answers.complete else f"all {len(found)} shown here"
            print_text(f"{shared} in {shown}; beyond these:")
        for number, literals in enumerate(own, 1):
            print_text(f"\n{styled(f'Answer set {number}', 'bold')}")
            if literals:
                self._differing(literals)
            else:
                print_text(f"{self._indent()}(nothing more)")
        if found:
            print_text(f"\n{self._more(answers, len(found))}")
        self.ended(answers, inconsistent)

    def _differing(self, literals: frozenset[GroundLiteral]) -> None:
        """Shows negative literals where nothing else tells an answer set apart."""
        kept = self.negative
        self.negative = kept or all(literal.negated for literal in literals)
        self._literals(literals)
        self.negative = kept


def _sets(number: int) -> str:
    return f"{number} answer set{'' if number == 1 else 's'}"
