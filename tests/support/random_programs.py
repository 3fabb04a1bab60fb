"""Random small SPARC programs that stay clear of the known defects of sparc.jar.

`random_program` draws from sorts of every kind, rules with default and strong negation,
arithmetic, records, choices, aggregates, disjunction and consistency-restoring rules; the same
seed gives the same program.  Kept out, as the jar gets them wrong: ``_`` twice in a rule, choice
bounds behind a relation, sort atoms and strong negation in conditions of choices, intersections of records, optimization and weak
constraints, variables under ``/`` only, arithmetic on variables that have a sort in an
aggregate only (see docs/sparc-dialect.md).
"""

from __future__ import annotations

from random import Random

__all__ = ["random_program"]

NUMBERS = ("low", "high", "mixed")
NAMES = ("name", "other", "mixed")
RECORDS = ("fluent", "pair", "listed")
VARIABLES = "XYZUVW"


class _Writer:
    def __init__(self, seed: int) -> None:
        self.random = Random(seed)
        draw = self.random
        self.predicates: dict[str, tuple[str, ...]] = {}
        for letter in "pqrst"[: draw.randint(3, 5)]:
            self.predicates[letter] = tuple(
                draw.choice(("low", "high", "mixed", "name", "name", "other", "fluent", "pair", "listed", "union"))
                for _ in range(draw.randint(0, 2))
            )  # fmt: skip
        self.used: list[str] = []
        self.anonymous = False

    def sorts(self) -> list[str]:
        draw = self.random
        high = draw.randint(2, 3)
        test = draw.choice(
            ("X != Y", "X = Y", "not(X = Y)", "X < Y", "X >= Y or Y = X", "X != Y and X <= Y")
        )
        return [
            f"#low = 0..{high}.",
            f"#high = {draw.randint(0, 2)}..{draw.randint(3, 5)}.",
            draw.choice(("#name = {a,b,c}.", "#name = a..c.", "#name = [a][1..2].", "#name = {a,b} + {c}.")),
            draw.choice(("#other = {b,d}.", "#other = #name - {a} + {d}.", "#other = #name * {b,c} + {b}.", "#other = [b,d].")),
            draw.choice(("#mixed = #low + {a}.", "#mixed = {a,1,2}.", "#mixed = #name + {1}.")),
            draw.choice(("#fluent = f(#name).", "#fluent = f(#name) + g(#low).", "#fluent = f(#name) + g(#low,#name).")),
            draw.choice((f"#pair = h(#low(X),#low(Y)) : {test}.", "#pair = h(#name(X),#name(Y)) : X != Y.", "#pair = h(#low,#name).")),
            draw.choice(("#listed = {k(a,1), k(b,2), c}.", "#listed = {f(a), a, k(b,1)}.", "#listed = #fluent - {f(b)}.")),
            draw.choice(("#union = #fluent + #name.", "#union = #fluent + #listed.", "#union = #low + #pair + {f(a)}.")),
        ]  # fmt: skip

    def term(self, sort: str, ground: bool = False) -> str:
        draw = self.random
        kind = draw.random()
        if not ground and kind < 0.55:
            if kind < 0.03 and not self.anonymous:
                self.anonymous = True
                return "_"
            name = draw.choice(VARIABLES[: draw.choice((2, 3, 4))])
            self.used.append(name)
            return name
        if sort in NUMBERS and not ground and kind < 0.75 and self.used:
            # A variable that stands elsewhere too, so that it does not range over #nat.
            operation = draw.choice(("+1", "-1", "*2", "+2"))
            if sort != "mixed" and operation:
                return draw.choice(self.used) + operation
        if sort in ("low", "high"):
            return str(draw.randint(2, 2))
        if sort in ("fluent", "union", "listed") and not ground and kind < 0.9:
            return f"f({self.term('name')})"
        if sort == "pair" and not ground:
            return f"h({self.term('low')},{self.variable()})"
        return {"name": "A", "other": "b", "mixed": "1", "fluent": "F", "pair": "P"}.get(sort, "")

    def variable(self) -> str:
        name = self.random.choice(VARIABLES[:3])
        self.used.append(name)
        return name

    def atom(self, ground: bool = False) -> str:
        draw = self.random
        name, sorts = draw.choice(list(self.predicates.items()))
        sign = "-" if draw.random() < 0.2 else ""
        if not sorts:
            return sign + name
        terms = [self.term(sort, ground) for sort in sorts]
        # Whatever has no simple ground form becomes a variable, which fits every sort.
        terms = [
            term if term and term not in ("A", "F", "P") else self.variable() for term in terms
        ]
        return f"{sign}{name}({','.join(terms)})"

    def literal(self) -> str:
        draw = self.random
        kind = draw.random()
        if kind < 0.6:
            return self.atom()
        if kind < 0.85:
            return "not " + self.atom()
        if kind < 0.9:
            return f"#{draw.choice(('low', 'name', 'mixed', 'fluent', 'pair'))}({self.variable()})"
        if self.used:
            right = draw.choice(
                (draw.choice(self.used), "1", "a", "zzz", draw.choice(self.used) + "+1")
            )
            operator = draw.choice(("=", "!=", "<", "<=", ">", ">="))
            left = draw.choice(self.used)
            return f"{left} {operator} {right}"
        return self.atom()

    def aggregate(self) -> str:
        draw = self.random
        name, sorts = draw.choice(
            [item for item in self.predicates.items() if item[1]] or [("p", ("low",))]
        )
        terms = [draw.choice(("M", "N")) if draw.random() < 0.8 else self.variable() for _ in sorts]
        tuple_terms = sorted({term for term in terms if term in "MN"}) or ["1"]
        condition = f"{name}({','.join(terms)})"
        if draw.random() < 0.3:
            condition += f", {terms[0]} != {draw.choice(('1', 'a', 'b'))}"
        kind = draw.random()
        if kind < 0.2:
            condition += f", not {self.atom()}"
        elif kind < 0.3 and sorts[0] in ("low", "high"):
            condition += f", {terms[0]}+1 > {draw.randint(1, 3)}"
        elif kind < 0.4:
            condition += f", #{draw.choice(('low', 'name', 'mixed'))}({terms[-1]})"
        function = draw.choice(("count", "count", "sum", "min", "max"))
        guard = f" {draw.choice(('=', '!=', '<', '>=', '>'))} {draw.randint(0, 3)}"
        return f"#{function}{{{','.join(tuple_terms)} : {condition}}}{guard}"

    def body(self) -> list[str]:
        draw = self.random
        items = [self.literal() for _ in range(draw.choice((0, 1, 1, 2, 2, 3)))]
        if draw.random() < 0.15:
            used = list(self.used)
            items.append(self.aggregate())
            self.used = used  # what stands in the aggregate alone has no sort outside it
        return items

    def statement(self) -> str:
        draw = self.random
        self.used = []
        self.anonymous = False
        body = self.body()
        kind = draw.random()
        if kind < 0.1 and body:
            return f":- {', '.join(body)}."
        if kind < 0.25:
            bound = draw.choice(("", "1", "1", "2"))
            upper = draw.choice(("", bound))
            elements = []
            for _ in range(draw.choice((1, 1, 2))):
                element = self.atom()
                if draw.random() < 0.3:
                    element += " : " + self.atom().lstrip("-")  # it cannot part ":" and "-"
                elements.append(element)
            head = f"{bound}{{{'; '.join(elements)}}}{upper}"
        elif kind < 0.35:
            head = f"{self.atom()} | {self.atom()}"
        elif kind < 0.4:
            return (
                f"{self.atom()} :+ {', '.join(item for item in body if '#' not in item)}.".replace(
                    "+ .", "+ ."
                )
            )
        else:
            head = self.atom()
        return f"{head} :- {', '.join(body)}." if body else f"{head}."


def random_program(seed: int) -> str:
    """A program of some five to nine statements."""
    writer = _Writer(seed)
    sorts = writer.sorts()
    rules = [writer.statement() for _ in range(writer.random.randint(4, 8))]
    display = ""
    if writer.random.random() < 0.15 and not any("{" in rule for rule in rules):
        # (The jar lists every set, however few it then shows.)
        display = f"display\n{writer.random.choice(list(writer.predicates))}.\n"
    if any(":+" in rule for rule in rules):
        # Where no such rule can fire the jar shows one answer set of many.
        writer.predicates["live"] = ()
        rules.append("live :+ .")
    declarations = [
        f"{name}({','.join('#' + sort for sort in sorts_of)})."
        for name, sorts_of in writer.predicates.items()
    ]
    return "\n".join(["sorts", *sorts, "predicates", *declarations, "rules", *rules, display])
