"""The proof of a bound as a document that anybody can check: `Problem`, `Plan` → certificate.

Entry point `make_certificate`.  It has the prices of the rows of the graph, and the cuts with theirs,
in whole numbers of 1/``unit``.  `certificate_checker` works out again what they prove, without HiGHS.
"""

from __future__ import annotations

from typing import Any

from waiter_cli.bounds import Bounds
from waiter_cli.errors import MissingError
from waiter_cli.flow_bounds import is_available
from waiter_cli.flow_bounds.exact_bound import UNIT
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem

__all__ = ["FORMAT", "make_certificate"]

FORMAT = "waiter.certificate/1"


def make_certificate(
    problem: Problem, plan: Plan, deadline: float | None = None
) -> dict[str, Any] | None:
    """Returns the certificate of the best bound that the programme proves for ``plan``'s problem.

    ``bound`` in it may be below the length of the plan, where branching or solving proved the rest.
    None where the deadline came before anything was proved, or the programme has nothing to say.
    Raises `MissingError` where HiGHS is not installed.
    """
    if not is_available():
        raise MissingError("certificates take HiGHS", "pip install highspy")
    from waiter_cli.flow_bounds.closing import Closing

    closing = Closing(problem, Bounds(0, plan, None))
    closing.prove(deadline)
    relaxation, layers = closing.relaxation, closing.layers
    if relaxation is None or layers is None or not relaxation.prices:
        return None
    base = len(layers.rows)
    keys = list(layers.times)
    cuts = [
        {
            "price": price,
            **({"visit": cut.visit} if cut.visit >= 0 else {"deed": keys.index(cut.deed)}),
            "inside": sorted(cut.inside),
        }
        for cut, price in zip(relaxation.proof, relaxation.prices[base:])
        if price
    ]
    return {
        "certificate": FORMAT,
        "bound": closing.lower,
        "most": plan.horizon,
        "unit": UNIT,
        "graph": {"nodes": len(layers.places), "columns": len(layers.costs), "rows": base},
        "rows": [[row, price] for row, price in enumerate(relaxation.prices[:base]) if price],
        "cuts": cuts,
    }
