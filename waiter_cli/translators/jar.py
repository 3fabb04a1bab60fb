"""Translates SPARC with upstream's sparc.jar, and reports what is missing for that."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import InputError, MissingError
from waiter_cli.translators.jar_store import _MEND, cache_dir, find_jar

if TYPE_CHECKING:
    from sparc.solving.jar_translator import JarTranslator
    from sparc.source import Source
    from sparc.translation.asp_program import AspProgram

__all__ = ["JarBackend", "jar_errors", "jar_translator", "java_mend"]


def java_mend() -> str:
    """Returns the command that installs Java here."""
    if sys.platform == "darwin":
        return "install a Java runtime: `brew install openjdk`"
    if sys.platform == "win32":
        return "install a Java runtime: `winget install EclipseAdoptium.Temurin.21.JRE`"
    return "install a Java runtime: `sudo apt-get install default-jre-headless` on Debian or Ubuntu"


@contextlib.contextmanager
def jar_errors() -> Iterator[None]:
    """Turns a missing Java or jar into a `MissingError` (exit 5) that names the mend.

    What the jar or, behind it, clingo cannot handle is the program's fault here: an `InputError`
    that says so and names the other translator.
    """
    from sparc.errors import MissingToolError, RefusedProgramError, SolverError
    from sparc.solving.jar_translator import TranslationTimeout

    try:
        yield
    except MissingToolError as error:
        mend = java_mend() if error.tool == "java" else _MEND
        raise MissingError(error.message, mend) from error
    except TranslationTimeout:
        raise
    except SolverError as error:
        message = error.message
        if isinstance(error, RefusedProgramError):
            message = f"clingo refused what sparc.jar made of the program: {error.details}"
        raise InputError(" ".join(message.split()), "try --translator native") from error


@dataclass(frozen=True)
class JarBackend:
    """The jar as a translator of `waiter`: what is missing leads to exit 5."""

    jar: JarTranslator
    name: str = "jar"
    costly: bool = True

    def translate(self, source: Source, *, time_limit: float | None = None) -> AspProgram:
        """Returns the jar's translation; raises `MissingError`, `sparc.errors.SourceError`."""
        with jar_errors():
            return self.jar.translate(source, time_limit=time_limit)


def jar_translator(option: str | os.PathLike[str] | None = None) -> JarBackend:
    """Returns the backend that runs the jar found for ``option``; raises `MissingError` without it or Java."""
    from sparc.solving.jar_translator import JarTranslator, find_java

    jar = find_jar(option)
    if find_java() is None:
        raise MissingError("Java was not found, and sparc.jar needs it", java_mend())
    try:
        kept: Path | None = cache_dir()
    except MissingError:
        kept = None
    return JarBackend(JarTranslator(jar.path, cache_dir=kept))
