"""Finds out what a target is and draws its figures."""

import re
import warnings
from pathlib import Path

import numpy

from . import critical, cycle, errors, extremes, fretting, fretting_map, groups, history, mesh, output, page, parameters
from . import pressure, rolling, shape, shapes, spectrum, study, style, surface, tables, wear, work
from .complaints import BadInput, Unsuitable, reason_of
from .result import Result

CONTACT_FIGURES = {"pressure": pressure.draw, "pressure-map": surface.draw_pressure}
RESULT_FIGURES = {
    "shape": shape.draw,
    "history": history.draw,
    "mesh": mesh.draw,
    "wear": wear.draw,
    "depth-map": surface.draw_depth,
}
CYCLE_FIGURES = {"cycle": cycle.draw}  # of results with phases
PATH_FIGURES = {"fretting": fretting.draw}  # of those where friction may stick
ROLLING_FIGURES = {"rolling": rolling.draw}


# Exceptions that occur when numbers are damaged or do not have the right format.
NONSENSE = (ArithmeticError, LookupError, MemoryError, OSError, RuntimeError, TypeError, ValueError,
            numpy.linalg.LinAlgError)


def draw(kind, targets, folder, svg_only):
    style.apply()
    jobs = [job for target in targets for job in jobs_of(kind, target)]
    owners = {}
    for drawer, target in jobs:
        sink = Sink(target, folder, svg_only, owners)
        subject = SUBJECTS_OF_PAGES.get(drawer)
        if folder is None and subject and page.data_of(target, subject).is_file():
            draw_with_page(drawer, target, sink, subject)
        else:
            perform(drawer, [target], sink)
    if [drawer for drawer, _ in jobs] == [draw_result] * 2:
        both = [path for _, path in jobs]
        perform(draw_two_results, both, Sink(targets[0], folder, svg_only, owners))


def draw_with_page(drawer, target, sink, subject):
    """The page has its tables even if the figures cannot be drawn."""
    try:
        reports = perform(drawer, [target], sink)
    except BadInput as error:
        page.write(target, subject, {}, str(error))
        raise
    print(page.write(target, subject, reports))


def draw_mesh(target, file):
    """A mesh and its named parts as FILE.png or FILE.svg."""
    style.apply()
    axes, body, parts = groups.read(target)
    kind = file.suffix.removeprefix(".")
    (picture,) = output.render(groups.draw(body, parts, axes), file.stem, (kind,)).values()
    file.write_bytes(picture)


def perform(drawer, targets, sink):
    """Writes the figures when all are made, and returns them: for a refused target no figure is
    written."""
    try:
        with warnings.catch_warnings(), numpy.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # from damaged numbers, which are reported in one line
            drawer(*targets, sink)
            reports = sink.render()
    except NONSENSE as error:
        names = " or ".join(str(target) for target in targets)
        raise BadInput(f"cannot draw {names}: {reason_of(error)}; its numbers are "
                       "damaged, or not what docs/figures.md and docs/results.md expect") from error
    sink.write(reports)
    return reports


class Sink:
    """The folder of the figures of a target. `owners`: the target of each figure so far."""

    def __init__(self, target, folder, svg_only, owners):
        self.target, self.owners = target, owners
        self.kinds = ("svg",) if svg_only else ("png", "svg")
        beside = target if target.is_dir() else target.parent
        self.folder = Path(folder or beside / "figures")
        self.figures = {}

    def draw(self, name, drawer, *arguments):
        """Keeps a figure, or the reason why there is none."""
        try:
            self.figures[name] = drawer(*arguments)
        except Unsuitable as reason:
            self.figures[name] = reason

    def render(self):
        """By name, the contents of a figure's files, or the reason why there are none."""
        return {name: made if isinstance(made, Unsuitable)
                else output.render(made, name, self.kinds) for name, made in self.figures.items()}

    def require_own_names(self, reports):
        for name, report in reports.items():
            if isinstance(report, Unsuitable):
                continue
            owner = self.owners.setdefault(self.folder.resolve() / name, self.target)
            if not owner.samefile(self.target):
                raise BadInput(f"{self.target} has figures of the names that those of {owner} "
                               f"have in {self.folder}")

    def write(self, reports):
        self.require_own_names(reports)
        for name, report in reports.items():
            if isinstance(report, Unsuitable):
                print(f"{name}: skipped, {report}")
                continue
            for path in output.save(report, self.folder):
                print(path)


