"""Frozen dataclasses that are cheap to define.

`dataclasses.dataclass` writes and compiles half a dozen methods for every class it decorates, at
import: for the classes of a syntax tree that takes longer than parsing a program.  The
``dataclass`` of this module has the same meaning for frozen classes; its classes share their
methods, and the one that has to be written, ``__init__``, is written when a class is first
instantiated.  All frozen classes of the product are made by it.  It can be deleted when the standard
library defines the 39 classes of `sparc.syntax.tree` within 5 ms; `benchmarks/bench_start.py`
measures that.  Type checkers see the original, and `dataclasses.fields` and `replace` work.

>>> @dataclass(frozen=True)
... class Point:
...     x: int
...     y: int = 0
>>> Point(1) == Point(1, 0), Point(2)
(True, Point(x=2, y=0))
"""

from __future__ import annotations

__all__ = ["dataclass", "field"]

TYPE_CHECKING = False  # as in `typing`, which takes longer to load than all of this
if TYPE_CHECKING:
    from dataclasses import dataclass, field
else:
    _NONE = object()

    class _Field:
        """The arguments of one ``field(...)``."""

        __slots__ = ("compare", "default", "default_factory", "repr")

        def __init__(self, default=_NONE, default_factory=_NONE, repr=True, compare=True):
            self.default = default
            self.default_factory = default_factory
            self.repr = repr
            self.compare = compare

    field = _Field

    def dataclass(*, frozen, order=False, eq=True):
        """`dataclasses.dataclass` for frozen classes, without ``slots``."""
        assert frozen

        def decorate(cls):
            fields = {}
            for name in cls.__dict__.get("__annotations__", ()):
                default = cls.__dict__.get(name, _NONE)
                if type(default) is _Field:
                    fields[name] = default
                    if default.default is _NONE:
                        delattr(cls, name)
                    else:
                        setattr(cls, name, default.default)
                else:
                    fields[name] = _Field(default)
            cls._fields = fields
            cls.__match_args__ = tuple(fields)
            cls.__dataclass_fields__ = _StandardFields()
            cls.__init__ = _first_init(cls)
            cls.__setattr__ = _refuse
            cls.__delattr__ = _refuse
            for name, method in _SHARED.items():
                if name not in cls.__dict__ and (eq or name == "__repr__"):
                    setattr(cls, name, method)
            if order:
                cls.__lt__, cls.__le__, cls.__gt__, cls.__ge__ = _lt, _le, _gt, _ge
            return cls

        return decorate

    def _first_init(cls):
        def first(self, *args, **kwargs):
            if cls.__init__ is first:
                _write_init(cls)
            cls.__init__(self, *args, **kwargs)

        return first

    def _write_init(cls):
        names = {"_none": _NONE}
        parameters, lines = [], []
        for name, one in cls._fields.items():
            value = name
            if one.default_factory is not _NONE:
                names[f"_new_{name}"] = one.default_factory
                parameters.append(f"{name}=_none")
                value = f"_new_{name}() if {name} is _none else {name}"
            elif one.default is not _NONE:
                names[f"_is_{name}"] = one.default
                parameters.append(f"{name}=_is_{name}")
            else:
                parameters.append(name)
            lines.append(f" _d[{name!r}] = {value}\n")
        if hasattr(cls, "__post_init__"):
            lines.append(" self.__post_init__()\n")
        text = (
            f"def __init__(self, {', '.join(parameters)}):\n _d = self.__dict__\n{''.join(lines)}"
        )
        made = {}
        exec(text, names, made)
        made["__init__"].__qualname__ = f"{cls.__qualname__}.__init__"
        cls.__init__ = made["__init__"]

    def _compared(cls):
        """The function that takes the compared fields of an instance."""
        getter = cls.__dict__.get("_getter")
        if getter is None:
            from operator import attrgetter

            names = [name for name, one in cls._fields.items() if one.compare]
            if len(names) == 1:
                single = attrgetter(names[0])
                getter = staticmethod(lambda value: (single(value),))
            else:
                getter = attrgetter(*names) if names else staticmethod(lambda value: ())
            cls._getter = getter
            getter = cls._getter
        return getter.__func__ if type(getter) is staticmethod else getter

    def _eq(self, other):
        if self is other:
            return True
        cls = type(self)
        if type(other) is not cls:
            return NotImplemented
        get = _compared(cls)
        return get(self) == get(other)

    def _hash(self):
        return hash(_compared(type(self))(self))

    def _repr(self):
        shown = (name for name, one in self._fields.items() if one.repr)
        return f"{type(self).__qualname__}({', '.join(f'{n}={getattr(self, n)!r}' for n in shown)})"

    def _refuse(self, name, *value):
        from dataclasses import FrozenInstanceError

        raise FrozenInstanceError(f"cannot assign to field {name!r}")

    def _ordered(compare):
        def method(self, other):
            if type(other) is not type(self):
                return NotImplemented
            get = _compared(type(self))
            return compare(get(self), get(other))

        return method

    _lt = _ordered(lambda a, b: a < b)
    _le = _ordered(lambda a, b: a <= b)
    _gt = _ordered(lambda a, b: a > b)
    _ge = _ordered(lambda a, b: a >= b)
    _SHARED = {"__eq__": _eq, "__hash__": _hash, "__repr__": _repr}

    class _StandardFields:
        """Stands for ``__dataclass_fields__``: made by `dataclasses` itself when asked for."""

        def __get__(self, instance, cls):
            import dataclasses

            body = {"__annotations__": cls.__dict__.get("__annotations__", {})}
            for name, one in cls._fields.items():
                given = {"repr": one.repr, "compare": one.compare}
                if one.default is not _NONE:
                    given["default"] = one.default
                if one.default_factory is not _NONE:
                    given["default_factory"] = one.default_factory
                body[name] = dataclasses.field(**given)
            made = dataclasses.dataclass(frozen=True)(type(cls.__name__, (), body))
            cls.__dataclass_fields__ = made.__dataclass_fields__
            return cls.__dataclass_fields__
