"""Keeps sparc.jar: which copy is used, which versions are known, how one is fetched.

Entry points: `find_jar` (option, environment variable, the user's own store, in this order),
`jar_translator` (the backend, with its cache), `fetch` (download, verify, install).
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from sparc.whole_file import UnfinishedFile
from waiter_cli.errors import InputError, MissingError

if TYPE_CHECKING:
    pass

__all__ = [
    "FETCH",
    "FoundJar",
    "HomelessError",
    "JarRelease",
    "NoSuchJarError",
    "RELEASES",
    "_MEND",
    "cache_dir",
    "fetch",
    "find_jar",
    "release_of",
    "store_path",
]

VARIABLE = "WAITER_SPARC_JAR"
FETCH = "waiter sparc fetch-jar"

_MEND = f"get it with `{FETCH}`, or name a copy with --sparc-jar PATH or {VARIABLE}"
_MOST_BYTES = 64 * 1024 * 1024  # more than any jar of this kind
_CHUNK = 16 * 1024


@dataclass(frozen=True)
class JarRelease:
    """A version of sparc.jar: its sha256, its size in bytes and the commit that holds it."""

    version: str
    sha256: str
    size: int
    commit: str

    @property
    def url(self) -> str:
        """Returns the address at which the file is published."""
        return f"https://raw.githubusercontent.com/iensen/sparc/{self.commit}/sparc.jar"


RELEASES: Mapping[str, JarRelease] = {
    release.version: release
    for release in (
        JarRelease(
            "2.57",
            "f1c189ce6f362fc7db8dc9961aa686377164e3b8c207f5fac513800263d64ccf",
            299_239,
            "2553a64ae44243c46127e63b340a6fd9c399b823",
        ),
        JarRelease(
            "2.56",
            "1ed6cd30686198b1a9aab82c3aa0f15adf989b3fc458931d6be776847de918aa",
            288_512,
            "b4ae266d00ed6e29ef5c02850508406d0900eb4f",
        ),
    )
}


class NoSuchJarError(MissingError):
    """The file that was named as the jar cannot be read."""


class HomelessError(MissingError):
    """This user has no folder in which the jar could be kept."""


@dataclass(frozen=True)
class FoundJar:
    """A jar and what named it: ``--sparc-jar``, the environment variable, or ``store``."""

    path: Path
    named_by: str

    def sha256(self) -> str:
        """Returns the SHA-256 of the file in hexadecimal; raises `MissingError` when it cannot be read."""
        try:
            return hashlib.sha256(self.path.read_bytes()).hexdigest()
        except OSError as error:
            raise NoSuchJarError(f"cannot read {self.path}: {error.strerror}", _MEND) from error


def release_of(sha256: str) -> JarRelease | None:
    """Returns the known release with this hash."""
    return next((r for r in RELEASES.values() if r.sha256 == sha256), None)


def _home() -> Path:
    """Returns the home folder of this user; raises `MissingError` where there is none."""
    try:
        return Path.home()
    except RuntimeError:
        mend = f"set HOME, or name a copy with --sparc-jar PATH or {VARIABLE}"
        raise HomelessError("this user has no home folder for sparc.jar", mend) from None


def store_path() -> Path:
    """Returns where `fetch` puts the jar: the folder for data of this user's programs.

    Raises `MissingError` for a user without a home.
    """
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or _home() / "AppData" / "Local"
    elif sys.platform == "darwin":
        base = os.environ.get("XDG_DATA_HOME") or _home() / "Library" / "Application Support"
    else:
        base = os.environ.get("XDG_DATA_HOME") or _home() / ".local" / "share"
    return Path(base) / "waiter" / "sparc.jar"


def cache_dir() -> Path:
    """Returns where translations by the jar are kept; raises `MissingError` for a user without a home."""
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or _home() / "AppData" / "Local"
        return Path(base) / "waiter" / "cache" / "jar"
    if sys.platform == "darwin":
        base = os.environ.get("XDG_CACHE_HOME") or _home() / "Library" / "Caches"
    else:
        base = os.environ.get("XDG_CACHE_HOME") or _home() / ".cache"
    return Path(base) / "waiter" / "jar"


def find_jar(option: str | os.PathLike[str] | None = None) -> FoundJar:
    """Returns the jar to use; raises `MissingError` when there is none, or none at the place named."""
    variable = os.environ.get(VARIABLE)
    if option and os.fspath(option) != variable:
        return _named(option, "--sparc-jar")
    if variable:
        return _named(variable, VARIABLE)
    path = store_path()
    if not os.path.isfile(path):
        raise MissingError("sparc.jar was not found", _MEND)
    return FoundJar(path, "store")


def _named(name: str | os.PathLike[str], named_by: str) -> FoundJar:
    with contextlib.suppress(RuntimeError):  # no home: ~ is a name like any other
        name = Path(name).expanduser()
    path = Path(name)
    if not os.path.isfile(path):
        raise NoSuchJarError(f"{named_by}: there is no file {path}", _MEND)
    return FoundJar(path, named_by)


# ------------------------------------------------------------------ download


def fetch(
    release: JarRelease,
    target: Path,
    *,
    url: str | None = None,
    timeout: float = 30.0,
    progress: Callable[[int, int | None], None] = lambda done, total: None,
) -> None:
    """Downloads ``release``, verifies it and installs it as ``target``, whole or not at all.

    The proxies of the environment are used.  ``progress`` is called with the bytes received and
    the number announced.  ``timeout`` is in seconds, for each wait on the network.  Raises
    `MissingError` when the download fails or is not the file it should be, `InputError` for a
    ``url`` of another kind.
    """
    url = url or release.url
    if not url.startswith(("https://", "http://", "file:")):
        raise InputError(f"--url {url}: not an http, https or file address")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        unfinished = UnfinishedFile(target)
    except OSError as error:
        raise MissingError(
            f"cannot write to {target.parent}: {error.strerror}",
            f"make it writable, or keep a copy elsewhere and name it with {VARIABLE}",
        ) from error
    try:
        with open(unfinished.descriptor, "wb") as file:
            file.writelines(_blocks(url, timeout, progress))
            file.flush()
            os.fsync(file.fileno())
        found = hashlib.sha256(Path(unfinished.path).read_bytes()).hexdigest()
        if found != release.sha256:
            raise MissingError(
                f"{url} is not sparc.jar V{release.version}: its sha256 is {found}, "
                f"expected {release.sha256}; nothing was installed",
                f"try `{FETCH}` again, or another --url",
            )
        unfinished.keep(0o644)
    except OSError as error:
        raise MissingError(
            f"cannot install {target}: {error.strerror or error}; nothing was installed",
            "free space or make the folder writable, then try again",
        ) from error
    finally:
        unfinished.drop()


def _blocks(
    url: str, timeout: float, progress: Callable[[int, int | None], None]
) -> Iterator[bytes]:
    """Yields the body of ``url`` in pieces; raises `MissingError` when it does not arrive whole."""
    import http.client
    import urllib.error
    import urllib.request

    mend = (
        f"check the connection (https_proxy is honoured) and try `{FETCH}` again, "
        f"or download the file by hand and name it with {VARIABLE}"
    )
    try:
        request = urllib.request.Request(url, headers={"User-Agent": "waiter"})
        with urllib.request.build_opener().open(request, timeout=timeout) as response:
            announced = response.headers.get("Content-Length", "")
            total = int(announced) if announced.isdecimal() else None
            done = 0
            progress(0, total)
            while block := response.read1(_CHUNK):
                done += len(block)
                if done > _MOST_BYTES:
                    raise MissingError(f"{url} is far larger than sparc.jar", mend)
                progress(done, total)
                yield block
    except urllib.error.HTTPError as error:
        raise MissingError(f"{url} answered {error.code} {error.reason}", mend) from error
    except urllib.error.URLError as error:
        raise MissingError(f"cannot reach {url}: {error.reason}", mend) from error
    except TimeoutError as error:
        raise MissingError(f"{url} sent nothing for {timeout:g} seconds", mend) from error
    except (http.client.HTTPException, OSError, ValueError) as error:
        raise MissingError(f"the download of {url} failed: {error}", mend) from error
    if total is not None and done < total:
        raise MissingError(f"{url} broke off after {done} of {total} bytes", mend)
