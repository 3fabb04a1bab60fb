"""Runs sparc.jar, the original translator: `Source` → `AspProgram` by Java.

Entry point: `JarTranslator.translate`.  The jar only translates here; clingo runs in this process
on what it wrote.  Its habits are handled in this module and nowhere else: it exits 0 for errors
and 1 for success, it looks for a clingo on PATH and would solve the program with it (it is given
one that does nothing), it reads queries from standard input (which is closed), and its children
outlive it (it runs in a process group of its own, which is ended as a whole).
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

from sparc.deferred_signals import undisturbed
from sparc.errors import MissingToolError, SolverError
from sparc.solving.jar_numbers import refuse_overflow
from sparc.solving.jar_output import asp_program, is_complete, run_failure, source_error
from sparc.source import Source
from sparc.translation.asp_program import AspProgram
from sparc.whole_file import write_bytes

__all__ = ["JarTranslator", "TranslationTimeout", "find_java", "java_version"]

_FILE = "program.sparc"
_CACHE_FORM = b"sparc.jar translation, form 1\n"
_CACHE_ENTRIES = 200
_CACHE_BYTES = 64 * 1024 * 1024
_JAVA_OPTIONS = (
    "-XX:+UseSerialGC",  # these two save a third of a short run and cost a long one nothing
    "-XX:TieredStopAtLevel=1",
    "-Xss32m",
    "-Dfile.encoding=UTF-8",
    "-Djava.awt.headless=true",
)
_NO_CLINGO = "#!/bin/sh\nexit 0\n"


class TranslationTimeout(SolverError, TimeoutError):
    """The time limit passed before the jar was done; nothing of it runs on."""


def find_java(java: str = "java") -> str | None:
    """Returns the path of the Java launcher: on PATH, else under JAVA_HOME.

    None when there is none.
    """
    path = shutil.which(java)
    home = os.environ.get("JAVA_HOME")
    if path is None and java == "java" and home:
        path = shutil.which(os.path.join(home, "bin", "java"))
    return path


def java_version(java: str) -> str | None:
    """Returns the version that the launcher ``java`` says it has; None when it does not work."""
    try:
        done = subprocess.run(
            [java, "-version"],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=15,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    version = re.search(r'version "([^"]+)"', done.stderr + done.stdout)
    return version[1] if version and done.returncode == 0 else None


class JarTranslator:
    """Translates SPARC programs with the jar at ``jar_path``, run by ``java``.

    With a ``cache_dir`` what the jar wrote is kept there, at most 200 files and 64 MB, under the
    hash of the program and of the jar; a folder that cannot be read or written is no error.
    """

    def __init__(
        self, jar_path: str | os.PathLike[str], java: str = "java", cache_dir: Path | None = None
    ) -> None:
        self.jar_path = Path(jar_path)
        self.java = java
        self.cache_dir = cache_dir
        self.java_runs = 0

    @cached_property
    def jar_hash(self) -> str:
        """Returns the sha256 of the jar, in hexadecimal.

        Raises `MissingToolError` when the jar cannot be read.
        """
        try:
            return hashlib.sha256(self.jar_path.read_bytes()).hexdigest()
        except OSError as error:
            raise MissingToolError(
                "jar",
                f"cannot read {self.jar_path}: {error.strerror}",
                "give the path of sparc.jar",
            ) from error

    def translate(self, source: Source, *, time_limit: float | None = None) -> AspProgram:
        """Returns the jar's translation of ``source``, within ``time_limit`` seconds.

        Raises `SourceError` (its subclass says the kind, its span the place) for the first fault
        the jar finds in the program, `NumberError` for arithmetic that leaves 32 bits,
        `MissingToolError` without Java or the jar, `TranslationTimeout`, and `SolverError` when
        Java dies.
        """
        start = time.monotonic()
        key = hashlib.sha256(
            _CACHE_FORM + self.jar_hash.encode() + source.text.encode("utf-8", "surrogatepass")
        ).hexdigest()
        text = self._cached(key)
        if text is None:
            text = self._run(source, time_limit)
            self._keep(key, text)
        left = None if time_limit is None else time_limit - (time.monotonic() - start)
        try:
            refuse_overflow(source, time_limit=left)
        except TimeoutError as error:
            raise _late(time_limit) from error
        return asp_program(text, source)

    # -------------------------------------------------------------- Java

    def _run(self, source: Source, time_limit: float | None) -> str:
        """Returns the jar's output for ``source``."""
        java = find_java(self.java)
        if java is None:
            raise MissingToolError(
                "java", f"{self.java} was not found", "install a Java runtime, version 8 or newer"
            )
        with _folder() as folder:
            (folder / _FILE).write_bytes(_plain_comments(source.text).encode("utf-8", "replace"))
            command = [
                java,
                *_JAVA_OPTIONS,
                "-jar",
                os.path.abspath(self.jar_path),
                str(folder / _FILE),
                "-o",
                str(folder / "program.lp"),
            ]
            self.java_runs += 1
            status = _run_in_group(command, folder, time_limit)
            stderr = (folder / "stderr").read_text("utf-8", "replace")
            try:
                text = (folder / "program.lp").read_text("utf-8", "replace")
            except FileNotFoundError:
                text = ""
        if text and is_complete(text) and "program translated" in stderr:
            return text
        raise source_error(stderr, source, _FILE) or run_failure(stderr, status)

    # -------------------------------------------------------------- cache

    def _cached(self, key: str) -> str | None:
        if self.cache_dir is None:
            return None
        path = self.cache_dir / f"{key}.lp"
        try:
            text = path.read_text("utf-8")
            if not is_complete(text):
                return None
            with contextlib.suppress(OSError):
                os.utime(path)
        except (OSError, UnicodeDecodeError):
            return None
        return text

    def _keep(self, key: str, text: str) -> None:
        """Stores a translation; the file appears whole or not at all."""
        if self.cache_dir is None or len(text) > _CACHE_BYTES // 4:
            return
        with contextlib.suppress(OSError):
            self.cache_dir.mkdir(parents=True, exist_ok=True)
            write_bytes(self.cache_dir / f"{key}.lp", text.encode(), ".tmp")
            self._shrink()

    def _shrink(self) -> None:
        """Deletes the translations used longest ago, until the rest is within bounds."""
        assert self.cache_dir is not None
        entries = []
        for entry in os.scandir(self.cache_dir):
            if entry.name.endswith((".lp", ".tmp")):
                with contextlib.suppress(OSError):
                    status = entry.stat()
                    entries.append((status.st_mtime, status.st_size, entry.path))
        entries.sort(reverse=True)
        size = 0
        for rank, (_, length, path) in enumerate(entries):
            size += length
            if rank >= _CACHE_ENTRIES or size > _CACHE_BYTES:
                with contextlib.suppress(OSError):
                    os.unlink(path)


