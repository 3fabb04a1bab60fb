"""Checks a certificate in exact fractions, without HiGHS: `Problem`, document → the bound it proves.

Entry point `check_certificate`.  The graph is made anew from the restaurant and the situation; of the
document only prices and sets of nodes are used.  The argument, in full:

1. A plan of at most ``most`` steps is a walk through the graph.  Counting how often it uses each
   column gives numbers that keep to every row, and no count is above ``most``.
2. A set of nodes without the start that holds all nodes of a visit is entered at least once.  One in
   which a deed is done some of the times that every plan does it is entered, too: times the number
   of times, it is entered at least as often as the deed is done there.  These are the rows of cuts.
3. Multiply every row by its price (of the sign that its bound allows) and add up.  The costs of a
   walk are at least the bounds times the prices, plus what each column costs beyond its prices.
   Where that is negative it is taken ``most`` times.

So any prices prove something: nothing need be believed of where they come from.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import ceil
from typing import Any

from waiter_cli.bounds.distances import WalkDistances, standing
from waiter_cli.bounds.insertion import Builder, Clock
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.bounds.seating import Seating
from waiter_cli.flow_bounds.certificate import FORMAT
from waiter_cli.flow_bounds.connectivity import FlowCut, row_of
from waiter_cli.flow_bounds.contraction import floor_of
from waiter_cli.flow_bounds.layer_builder import build_layers
from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.modes import FlowRow
from waiter_cli.flow_bounds.ordered_jobs import OrderedJobs, find_ordered_jobs
from waiter_cli.model.problem import Problem

__all__ = ["check_certificate"]


def check_certificate(problem: Problem, document: Mapping[str, Any]) -> int:
    """Returns the number of steps that no plan of ``problem`` falls short of, as the document proves.

    Raises `ValueError` where the document is no certificate, or none of this problem.
    """
    if document.get("certificate") != FORMAT:
        raise ValueError(f"this is no certificate of the form {FORMAT}")
    most, unit = _whole(document, "most"), _whole(document, "unit")
    if most < 0 or unit < 1:
        raise ValueError("most is 0 or more, and unit 1 or more")
    jobs, layers = _graph(problem)
    size = {"nodes": len(layers.places), "columns": len(layers.costs), "rows": len(layers.rows)}
    if document.get("graph") != size:
        raise ValueError(f"the graph of this problem has {size}, not {document.get('graph')}")
    priced: list[tuple[FlowRow, Fraction]] = []
    for entry in _list(document, "rows"):
        row, price = entry if isinstance(entry, list) and len(entry) == 2 else (None, None)
        if type(row) is not int or type(price) is not int or not 0 <= row < len(layers.rows):
            raise ValueError("each of rows is the number of a row and its price")
        priced.append((layers.rows[row], Fraction(price, unit)))
    for cut in _list(document, "cuts"):
        if not isinstance(cut, dict):
            raise ValueError("each of cuts is a mapping")
        priced.append((row_of(layers, _cut(layers, cut)), Fraction(_whole(cut, "price"), unit)))
    proved = ceil(_value(layers, priced, most)) + jobs.deeds
    return max(0, min(proved, most + 1))


def _graph(problem: Problem) -> tuple[OrderedJobs, Layers]:
    """Returns what every plan does, and the graph it is a walk through."""
    if problem.layout.agents:
        raise ValueError("certificates are about one robot")
    walks = WalkDistances(problem, standing(problem).fixed.values())
    seating = Seating(problem, find_needs(problem), walks)
    jobs = find_ordered_jobs(seating, Builder(seating, Clock(0, None)))
    return jobs, build_layers(jobs, floor_of(walks, seating.start))


def _cut(layers: Layers, document: Mapping[str, Any]) -> FlowCut:
    """Returns a cut of the document; `row_of` says whether a plan has to keep to it."""
    nodes = _list(document, "inside")
    if not all(type(node) is int and 0 <= node < len(layers.places) for node in nodes):
        raise ValueError("inside are numbers of nodes")
    if layers.sink in nodes:
        raise ValueError("the end is in the set")
    if "visit" in document:
        visit = _whole(document, "visit")
        if not 0 <= visit < len(layers.visits):
            raise ValueError(f"there is no visit {visit}")
        return FlowCut(frozenset(nodes), visit=visit)
    keys, deed = list(layers.times), _whole(document, "deed")
    if not 0 <= deed < len(keys):
        raise ValueError(f"there is no deed {deed}")
    return FlowCut(frozenset(nodes), deed=keys[deed])


def _value(layers: Layers, priced: list[tuple[FlowRow, Fraction]], most: int) -> Fraction:
    """Returns what the prices prove: the sum of step 3 above."""
    beyond = [Fraction(cost) for cost in layers.costs]
    total = Fraction(0)
    for row, price in priced:
        bound = row.low if price > 0 else row.high
        if price and bound is None:
            raise ValueError("a price has a sign that the bound of its row does not allow")
        if price:
            assert bound is not None
            total += price * bound
            for column, factor in row.columns:
                beyond[column] -= price * factor
    return total + most * sum((cost for cost in beyond if cost < 0), Fraction(0))


def _whole(document: Mapping[str, Any], key: str) -> int:
    value = document.get(key)
    if type(value) is not int:
        raise ValueError(f"{key} is a whole number")
    return value


def _list(document: Mapping[str, Any], key: str) -> list[Any]:
    value = document.get(key)
    if not isinstance(value, list):
        raise ValueError(f"{key} is a list")
    return value
