"""A plan as a value: actions by step."""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass

__all__ = ["Action", "Plan"]


@dataclass(frozen=True)
class Action:
    """An action at one step, such as ``go_to(agent,n2)``; ``arguments`` are as SPARC has them."""

    step: int
    name: str
    arguments: tuple[str, ...]

    @property
    def text(self) -> str:
        """Returns the action as a SPARC term, without white space."""
        return f"{self.name}({','.join(self.arguments)})" if self.arguments else self.name


@dataclass(frozen=True)
class Plan:
    """Actions in order of their steps; ``horizon`` is the step at which the goals first hold."""

    actions: tuple[Action, ...]
    horizon: int

    def __str__(self) -> str:
        """The actions, a line each, behind their steps."""
        return "\n".join(f"{action.step} {action.text}" for action in self.actions)

    def _repr_html_(self) -> str:
        """Returns a table for notebooks: a row an action, its step first."""
        from html import escape

        rows = (
            f"<tr><th>{action.step}</th><td><code>{escape(action.text)}</code></td></tr>"
            for action in self.actions
        )
        return f"<table>{''.join(rows)}</table>"
