"""The condition of a record sort as a function: `Condition` → test of the arguments, with `condition_test`.

>>> from sparc.syntax.tree import Variable
>>> less = condition_test(ConditionTest(Variable("X"), "<", Variable("Y")), {"X": 0, "Y": 2})
>>> less((1, "a", 2)), less((2, "a", 1))
(True, False)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from sparc.sorts.values import Value, compare
from sparc.syntax.tree import And, Condition, ConditionTest, Not

__all__ = ["Test", "condition_test", "condition_variables"]

Test: TypeAlias = "Callable[[tuple[Value, ...]], bool]"
"""Whether the arguments of a record fulfil its condition."""


def condition_test(condition: Condition, places: Mapping[str, int]) -> Test:
    """Returns a condition as a function of a record's arguments.

    ``places`` has the index of the argument of each variable.
    """
    if isinstance(condition, ConditionTest):
        left, right = places[condition.left.name], places[condition.right.name]
        operator = condition.operator
        return lambda given: compare(given[left], operator, given[right])
    if isinstance(condition, Not):
        inner = condition_test(condition.operand, places)
        return lambda given: not inner(given)
    tests = [condition_test(operand, places) for operand in condition.operands]
    if isinstance(condition, And):
        return lambda given: all(test(given) for test in tests)
    return lambda given: any(test(given) for test in tests)


def condition_variables(condition: Condition) -> set[str]:
    """Returns the names of the variables that a condition compares."""
    if isinstance(condition, ConditionTest):
        return {condition.left.name, condition.right.name}
    if isinstance(condition, Not):
        return condition_variables(condition.operand)
    return set().union(*(condition_variables(operand) for operand in condition.operands))