@contextlib.contextmanager
def _folder() -> Iterator[Path]:
    """Yields a folder for one run, which is gone afterwards."""
    folder = None
    try:
        with undisturbed():
            folder = Path(tempfile.mkdtemp(prefix="sparc-jar-"))
        yield folder
    finally:
        if folder is not None:
            with undisturbed():
                shutil.rmtree(folder, ignore_errors=True)


def _plain_comments(text: str) -> str:
    """Returns the text with a ``?`` for each character of a comment beyond printable ASCII.

    The jar takes no others, and ignores what a comment says.
    """
    if text.isascii() and text.replace("\n", "").replace("\t", "").isprintable():
        return text
    return re.sub("%[^\r\n]*", lambda comment: re.sub(r"[^\t\x20-\x7e]", "?", comment[0]), text)


def _run_in_group(command: list[str], folder: Path, time_limit: float | None) -> int:
    """Returns the exit status of ``command``, whose messages go to ``folder/stderr``.

    Raises `TranslationTimeout`.  However this function is left, nothing of the process group runs
    on.
    """
    environment = _environment(folder)
    process = None
    try:
        with undisturbed(), open(folder / "stderr", "wb") as stderr:
            process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=stderr,
                cwd=folder,
                env=environment,
                start_new_session=True,
            )
        return process.wait(time_limit)
    except OSError as error:
        raise MissingToolError(
            "java",
            f"cannot start {command[0]}: {error.strerror}",
            "install a Java runtime, version 8 or newer",
        ) from error
    except subprocess.TimeoutExpired as error:
        raise _late(time_limit) from error
    finally:
        if process is not None:
            _end_group(process)


def _late(time_limit: float | None) -> TranslationTimeout:
    return TranslationTimeout(
        f"sparc.jar was not done within {time_limit or 0:g} seconds",
        hint="raise the time limit or use the native translator",
    )


def _end_group(process: subprocess.Popen[bytes]) -> None:
    """Ends the process and all it started."""
    if sys.platform == "win32":
        if process.poll() is None:
            process.kill()
    else:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def _environment(folder: Path) -> dict[str, str]:
    """This process's environment, with a clingo on PATH that does nothing.

    Where no script can bear that name, the folders that hold a clingo are left out of PATH.
    """
    environment = dict(os.environ)
    path = environment.get("PATH", os.defpath)
    if sys.platform == "win32":
        names = ("clingo.exe", "clingcon.exe", "clingo")
        entries = [
            entry
            for entry in path.split(os.pathsep)
            if not any(os.path.exists(os.path.join(entry, name)) for name in names)
        ]
        environment["PATH"] = os.pathsep.join(entries)
    else:
        launcher = folder / "bin" / "clingo"
        launcher.parent.mkdir()
        launcher.write_text(_NO_CLINGO, "utf-8")
        launcher.chmod(0o700)
        environment["PATH"] = os.pathsep.join((str(launcher.parent), path))
    return environment
