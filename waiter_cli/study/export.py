"""Writes the runs of a study as a table. Entry points `csv_text`, `parquet_bytes`."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

from waiter_cli.errors import MissingError
from waiter_cli.optional_packages import extra_line
from waiter_cli.study.store import COLUMNS, Row

__all__ = ["csv_text", "parquet_bytes", "require_parquet"]


def csv_text(rows: Sequence[Row]) -> str:
    """Returns the table as CSV (RFC 4180), a heading and a line a run; nothing is an empty cell."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\r\n")
    writer.writerow(COLUMNS)
    writer.writerows([row[name] for name in COLUMNS] for row in rows)
    return text.getvalue()


def require_parquet() -> None:
    """Raises `MissingError` where Parquet cannot be written."""
    try:
        import pyarrow.parquet  # noqa: F401
    except ImportError as error:
        raise MissingError("--parquet needs pyarrow", extra_line("study")) from error


def parquet_bytes(rows: Sequence[Row]) -> bytes:
    """Returns the table as a Parquet file; raises `MissingError` without pyarrow."""
    require_parquet()
    import pyarrow
    import pyarrow.parquet

    table = pyarrow.table({name: [row[name] for row in rows] for name in COLUMNS})
    sink = io.BytesIO()
    pyarrow.parquet.write_table(table, sink)
    return sink.getvalue()
