"""Reads CSV tables."""

import csv
import math

from .complaints import BadInput


def read(path, needed):
    """The rows as dictionaries; refuses a table that lacks one of the needed columns."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            absent = [name for name in needed if name not in (reader.fieldnames or [])]
            if absent:
                raise BadInput(f"{path} has no column {absent[0]}")
            rows = list(reader)
    except (UnicodeDecodeError, csv.Error) as error:
        raise BadInput(f"{path} is not a table: {error}") from error
    if not rows:
        raise BadInput(f"{path} holds no rows")
    for line, row in enumerate(rows, start=2):
        if None in row or None in row.values():
            raise BadInput(f"{path}: row {line} has not as many cells as the first has names")
    return rows


def number(path, row, name):
    """NaN if the cell is empty."""
    text = (row[name] or "").strip()
    try:
        return float(text) if text else math.nan
    except ValueError as error:
        raise BadInput(f"{path}: `{text}` in column {name} is not a number") from error
