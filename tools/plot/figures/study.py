"""Reads a study's table, DIR/study.csv: one row per run."""

import math
from dataclasses import dataclass

from . import tables

NUMBERS = ("setting", "shape_error", "shape_error_self", "pressure_error", "reference_error",
           "newton_iterations", "factorizations", "cpu_seconds")
WRONG = 0.5  # of the largest pressure: a fixed step with a larger error of the pressure is unstable
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
    max_pressure: float = math.nan
    unstable: bool = False

    @property
    def finished(self):
        return self.status in ("", "finished", "ok", "done") and math.isfinite(self.shape_error)

    @property
    def fixed_step(self):
        return "tol" not in self.setting_kind


def read(folder):
    path = folder / "study.csv"
    runs = [run_of(path, row) for row in tables.read(path, (*TEXTS, *NUMBERS))]
    mark_unstable(runs)
    return runs


def mark_unstable(runs):
    """Runs beyond the critical step that were told to go on are finished as others are, but their
    pressures have nothing to do with those of the best run of the same problem."""
    for problem in distinct((run.study, run.sweep) for run in runs):
        known = [run for run in runs if (run.study, run.sweep) == problem and run.finished
                 and run.pressure_error >= 0 and run.max_pressure > 0]
        best = min(known, key=lambda run: run.pressure_error, default=None)
        for run in known:
            run.unstable = run.fixed_step and run.pressure_error > WRONG * best.max_pressure


def run_of(path, row):
    values = {name: (row[name] or "").strip() for name in TEXTS}
    values["run"] = row.get("run") or ""  # tables of 2026-11 and before have none
    values["marked"] = values["marked"].lower() in ("1", "true", "yes")
    numbers = (*NUMBERS, "max_pressure") if "max_pressure" in row else NUMBERS
    values.update({name: tables.number(path, row, name) for name in numbers})
    return Run(**values)


def distinct(values):
    """In the order of their first appearance."""
    return list(dict.fromkeys(values))
