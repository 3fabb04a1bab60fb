"""Values whose fields are options of a command. Entry point `folded`."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import wraps
from typing import Any, get_type_hints

__all__ = ["folded"]


def folded(function: Callable[..., int]) -> Callable[..., int]:
    """Returns a command that has, in place of each parameter that is a value, an option for each field of it.

    A parameter is a value where its class has fields, which have to be annotated as options are, with their
    defaults.  So what several commands share is listed once.
    """
    signature = inspect.signature(function, eval_str=True)
    found: list[inspect.Parameter] = []
    values: dict[str, tuple[type, tuple[str, ...]]] = {}
    for parameter in signature.parameters.values():
        kind = parameter.annotation
        if not hasattr(kind, "__dataclass_fields__"):
            found.append(parameter)
            continue
        options = get_type_hints(kind, include_extras=True)
        values[parameter.name] = kind, tuple(options)
        found += [
            parameter.replace(name=name, annotation=options[name], default=getattr(kind, name))
            for name in options
        ]

    @wraps(function)
    def command(**given: Any) -> int:
        for name, (kind, fields) in values.items():
            given[name] = kind(**{field: given.pop(field) for field in fields})
        return function(**given)

    command.__annotations__ = {each.name: each.annotation for each in found}
    command.__dict__["__signature__"] = signature.replace(parameters=found)
    return command
