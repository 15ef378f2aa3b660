"""Reads a study's table, DIR/study.csv: one row per run."""

import math
from dataclasses import dataclass

from . import tables

NUMBERS = ("setting", "shape_error", "shape_error_self", "pressure_error", "reference_error",
           "newton_iterations", "factorizations", "cpu_seconds")
TEXTS = ("study", "sweep", "method", "integrator", "setting_kind", "status", "marked")


@dataclass
class Run:
    """A row: the columns that figures use."""

    study: str
    sweep: str
    method: str
    integrator: str
    setting_kind: str
    run: str
    status: str
    marked: bool
    setting: float
    shape_error: float
    shape_error_self: float
    pressure_error: float
    reference_error: float
    newton_iterations: float
    factorizations: float
    cpu_seconds: float

    @property
    def finished(self):
        return self.status in ("", "finished", "ok", "done") and math.isfinite(self.shape_error)

    @property
    def fixed_step(self):
        return "tol" not in self.setting_kind


def read(folder):
    path = folder / "study.csv"
    return [run_of(path, row) for row in tables.read(path, (*TEXTS, *NUMBERS))]


def run_of(path, row):
    values = {name: (row[name] or "").strip() for name in TEXTS}
    values["run"] = row.get("run") or ""  # tables of 2026-11 and before have none
    values["marked"] = values["marked"].lower() in ("1", "true", "yes")
    values.update({name: tables.number(path, row, name) for name in NUMBERS})
    return Run(**values)


def distinct(values):
    """In the order of their first appearance."""
    return list(dict.fromkeys(values))
