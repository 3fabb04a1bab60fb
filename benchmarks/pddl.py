"""`Problem` → PDDL: the same restaurant for planners that know nothing of SPARC.

Seating and bills, one robot, unit costs: STRIPS with typing, which both peers read.
"""

from __future__ import annotations

from waiter_cli.model.problem import Problem

__all__ = ["DOMAIN", "problem_text"]

DOMAIN = """(define (domain waiter)
  (:requirements :strips :typing)
  (:types node table party)
  (:predicates (edge ?a ?b - node) (at ?n - node) (entrance ?n - node) (near ?n - node ?t - table)
    (free ?t - table) (occupied ?t - table) (fits ?p - party ?t - table)
    (waiting ?p - party) (led ?p - party) (alone) (seated ?p - party) (sits ?p - party ?t - table)
    (wantsbill ?t - table) (haspaid ?t - table))
  (:action go_to :parameters (?m ?n - node)
    :precondition (and (at ?m) (edge ?m ?n))
    :effect (and (not (at ?m)) (at ?n)))
  (:action pick :parameters (?p - party ?n - node ?t - table)
    :precondition (and (at ?n) (entrance ?n) (waiting ?p) (alone) (free ?t))
    :effect (and (not (waiting ?p)) (not (alone)) (led ?p)))
  (:action seat :parameters (?p - party ?t - table ?n - node)
    :precondition (and (at ?n) (near ?n ?t) (led ?p) (free ?t) (fits ?p ?t))
    :effect (and (not (led ?p)) (alone) (not (free ?t)) (occupied ?t) (seated ?p) (sits ?p ?t)))
  (:action give_bill :parameters (?t - table ?n - node)
    :precondition (and (at ?n) (near ?n ?t) (wantsbill ?t) (occupied ?t))
    :effect (and (not (wantsbill ?t)) (haspaid ?t))))
"""


def problem_text(problem: Problem) -> str:
    """The problem file; raises ValueError where the problem needs more than seating and bills."""
    layout, state = problem.layout, problem.state
    if layout.timetable or problem.before:
        raise ValueError("PDDL is written for seating and bills only")
    blocked = {node for _, node in state.waiters}
    parties = {party[0]: party for party in state.parties()}
    taken = dict(state.seated)
    facts = [f"(at {state.agent})", f"(entrance {layout.entrance})"]
    for a, b in layout.edges:
        facts += [f"(edge {m} {n})" for m, n in ((a, b), (b, a)) if n not in blocked]
    for table in layout.tables:
        facts += [f"(near {node} {table.name})" for node in dict.fromkeys(table.nodes)]
        facts.append(f"({'occupied' if table.name in taken else 'free'} {table.name})")
        room = min(table.capacity, dict(state.chairs).get(table.name, table.capacity))
        facts += [f"(fits {p} {table.name})" for p, who in parties.items() if len(who) <= room]
    facts += [f"(sits {party[0]} {table}) (seated {party[0]})" for table, party in state.seated]
    facts += [f"(waiting {party[0]})" for party in state.waiting]
    facts.append(f"(led {state.with_agent[0]})" if state.with_agent else "(alone)")
    facts += [f"(wantsbill {table})" for table in sorted(state.wants_bill)]
    facts += [f"(haspaid {table})" for table in sorted(state.paid)]
    goals = []
    for goal in problem.goals:
        match goal.kind:
            case "seated" if goal.table is None:
                goals.append(f"(seated {goal.party[0]})")
            case "seated":
                goals.append(f"(sits {goal.party[0]} {goal.table})")
            case "paid" if goal.table is not None:
                goals.append(f"(haspaid {goal.table})")
            case "at":
                goals.append(f"(at {goal.node})")
            case kind:
                raise ValueError(f"PDDL is not written for goals of kind {kind}")
    objects = (
        f"{' '.join(node.name for node in layout.nodes)} - node "
        f"{' '.join(table.name for table in layout.tables)} - table {' '.join(parties)} - party"
    )
    return (
        f"(define (problem {layout.name}) (:domain waiter)\n(:objects {objects})\n"
        f"(:init {' '.join(facts)})\n(:goal (and {' '.join(goals)})))\n"
    )
