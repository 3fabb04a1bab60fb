"""Ties among minimal plans: `Problem` → clingo text that prefers some of them.

The text is added to a program whose horizon is the least one already, so it can never cost a
step.  Preferences are lexicographic, in the order in which the scenario lists them:
``shortest_walk`` (metres; an edge counts 1 where the layout has no coordinates),
``smallest_table`` (seats of the tables that parties are seated at), ``longest_waiting`` (who came
first is picked up first), ``earliest`` (every goal counts one for each step at which it does not
hold: the sum over the goals of how long each is waited for).
"""

from __future__ import annotations

from math import dist

from waiter_cli.model.problem import Problem

__all__ = ["chosen_preferences", "fewest_actions", "preference_rules"]

# Unasked, a party gets the smallest table, where there is little enough to choose from that the
# choice costs no noticeable time.
_DEFAULT = ("smallest_table",)
_FEW_PARTIES, _FEW_TABLES, _FEW_NODES = 2, 12, 100


def chosen_preferences(problem: Problem) -> tuple[str, ...]:
    """Returns the scenario's preferences; by default the smallest table, in a small restaurant."""
    if problem.prefer:
        return problem.prefer
    parties = len(problem.state.waiting) + len(problem.state.led())
    layout = problem.layout
    few = len(layout.tables) <= _FEW_TABLES and len(layout.nodes) <= _FEW_NODES
    return _DEFAULT if few and 0 < parties <= _FEW_PARTIES else ()


def fewest_actions(problem: Problem) -> str:
    """Returns the statement that prefers fewer actions to all else, where several robots act at once."""
    level = 8 + len(problem.state.waiting)  # above every level of `preference_rules`
    return f"#minimize {{ 1@{level},A,I : occurs(A,I) }}."


def preference_rules(problem: Problem, preferences: tuple[str, ...]) -> str:
    """Returns the optimization statements, the first preference on the highest level."""
    robot = "R" if problem.layout.agents else "agent"
    lines: list[str] = []
    levels = {"longest_waiting": max(1, len(problem.state.waiting))}
    level = sum(levels.get(name, 1) for name in preferences)
    for name in preferences:
        match name:
            case "shortest_walk":
                lines += _lengths(problem)
                lines.append(
                    f"#minimize {{ D@{level},{'R,' * (robot == 'R')}I : occurs(go_to({robot},N),I), "
                    f"holds(currentlocation({robot},M),I), __length(M,N,D) }}."
                )
            case "smallest_table":
                lines.append(
                    f"#minimize {{ C@{level},P,T : occurs(seat({robot},P,T),I), hascapacity(T,C) }}."
                )
            case "longest_waiting":
                lines += [
                    f"#minimize {{ I@{level - rank} : occurs(pick({robot},{party[0]}),I) }}."
                    for rank, party in enumerate(problem.state.waiting)
                ]
            case "earliest":
                lines.append(
                    f"#minimize {{ 1@{level},G,I : required(G), missing(I), not reached(G,I) }}."
                )
        level -= levels.get(name, 1)
    return "\n".join(lines)


def _lengths(problem: Problem) -> list[str]:
    """Returns the length of every edge in millimetres, both ways."""
    at = {node.name: node.at for node in problem.layout.nodes}
    facts = []
    for a, b in problem.layout.edges:
        start, end = at[a], at[b]
        length = 1000 if start is None or end is None else round(1000 * dist(start, end))
        facts += [f"__length({a},{b},{length}).", f"__length({b},{a},{length})."]
    return facts