def jobs_of(kind, target):
    if kind == "result" or kind == "any" and target.is_file():
        return [(draw_result, target)]
    if not target.is_dir():
        raise BadInput(f"{target} is not a folder")
    known = {"study": ("study.csv", draw_study), "spectrum": ("spectrum.csv", draw_spectrum),
             "extremes": ("extremes.csv", draw_extremes)}
    wanted = known if kind == "any" else {kind: known[kind]}
    jobs = [(drawer, target) for file, drawer in wanted.values() if (target / file).is_file()]
    if kind == "any":
        jobs += [(draw_result, path) for path in sorted(target.glob("*.h5"))
                 if path.is_file() and not jobs]
    if not jobs:
        files = " or ".join(file for file, _ in wanted.values())
        raise BadInput(f"{target} holds no {files}" + (" or result" if kind == "any" else ""))
    return jobs


def draw_result(path, sink):
    with Result(path) as result:
        drawers = RESULT_FIGURES | (CONTACT_FIGURES if result.has_contact else {})
        drawers |= CYCLE_FIGURES if result.has_phases else {}
        drawers |= PATH_FIGURES if result.has_path else {}
        drawers |= ROLLING_FIGURES if result.rolls else {}
        for name, drawer in drawers.items():
            sink.draw(f"{result.name}-{name}", drawer, result)


def draw_two_results(first, second, sink):
    with Result(first) as one, Result(second) as two:
        if one.has_contact and two.has_contact:
            sink.draw(f"{one.name}-{two.name}-pressure", pressure.draw_two, one, two)


def draw_study(folder, sink):
    path = folder / "study.csv"
    rows = tables.read(path, study.TEXTS)
    if parameters.of_sweep(rows):
        stem = file_name(rows[0]['study'])
        sink.draw(f"{stem}-parameters", parameters.draw, path, rows)
        sink.draw(f"{stem}-fretting-map", fretting_map.draw, path, rows)
        return
    runs = study.read(folder)
    for name in study.distinct(run.study for run in runs):
        own = [run for run in runs if run.study == name]
        stem = file_name(name or "study")
        sink.draw(f"{stem}-error-step", errors.draw_steps, own)
        sink.draw(f"{stem}-error-tolerance", errors.draw_tolerances, own)
        sink.draw(f"{stem}-error-newton", errors.draw_sweep_work, own)
        sink.draw(f"{stem}-error-time", errors.draw_sweep_time, own)
        sweeps = study.distinct(run.sweep for run in own)
        for sweep in sweeps:
            tail = f"-{file_name(sweep)}" if len(sweeps) > 1 else ""
            members = [run for run in own if run.sweep == sweep]
            sink.draw(f"{stem}-work{tail}", work.draw, members)
            sink.draw(f"{stem}-shapes{tail}", shapes.draw, folder, members)


def draw_spectrum(folder, sink):
    spectra = spectrum.read(folder)
    sink.draw("spectrum", spectrum.draw, spectra)
    if (folder / "critical_steps.csv").is_file():
        sink.draw("critical-steps", critical.draw, critical.read(folder))


def draw_extremes(folder, sink):
    sink.draw("accuracy", extremes.draw, extremes.read(folder))


SUBJECTS_OF_PAGES = {draw_study: "study", draw_extremes: "extremes"}


def file_name(text):
    return re.sub(r"[^A-Za-z0-9.]+", "-", text).strip("-.") or "all"
