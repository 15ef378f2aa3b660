#!/usr/bin/python3
"""Compares the results of two builds of gnomon.

    scripts/compare_builds.py REFERENCE_BINARY CANDIDATE_BINARY [--quick] [--jobs N] [-o DIR]

Both programs run the same cases, and what they compute is compared:

- every scene in problems/ on a coarse mesh, by every integrator of the reference: with error
  control, with fixed steps, and with located events;
- variants of these scenes: elements, kinematics, constraints, energies, supports, load histories,
  linear solvers, and runs that are resumed;
- every study in problems/*/studies on coarse meshes, run by `gnomon study`: each of its runs, and
  its table;
- critical steps and spectra of `gnomon stability`;
- with --extremes, the verdicts of `gnomon extremes` on all studies in problems/*/extremes.

A run is equal in both if the exit codes and the counts of steps, rejected steps, events, Newton
iterations and factorizations are the same, and if none of these differs by more than --tolerance:

    surface    worn positions of the contact nodes at the end, by the largest wear depth
    pressure   nodal contact pressures at the end, by the largest pressure
    scalars    last row of the history: each by its largest value in the history; t and step_size
               by the last t
    fields     all fields of the last stored step, each by its largest value

A run that fails in both (exit code 3) with the same diagnosis is equal. A run that both refuse
(exit code 2), that both abandon for another reason, or that takes longer than --limit compares
nothing, so it fails the comparison. The exception is a combination that gnomon does not offer, as
fixed steps of bdf: it is "not offered" and is not counted.

Writes DIR/comparison.md and DIR/comparison.csv. Prints every case that differs, and a summary in
the last line. Exit codes: 0 all cases are equal, 1 a case differs, 2 bad input.
"""

import argparse
import concurrent.futures
import csv
import dataclasses
import fnmatch
import hashlib
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import tomllib
from pathlib import Path

try:
    import h5py
    import numpy as np
except ImportError as error:  # pragma: no cover
    sys.exit(f"{error}; use /usr/bin/python3 with Debian's python3-h5py (scripts/packages.txt)")

ROOT = Path(__file__).resolve().parent.parent

# ---------------------------------------------------------------- what is run

STIFF_END = {  # s; explicit methods reach this end instead of that of the scene
    "dahlquist/stiff": 0.01,
    "ball_on_flat/small_deformation": 2.0,
    "ball_on_flat/finite_deformation": 200.0,
    "ball_on_half_space/small_deformation": 2.0,
    "ball_on_half_space/finite_deformation": 200.0,
}
IMPLICIT_STEPS, EXPLICIT_STEPS = 20, 100  # of a run with fixed steps
GROOVE = {"mesh.size": [0.2, 0.1, 0.1], "mesh.fine": [0.0, 0.0, 0.0]}

# The integrators of --quick, and how.
QUICK = [("backward-euler", "fixed"), ("forward-euler", "fixed"), ("theta", "adaptive"),
         ("esdirk-3", "adaptive"), ("esdirk-4", "located"), ("bdf", "adaptive"),
         ("erk-4", "adaptive")]

LOAD_HISTORY = {"load.times": [0.0, 300.0, 500.0], "load.factors": [1.0, 2.0, 0.5]}
SHORT_LOAD_HISTORY = {"load.times": [0.0, 6.0, 10.0], "load.factors": [1.0, 2.0, 0.5]}
BODY_VARIANTS = [
    {"body.element": "plain"},
    {"body.element": "f-bar-variational"},
    {"body.material": "linear"},
    {"wear.normal": "normalised"},
    {"shape.energy": "blatz-ko", "shape.stiffening": 1.0},
    {"contact.initial_gap": 0.01},
    {"contact.initial_gap": -0.01},
    {"solver.method": "direct"},
    {"solver.method": "block", "solver.preconditioner": "factor"},
]
MULTIGRID = {"solver.method": "block", "solver.preconditioner": "multigrid"}
MULTIPLIER = {"shape.constraint": "multiplier"}
VARIANTS = {
    "pin_on_flat/small_deformation": BODY_VARIANTS + [
        LOAD_HISTORY, MULTIPLIER,
        {"pin.sides": "held"}, {"mesh.distortion": 0.2}, {"body.young_modulus": 0.5},
        {"integrator.max_step": 20.0}, {"integrator.atol": 1e-6}],
    "pin_on_flat/finite_deformation": BODY_VARIANTS + [MULTIPLIER],
    "flat_punch/small_block": [{"mesh.grading": 1.1}, MULTIPLIER, SHORT_LOAD_HISTORY,
                               {"body.material": "linear"}],
    "ball_on_flat/small_deformation": BODY_VARIANTS + [
        LOAD_HISTORY, MULTIGRID, MULTIPLIER, {"friction.coefficient": 0.0}],
    "ball_on_flat/finite_deformation": [MULTIGRID, {"solver.method": "direct"}],
    "ball_on_half_space/small_deformation": BODY_VARIANTS + [
        LOAD_HISTORY, MULTIGRID, {"friction.coefficient": 0.0}, {"block.sides": "free"}],
    "ball_on_half_space/finite_deformation": [MULTIGRID, {"solver.method": "direct"}],
}
VARIANT_INTEGRATORS = ["esdirk-3", "bdf"]
RESUMED = ["backward-euler", "esdirk-4", "bdf", "erk-3"]
STABILITY = ["pin_on_flat/small_deformation", "flat_punch/small_block"]


def coarse_mesh(scene, quick):
    """Settings that make a run of the scene take less than a second."""
    if scene.startswith("pin_on_flat/"):
        return {"mesh.elements": [8, 8] if quick else [12, 12]}
    if scene == "flat_punch/half_plane":
        return {"mesh.punch_elements": 4}
    if scene.startswith("ball_on_flat/"):
        return {"mesh.elements": [3, 1, 1]}
    if scene.startswith("ball_on_half_space/"):
        return {"mesh.elements": [4, 8, 3]} | GROOVE
    return {}


def coarse_study(study, quick):
    """Settings for a study, and values of its sweeps instead of its own."""
    n = 8 if quick else 10
    if study.startswith("pin_on_flat/"):
        return {"mesh.elements": [n, n]}, {"mesh.elements": [[4, 4], [6, 6], [n, n]]}
    if study.startswith("ball_on_flat/"):
        return ({"mesh.elements": [3, 1, 1]} if quick else {}), {}
    if study == "ball_on_half_space/studies/steps_small":
        return {"mesh.elements": [4, 8, 3]} | GROOVE, {}
    return {}, {}


QUICK_STUDIES = ["pin_on_flat/studies/quick", "ball_on_flat/studies/steps_small",
                 "ball_on_half_space/studies/steps_finite"]


@dataclasses.dataclass
class Case:
    """One entry of the plan. `settings` are scene keys for both programs."""
    name: str
    kind: str  # run, study, stability, extremes
    file: str  # relative to problems/, without .toml
    settings: dict = dataclasses.field(default_factory=dict)
    may_be_refused: bool = False
    resume_at: float | None = None
    sweeps: dict = dataclasses.field(default_factory=dict)
    cost: int = 0  # those with more of it are started first


def scene_value(path, key):
    with open(path, "rb") as file:
        document = tomllib.load(file)
    return flattened(document).get(key)


def end_of(path):
    """The end of the run [s]; of a cycle, time.cycles periods."""
    end = scene_value(path, "time.end")
    return scene_value(path, "time.cycles") * scene_value(path, "cycle.period") if end is None else end


def shipped(problems, folder=None):
    """Names of the scenes in problems/*/, or of the studies in problems/*/FOLDER/."""
    files = problems.glob(f"*/{folder}/*.toml" if folder else "*/*.toml")
    return sorted(str(file.relative_to(problems))[:-len(".toml")] for file in files)


def scene_cases(problems, integrators, quick):
    modes = QUICK if quick else [(name, mode) for name in integrators
                                 for mode in ("adaptive", "fixed", "located")]
    for scene in shipped(problems):
        mesh, path = coarse_mesh(scene, quick), problems / f"{scene}.toml"
        for name, mode in modes:
            if name not in integrators:
                continue
            explicit = integrators[name].startswith("explicit")
            end = end_of(path)
            settings = mesh | {"integrator.name": name}
            if explicit and scene in STIFF_END:
                end = STIFF_END[scene]
                settings |= {"time.end": end, "output.times": []}
            if mode == "fixed":
                settings["integrator.step"] = end / (EXPLICIT_STEPS if explicit else IMPLICIT_STEPS)
            if mode == "located":
                settings["integrator.events"] = "locate"
            yield Case(f"{scene} {name} {mode}", "run", scene, settings,
                       may_be_refused=mode != "adaptive")


def variant_cases(problems, integrators, quick):
    for scene, variants in VARIANTS.items():
        if not (problems / f"{scene}.toml").exists():
            continue
        for settings in variants:
            label = " ".join(f"{key}={text_of(value)}" for key, value in settings.items())
            for name in VARIANT_INTEGRATORS[:1 if quick else None]:
                yield Case(f"{scene} {name} {label}", "run", scene,
                           coarse_mesh(scene, quick) | {"integrator.name": name} | settings)
    scene = "pin_on_flat/small_deformation"
    for name in RESUMED:
        if name in integrators and (problems / f"{scene}.toml").exists():
            yield Case(f"{scene} {name} resumed", "run", scene,
                       coarse_mesh(scene, quick) | {"integrator.name": name}, resume_at=500.0)


def study_cases(problems, quick):
    for study in shipped(problems, "studies"):
        if not quick or study in QUICK_STUDIES:
            settings, sweeps = coarse_study(study, quick)
            cost = 10_000 if study.startswith("ball") else 0
            cost += len((problems / f"{study}.toml").read_text())
            yield Case(study, "study", study, settings, sweeps=sweeps, cost=cost)


def stability_cases(problems, quick):
    for scene in STABILITY:
        if (problems / f"{scene}.toml").exists():
            yield Case(f"{scene} stability", "stability", scene, coarse_mesh(scene, quick))


# ---------------------------------------------------------------- TOML

def flattened(table, prefix=""):
    """{"mesh": {"elements": 3}} as {"mesh.elements": 3}; arrays of tables stay what they are."""
    result = {}
    for key, value in table.items():
        if isinstance(value, dict):
            result |= flattened(value, f"{prefix}{key}.")
        else:
            result[prefix + key] = value
    return result


def text_of(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return "[" + ", ".join(text_of(element) for element in value) + "]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def given_value(text):
    """The value of a --set, as TOML if it is valid TOML, otherwise as text."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


def toml_of(document):
    lines, tables = [], []
    for key, value in document.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            tables += [(key, table) for table in value]
        else:
            entries = flattened({key: value}) if isinstance(value, dict) else {key: value}
            lines += [f"{name} = {text_of(entry)}" for name, entry in entries.items()]
    for key, table in tables:
        lines += ["", f"[[{key}]]"]
        lines += [f"{name} = {text_of(entry)}" for name, entry in flattened(table).items()]
    return "\n".join(lines) + "\n"


def study_text(file, settings, sweeps):
    """The study with an absolute path of its scene, other common settings and other sweeps."""
    with open(file, "rb") as stream:
        document = tomllib.load(stream)
    document["scene"] = str((file.parent / document["scene"]).resolve())
    swept = {sweep["key"] for sweep in document.get("sweep", [])}
    for sweep in document.get("sweep", []):
        sweep["values"] = sweeps.get(sweep["key"], sweep["values"])
    common = flattened(document.get("set", {}))
    common |= {key: value for key, value in settings.items() if key not in swept}
    document["set"] = common
    if not common:
        del document["set"]
    return toml_of(document)


def study_keys(file):
    """Scene keys that a study gives itself."""
    with open(file, "rb") as stream:
        document = tomllib.load(stream)
    keys = {"integrator.name", "integrator.step", "integrator.rtol", "output.every", "output.last",
            "output.times", "output.checkpoints", *flattened(document.get("set", {}))}
    keys |= {sweep["key"] for sweep in document.get("sweep", [])}
    for table in document.get("method", []) + document.get("reference", []):
        keys |= set(flattened(table.get("set", {})))
    return keys


# ---------------------------------------------------------------- running

class Program:
    """One of the two binaries, its scenes, and the settings that only it gets."""

    def __init__(self, role, binary, problems, settings, options):
        self.role, self.binary, self.problems = role, binary, problems
        self.settings, self.options = settings, options
        self.folder = options.output / role
        self.keys = {}
        self.lock = threading.Lock()
        self.running = set()  # process ids
        self.stopped = False

    def fingerprint(self):
        digest = hashlib.sha256()
        for file in [self.binary, *sorted(self.binary.parent.glob("*.so"))]:
            digest.update(file.read_bytes())
        return digest.hexdigest()

    def ask(self, *arguments):
        answer = subprocess.run([self.binary, *arguments], capture_output=True, text=True)
        if answer.returncode != 0:
            print(f"{self.binary} {' '.join(arguments)}: exit code {answer.returncode}",
                  answer.stderr.strip(), file=sys.stderr)
            sys.exit(2)
        return answer.stdout

    def integrators(self):
        """{name: family}, as `gnomon list integrators` prints them."""
        lines = [re.split(r"\s{2,}", line.strip())
                 for line in self.ask("list", "integrators").splitlines()]
        return {line[0]: line[1] for line in lines[1:] if len(line) > 1}

    def known_keys(self, problem):
        with self.lock:
            if problem not in self.keys:
                text = self.ask("help", "scene", problem)
                self.keys[problem] = set(re.findall(r"^([a-z_]+(?:\.[a-z_]+)+):", text, re.M))
            return self.keys[problem]

    def own_settings(self, case):
        """The settings whose keys the problem of this case has and the case itself does not set."""
        if not self.settings:
            return {}
        keys = self.known_keys(case.file.split("/")[0])
        if case.kind in ("study", "extremes"):
            keys = keys - study_keys(self.problems / f"{case.file}.toml")
        return {key: value for key, value in self.settings.items()
                if key in keys and key not in case.settings}

    def execute(self, arguments, folder, limit):
        """Runs the program. Returns (exit code or None, CPU seconds); its output goes to `folder`."""
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                           PATH=f"{self.options.output / 'no_python'}:{os.environ['PATH']}")
        with open(folder / "stdout", "ab") as out, open(folder / "stderr", "ab") as err:
            with self.lock:
                if self.stopped:
                    raise KeyboardInterrupt
                process = subprocess.Popen([self.binary, *arguments], stdin=subprocess.DEVNULL,
                                           stdout=out, stderr=err, cwd=folder, env=environment)
                self.running.add(process.pid)
            timer = threading.Timer(limit, os.kill, (process.pid, signal.SIGKILL))
            timer.start()
            started = time.monotonic()
            _, status, usage = os.wait4(process.pid, 0)
            timer.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            with self.lock:
                self.running.discard(process.pid)
        timed_out = process.returncode == -signal.SIGKILL and time.monotonic() - started >= limit
        return None if timed_out else process.returncode, usage.ru_utime + usage.ru_stime

    def stop(self):
        with self.lock:
            self.stopped = True
            for process in self.running:
                os.kill(process, signal.SIGKILL)

    def has_kept(self, folder, key):
        file = folder / "key"
        return self.options.reuse and file.exists() and file.read_text() == key

    def run(self, case, fingerprint):
        """Runs the case, or finds its results of an earlier comparison. Returns their folder."""
        folder = self.folder / re.sub(r"[^A-Za-z0-9.=-]+", "_", case.name)
        file = self.problems / f"{case.file}.toml"
        settings = case.settings | self.own_settings(case)
        problem = self.problems / case.file.split("/")[0]
        texts = [scene.read_text() for scene in [file, *sorted(problem.glob("*.toml"))]]
        key = json.dumps([fingerprint, case.kind, str(file), texts, settings, case.sweeps,
                          case.resume_at])
        if self.role == "reference" and self.has_kept(folder, key):
            return folder
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        commands = getattr(self, f"{case.kind}_commands")(case, file, settings, folder)
        code, seconds = 0, 0.0
        for command in commands:
            code, more = self.execute(command, folder, self.options.limit)
            seconds += more
            if code != 0:
                break
        (folder / "end.json").write_text(json.dumps({"code": code, "cpu": seconds}))
        (folder / "key").write_text(key)
        return folder

    @staticmethod
    def overrides(settings):
        return [word for key, value in settings.items()
                for word in ("--set", f"{key}={text_of(value)}")]

    def run_commands(self, case, file, settings, folder):
        result, summary = folder / "run.h5", folder / "run.json"
        head = settings | ({"time.end": case.resume_at} if case.resume_at else {})
        commands = [["run", file, *self.overrides(head), "--quiet", "-o", result,
                     "--summary", summary]]
        if case.resume_at:
            commands.append(["resume", result, "--quiet", "--force", "--summary", summary,
                             "--end", repr(end_of(file))])
        return commands

    def study_commands(self, case, file, settings, folder):
        study = folder / file.name
        study.write_text(study_text(file, settings, case.sweeps))
        return [["study", study, "-o", folder / "study", "--jobs", "1", "--quiet"]]

    def stability_commands(self, case, file, settings, folder):
        return [["stability", file, *self.overrides(settings), "-o", folder / "stability"]]


# ---------------------------------------------------------------- outcomes

COUNTS = {"steps": "steps", "rejected": "rejected_steps", "events": "events",
          "newton": "newton_iterations", "factorizations": "factorizations"}
OTHER_COUNTS = ["residual_evaluations", "jacobian_evaluations", "linear_solves",
                "krylov_iterations", "preconditioner_setups", "chattering_nodes"]


@dataclasses.dataclass
class Outcome:
    """The end of one run, from its files."""
    code: int | None
    words: str = ""
    summary: dict = dataclasses.field(default_factory=dict)
    cpu: float = 0.0
    end: float = 1.0
    scalars: dict = dataclasses.field(default_factory=dict)  # name: (last value, largest value)
    worn: np.ndarray | None = None
    depth: float = 0.0
    pressure: np.ndarray | None = None
    fields: dict = dataclasses.field(default_factory=dict)
    damage: str = ""

    def counts(self):
        return {name: self.summary.get(key) for name, key in COUNTS.items()}


def read_json(file):
    try:
        return json.loads(file.read_text())
    except (OSError, ValueError):
        return {}


def last_line(file):
    try:
        lines = [line for line in file.read_text(errors="replace").splitlines() if line.strip()]
    except OSError:
        return ""
    return lines[-1].removeprefix("gnomon: ") if lines else ""


def read_outcome(code, cpu, stderr, summary, result):
    outcome = Outcome(code, words=last_line(stderr), summary=read_json(summary), cpu=cpu)
    if result.exists():
        try:
            with h5py.File(result) as file:
                read_result(file, outcome)
        except (OSError, KeyError, ValueError, IndexError) as error:
            outcome.damage = f"{result.name} cannot be read: {error}"
    elif code == 0:
        outcome.damage = "no result"
    return outcome


def read_result(file, outcome):
    history = file["gnomon/history"][:]
    counters = set(COUNTS.values()) | set(OTHER_COUNTS)
    if len(history):
        outcome.end = float(history["t"][-1])
        for name in history.dtype.names:
            if name not in counters:
                column = np.abs(history[name].astype(float))
                largest = column[np.isfinite(column)].max(initial=0.0)
                if name in ("t", "step_size"):
                    largest = outcome.end
                outcome.scalars[name] = (float(history[name][-1]), largest)
    stored = file["gnomon/stored"][:]
    if not len(stored):
        return
    path = stored["path"][-1].decode()
    for name, field in file.get(path, {}).items():
        outcome.fields[name] = field[:].astype(float)
    contact = file["gnomon/contact"].get(path.removeprefix("steps/"))
    if contact is not None:
        table = contact[:]
        outcome.worn = np.stack([table[axis] for axis in "XYZ"], axis=1)
        initial = np.stack([table[f"{axis}0"] for axis in "XYZ"], axis=1)
        outcome.depth = max(np.abs(table["wear_depth"]).max(initial=0.0),
                            1e-9 * np.ptp(initial, axis=0).max(initial=0.0))
        outcome.pressure = table["pressure"]


# ---------------------------------------------------------------- comparing

@dataclasses.dataclass
class Row:
    """A line of the table."""
    case: str
    kind: str
    verdict: str = "equal"  # equal, not offered, DIFFERS
    counts: str = "="
    surface: float | None = None
    pressure: float | None = None
    scalars: float | None = None
    worst_scalar: str = ""
    fields: float | None = None
    worst_field: str = ""
    cpu_reference: float | None = None
    cpu_candidate: float | None = None
    notes: list = dataclasses.field(default_factory=list)

    def differs(self, why):
        self.verdict = "DIFFERS"
        if why:
            self.notes.append(why)


def difference(a, b, scale):
    """Largest difference divided by the scale; infinite if the two cannot be compared."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    if a.shape != b.shape or not np.array_equal(np.isfinite(a), np.isfinite(b)):
        return math.inf
    finite = np.isfinite(a)
    if not np.array_equal(a[~finite], b[~finite], equal_nan=True):
        return math.inf
    largest = float(np.abs(a[finite] - b[finite]).max(initial=0.0))
    if largest == 0:
        return 0.0
    return largest / scale if scale > 0 else math.inf


class Comparison:
    def __init__(self, options):
        self.options = options

    def runs(self, name, kind, a, b, may_be_refused=False):
        """Compares two outcomes of one run."""
        row = Row(name, kind, cpu_reference=a.cpu, cpu_candidate=b.cpu)
        if a.code is None or b.code is None:
            who = " and ".join(role for role, outcome in (("reference", a), ("candidate", b))
                               if outcome.code is None)
            row.differs(f"took longer than {self.options.limit:g} s: {who}")
            return row
        self.measure(row, a, b)
        if a.code != b.code:
            row.differs(f"exit codes {a.code} and {b.code}: {self.cause(a)} / {self.cause(b)}")
        elif a.code == 0:
            self.judge(row, a, b)
        elif a.code not in (2, 3):
            row.differs(f"both end with exit code {a.code}: {self.cause(a)}")
        elif self.diagnosis(a) != self.diagnosis(b):
            row.differs(f"both fail, but differently: {self.cause(a)} / {self.cause(b)}")
        elif a.code == 3:
            row.notes.append(f"both fail: {self.cause(a)}")
        elif may_be_refused:
            row.verdict = "not offered"
            row.notes.append(self.cause(a))
        else:
            row.differs(f"both refuse it, which compares nothing: {self.cause(a)}")
        return row

    @staticmethod
    def cause(outcome):
        return outcome.summary.get("diagnosis") or outcome.words

    def diagnosis(self, outcome):
        text = self.cause(outcome)
        for place in self.options.places:  # the same file may lie in two places
            text = text.replace(place, "")
        if self.options.ignore_wording:
            return re.findall(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text)
        return text

    def measure(self, row, a, b):
        counts = [(name, value, b.counts()[name]) for name, value in a.counts().items()]
        row.counts = ", ".join(f"{name} {one} / {other}" for name, one, other in counts
                               if one != other) or "="
        for name in OTHER_COUNTS:
            one, other = a.summary.get(name), b.summary.get(name)
            if one != other and name in a.summary and name in b.summary:
                row.notes.append(f"{name} {one} / {other}")
        if len(a.summary.get("warnings", [])) != len(b.summary.get("warnings", [])):
            row.notes.append(f"warnings: {a.summary.get('warnings')} / {b.summary.get('warnings')}")
        if a.worn is not None or b.worn is not None:
            row.surface = self.pair(a.worn, b.worn, a.depth)
            row.pressure = self.pair(a.pressure, b.pressure,
                                     0 if a.pressure is None else np.abs(a.pressure).max(initial=0))
        row.scalars, row.worst_scalar = self.worst(
            {name: self.pair(value, b.scalars.get(name, (None,))[0], largest)
             for name, (value, largest) in a.scalars.items()
             if name not in self.options.ignore_scalar})
        row.fields, row.worst_field = self.worst(
            {name: self.pair(field, b.fields.get(name), np.abs(field).max(initial=0))
             for name, field in a.fields.items()
             if name not in self.options.ignore_field})
        for what, one, other in (("scalars", a.scalars, b.scalars), ("fields", a.fields, b.fields)):
            for name in one.keys() - other.keys() - set(self.options.ignore_field):
                row.notes.append(f"{what}: the candidate has no {name}")
            if other.keys() - one.keys():
                row.notes.append(f"new {what}: " + " ".join(sorted(other.keys() - one.keys())))

    @staticmethod
    def pair(a, b, scale):
        return math.inf if a is None or b is None else difference(a, b, scale)

    @staticmethod
    def worst(differences):
        if not differences:
            return None, ""
        name = max(differences, key=differences.get)
        return differences[name], name if differences[name] > 0 else ""

    def judge(self, row, a, b):
        for outcome in (a, b):
            if outcome.damage:
                row.differs(outcome.damage)
        if not a.scalars and not a.fields:
            row.differs("the reference left nothing to compare")
        if row.counts != "=":
            if self.options.allow_counts:
                row.notes.append("counts differ, which is allowed")
            else:
                row.differs("counts differ")
        for what in ("surface", "pressure", "scalars", "fields"):
            value = getattr(row, what)
            if value is not None and not value <= self.options.tolerance:
                row.differs(what)

    def case(self, case, reference, candidate):
        return getattr(self, f"{case.kind}_rows")(case, reference, candidate)

    def run_rows(self, case, *folders):
        outcomes = []
        for folder in folders:
            end = read_json(folder / "end.json")
            outcomes.append(read_outcome(end["code"], end["cpu"], folder / "stderr",
                                         folder / "run.json", folder / "run.h5"))
        return [self.runs(case.name, "run", *outcomes, may_be_refused=case.may_be_refused)]

    def study_rows(self, case, *folders):
        """One row per run of the study, and one for its table."""
        ends = [read_json(folder / "end.json") for folder in folders]
        row = Row(f"{case.name} study.csv", "table", cpu_reference=ends[0]["cpu"],
                  cpu_candidate=ends[1]["cpu"])
        if ends[0]["code"] != ends[1]["code"]:
            row.differs(f"exit codes {ends[0]['code']} and {ends[1]['code']}: "
                        + " / ".join(last_line(folder / "stderr") for folder in folders))
        runs = [self.study_outcomes(folder / "study" / "runs") for folder in folders]
        rows = []
        for name in sorted(runs[0] | runs[1]):
            if name in runs[0] and name in runs[1]:
                rows.append(self.runs(f"{case.name} {name}", "study", runs[0][name], runs[1][name]))
            else:
                rows.append(Row(f"{case.name} {name}", "study"))
                rows[-1].differs("only the " + ("reference" if name in runs[0] else "candidate")
                                 + " has this run")
        if not rows:
            row.differs("the study has no runs: " + last_line(folders[0] / "stderr"))
        depth = max((run.depth for run in runs[0].values()), default=0)
        pressure = max((np.abs(run.pressure).max(initial=0) for run in runs[0].values()
                        if run.pressure is not None), default=0)
        shape_errors = ["shape_error", "shape_error_max", "shape_error_self", "reference_error"]
        self.tables(row, *(folder / "study" / "study.csv" for folder in folders),
                    ["sweep", "run"], text=["status", "marked", "reference"],
                    numbers=dict.fromkeys(shape_errors, depth) | {"pressure_error": pressure},
                    tolerance=self.options.tolerance)
        return [row, *rows]

    @staticmethod
    def study_outcomes(folder):
        outcomes = {}
        for file in folder.glob("*.process.json"):
            name = file.name.removesuffix(".process.json")
            end = read_json(file)
            code = end.get("exit_code", -1)
            if end.get("signal"):
                code = -end["signal"]
            outcomes[name] = read_outcome(code, end.get("cpu_seconds", 0.0),
                                          folder / f"{name}.log", folder / f"{name}.json",
                                          folder / f"{name}.h5")
        return outcomes

    def tables(self, row, a, b, keys, text, numbers, tolerance):
        """Compares two CSV tables line by line, the columns of `numbers` by their scales."""
        tables = []
        for file in (a, b):
            if not file.exists():
                row.differs(f"no {file.name}")
                return
            with open(file, newline="") as stream:
                tables.append({tuple(line[key] for key in keys): line
                               for line in csv.DictReader(stream)})
        a, b = tables
        if a.keys() != b.keys():
            row.differs(f"{len(a)} and {len(b)} lines, {len(a.keys() & b.keys())} of them in both")
        common = [key for key in a if key in b]
        for column in text:
            for key in common:
                if a[key].get(column) != b[key].get(column):
                    row.differs(f"{' '.join(key)}: {column} {a[key].get(column)} / "
                                f"{b[key].get(column)}")
        worst = {column: self.columns([a[key].get(column) for key in common],
                                      [b[key].get(column) for key in common], scale)
                 for column, scale in numbers.items() if common and column in a[common[0]]}
        row.scalars, row.worst_scalar = self.worst(worst)
        if row.scalars is not None and not row.scalars <= tolerance:
            row.differs("numbers of the table")

    @staticmethod
    def columns(a, b, scale):
        """Without a scale: relative to the largest number of the column."""
        if [bool(value) for value in a] != [bool(value) for value in b]:
            return math.inf
        a, b = ([float(value) for value in column if value] for column in (a, b))
        finite = [abs(value) for value in a if math.isfinite(value)]
        return difference(a, b, max(finite, default=0) if scale is None else scale)

    def stability_rows(self, case, *folders):
        ends = [read_json(folder / "end.json") for folder in folders]
        row = Row(case.name, "stability", cpu_reference=ends[0]["cpu"],
                  cpu_candidate=ends[1]["cpu"])
        if [end["code"] for end in ends] != [0, 0]:
            row.differs(f"exit codes {ends[0]['code']} and {ends[1]['code']}: "
                        + " / ".join(last_line(folder / "stderr") for folder in folders))
            return [row]
        tolerance = max(self.options.tolerance, 1e-8)  # the tables have ten digits
        self.tables(row, *(folder / "stability" / "critical_steps.csv" for folder in folders),
                    ["time", "method"], text=[], tolerance=tolerance,
                    numbers={"critical_step": None, "empirical": None})
        critical = row.scalars or 0.0, row.worst_scalar
        spectra = []
        for folder in folders:
            with open(folder / "stability" / "spectrum.csv", newline="") as stream:
                spectra.append([[float(value) for value in line.values()]
                                for line in csv.DictReader(stream)])
        worst = difference(*spectra, np.abs(spectra[0]).max(initial=0) if spectra[0] else 0)
        if not worst <= tolerance:
            row.differs("spectrum")
        row.scalars, row.worst_scalar = max(critical, (worst, "spectrum" if worst else ""))
        return [row]


# ---------------------------------------------------------------- extremes

def extremes_rows(programs, options):
    """Runs `gnomon extremes` by both programs and compares the verdicts."""
    folders = []
    for program in programs:
        folder = program.folder / "extremes"
        shutil.rmtree(folder, ignore_errors=True)
        studies = []
        for name in shipped(program.problems, "extremes"):
            if not selected(name, options.scenes):
                continue
            file = folder / "studies" / f"{name}.toml"
            file.parent.mkdir(parents=True, exist_ok=True)
            case = Case(name, "extremes", name)
            file.write_text(study_text(program.problems / f"{name}.toml",
                                       program.own_settings(case), {}))
            studies.append(file)
        if not studies:
            return []
        program.execute(["extremes", *studies, "-o", folder / "extremes", "--jobs",
                         str(options.jobs), "--limit", str(options.limit), "--quiet"], folder,
                        limit=24 * 3600)
        folders.append(folder)
    tables = []
    for folder in folders:
        file = folder / "extremes" / "extremes.csv"
        lines = []
        if file.exists():
            with open(file, newline="") as stream:
                lines = list(csv.DictReader(stream))
        tables.append({(line["study"], line["sweep"], line["run"]): line for line in lines})
    return [extremes_row(key, *(table.get(key) for table in tables))
            for key in tables[0] | tables[1]] or [no_extremes(folders)]


def no_extremes(folders):
    row = Row("extremes", "extremes")
    row.differs("no verdicts: " + " / ".join(last_line(folder / "stderr") for folder in folders))
    return row


def extremes_row(key, a, b):
    row = Row("extremes " + " ".join(filter(None, key)), "extremes")
    if a is None or b is None:
        row.differs("only the " + ("candidate" if a is None else "reference") + " has this case")
        return row
    if a["steps"] != b["steps"]:
        row.counts = f"steps {a['steps']} / {b['steps']}"
    if a["verdict"] != b["verdict"]:
        row.differs(f"{a['verdict']} ({a['reason']}) / {b['verdict']} ({b['reason']})")
    elif a["reason"] != b["reason"]:
        row.notes.append(f"{a['reason']} / {b['reason']}")
    return row


# ---------------------------------------------------------------- reports

def number(value):
    return "" if value is None else f"{value:.1e}" if value else "0"


def described(row):
    parts = [] if row.counts == "=" else [row.counts]
    parts += [f"{what} {number(getattr(row, what))}" for what in ("surface", "pressure")
              if getattr(row, what)]
    parts += [f"{name} {number(value)}" for name, value in
              ((row.worst_scalar, row.scalars), (row.worst_field, row.fields)) if name]
    return "; ".join(parts + row.notes)


def csv_report(file, rows):
    with open(file, "w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(["case", "kind", "verdict", "counts", "surface", "pressure", "scalars",
                         "worst_scalar", "fields", "worst_field", "cpu_reference",
                         "cpu_candidate", "notes"])
        for row in rows:
            values = [getattr(row, name) for name in
                      ("surface", "pressure", "scalars", "worst_scalar", "fields", "worst_field",
                       "cpu_reference", "cpu_candidate")]
            writer.writerow([row.case, row.kind, row.verdict, row.counts,
                             *("" if value is None else value for value in values),
                             "; ".join(row.notes)])


def markdown_line(row):
    cells = [row.case, row.verdict, row.counts, number(row.surface), number(row.pressure),
             f"{number(row.scalars)} {row.worst_scalar}".strip(),
             f"{number(row.fields)} {row.worst_field}".strip(), "; ".join(row.notes)]
    return "| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |"


def markdown_report(file, rows, header, summary):
    lines = ["# Comparison of two builds", "", *header, "", summary, "",
             "| case | verdict | counts | surface | pressure | scalars | fields | notes |",
             "|---|---|---|---|---|---|---|---|"]
    ordered = sorted(rows, key=lambda row: (row.verdict != "DIFFERS", row.verdict))
    file.write_text("\n".join(lines + [markdown_line(row) for row in ordered]) + "\n")


def summary_of(rows, tolerance, seconds):
    counted = [row for row in rows if row.verdict != "not offered"]
    differing = [row for row in counted if row.verdict == "DIFFERS"]
    failing = [row for row in counted if row.verdict == "equal"
               and any(note.startswith("both fail") for note in row.notes)]
    exact = [row for row in counted if row.verdict == "equal" and row.counts == "="
             and row.kind != "extremes" and row not in failing
             and not any(getattr(row, what) for what in
                         ("surface", "pressure", "scalars", "fields"))]
    skipped = len(rows) - len(counted)
    return (f"{len(counted)} cases: {len(counted) - len(differing)} equal to {tolerance:g} "
            f"({len(exact)} in every digit, {len(failing)} fail in both alike), "
            f"{len(differing)} differ; {skipped} combinations not offered; {seconds:.0f} s")


# ---------------------------------------------------------------- command line

def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reference", type=Path, metavar="REFERENCE_BINARY")
    parser.add_argument("candidate", type=Path, metavar="CANDIDATE_BINARY")
    parser.add_argument("--scenes", nargs="+", default=[], metavar="PATTERN",
                        help="only cases whose name contains one of these words, or matches it as "
                        "a pattern with * (names are in the first column of the report)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N",
                        help="number of cases at the same time; default: the number of cores")
    parser.add_argument("--quick", action="store_true",
                        help="fewer integrators, variants and studies: less than two minutes")
    parser.add_argument("--extremes", action="store_true",
                        help="also the verdicts of gnomon extremes: a few minutes for each program")
    parser.add_argument("--only-extremes", action="store_true", help="these verdicts alone")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="scene key for the candidate only, in all problems that have the key "
                        "and all cases that do not set it themselves; repeatable")
    parser.add_argument("--tolerance", type=float, default=1e-10,
                        help="largest relative difference; default: 1e-10")
    parser.add_argument("--allow-counts", action="store_true",
                        help="report differences of counts, but do not fail because of them")
    parser.add_argument("--ignore-scalar", action="append", default=[], metavar="NAME",
                        help="a column of the history that may differ; repeatable")
    parser.add_argument("--ignore-field", action="append", default=[], metavar="NAME",
                        help="a field that may differ or be absent; repeatable")
    parser.add_argument("--ignore-wording", action="store_true",
                        help="compare only the numbers of a diagnosis")
    parser.add_argument("--problems", type=Path, default=ROOT / "problems", metavar="DIR",
                        help="scenes and studies for both; default: those beside this script")
    parser.add_argument("--candidate-problems", type=Path, metavar="DIR",
                        help="scenes and studies of the candidate, if they have changed; the cases are "
                        "those of --problems")
    parser.add_argument("--reuse", action="store_true",
                        help="reuse results that the same reference has computed in DIR before")
    parser.add_argument("--keep", action="store_true",
                        help="keep the candidate's results also if they are equal")
    parser.add_argument("--limit", type=float, default=600, metavar="SECONDS",
                        help="wall time of one case; default: 600")
    parser.add_argument("--list", action="store_true", help="print the names of the cases and stop")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "build" / "comparison",
                        metavar="DIR", help="reports and results; default: build/comparison")
    return checked(parser, parser.parse_args())


def checked(parser, options):
    """Paths made absolute, settings parsed. Bad input ends the program with exit code 2."""
    for name in ("reference", "candidate"):
        binary = getattr(options, name).resolve()
        if not os.access(binary, os.X_OK) or binary.is_dir():
            parser.error(f"{binary}: expected an executable file")
        setattr(options, name, binary)
    options.problems = options.problems.resolve()
    options.candidate_problems = (options.candidate_problems or options.problems).resolve()
    for folder in (options.problems, options.candidate_problems):
        if not shipped(folder):
            parser.error(f"{folder}: expected a folder with scenes (*/*.toml)")
    options.output = options.output.resolve()
    options.jobs = max(1, options.jobs)
    options.settings = {}
    for text in options.set:
        key, equals, value = text.partition("=")
        if not equals:
            parser.error(f"--set {text}: expected KEY=VALUE")
        options.settings[key.strip()] = given_value(value.strip())
    options.places = [str(options.problems), str(options.candidate_problems),
                      str(options.output / "reference"), str(options.output / "candidate")]
    return options


def selected(name, patterns):
    return not patterns or any(pattern in name or fnmatch.fnmatchcase(name, pattern)
                               for pattern in patterns)


def planned(options, reference):
    integrators = reference.integrators()
    if not integrators:
        sys.exit(f"{reference.binary}: `list integrators` names none")
    cases = [*study_cases(options.problems, options.quick),
             *stability_cases(options.problems, options.quick),
             *scene_cases(options.problems, integrators, options.quick),
             *variant_cases(options.problems, integrators, options.quick)]
    cases = [case for case in cases if selected(case.name, options.scenes)]
    return sorted(cases, key=lambda case: -case.cost)


def check_settings(options, candidate, cases):
    """A misspelt key would have no effect and would not be noticed."""
    names = {case.file.split("/")[0] for case in cases}
    names |= {name.split("/")[0] for name in shipped(options.problems)}
    for key in options.settings:
        if not any(key in candidate.known_keys(name) for name in names):
            print(f"--set {key}: no problem of the candidate has this key", file=sys.stderr)
            sys.exit(2)


def run_all(cases, programs, options):
    comparison = Comparison(options)
    fingerprints = [program.fingerprint() for program in programs]
    rows, done, lock = {}, 0, threading.Lock()

    def both(index):
        nonlocal done
        case = cases[index]
        folders = [program.run(case, fingerprint)
                   for program, fingerprint in zip(programs, fingerprints)]
        found = comparison.case(case, *folders)
        if not options.keep and all(row.verdict != "DIFFERS" for row in found):
            shutil.rmtree(folders[1])
        with lock:
            rows[index] = found
            done += 1
            if sys.stderr.isatty():
                print("\r" + " " * 20 + "\r", end="", file=sys.stderr, flush=True)
            for row in found:
                if row.verdict == "DIFFERS":
                    print(f"DIFFERS {row.case}: {described(row)}", flush=True)
            if sys.stderr.isatty():
                print(f"{done} of {len(cases)}", end="", file=sys.stderr, flush=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        try:
            for task in [pool.submit(both, index) for index in range(len(cases))]:
                task.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            for program in programs:
                program.stop()
            raise
    if sys.stderr.isatty():
        print("\r" + " " * 20 + "\r", end="", file=sys.stderr)
    return [row for index in sorted(rows) for row in rows[index]]


def main():
    options = arguments()
    started = time.monotonic()
    reference = Program("reference", options.reference, options.problems, {}, options)
    candidate = Program("candidate", options.candidate, options.candidate_problems,
                        options.settings, options)
    cases = [] if options.only_extremes else planned(options, reference)
    if options.list:
        print("\n".join(case.name for case in cases))
        return 0
    check_settings(options, candidate, cases)
    no_python = options.output / "no_python"  # keeps studies from drawing figures
    no_python.mkdir(parents=True, exist_ok=True)
    if not (no_python / "python3").is_symlink():
        (no_python / "python3").symlink_to("/bin/false")
    programs = (reference, candidate)
    rows = run_all(cases, programs, options)
    if options.extremes or options.only_extremes:
        rows += extremes_rows(programs, options)
        for row in rows:
            if row.kind == "extremes" and row.verdict == "DIFFERS":
                print(f"{row.verdict} {row.case}: {'; '.join(row.notes)}")
    if not rows:
        print("no case has such a name (--list prints them)", file=sys.stderr)
        return 2
    summary = summary_of(rows, options.tolerance, time.monotonic() - started)
    header = [f"Reference `{options.reference}`, candidate `{options.candidate}`"
              + "".join(f", `--set {text}`" for text in options.set) + ".", "",
              f"Scenes: `{options.problems}`"
              + (f", of the candidate `{options.candidate_problems}`"
                 if options.candidate_problems != options.problems else "") + "."]
    csv_report(options.output / "comparison.csv", rows)
    markdown_report(options.output / "comparison.md", rows, header, summary)
    print(f"table: {options.output / 'comparison.md'}")
    print(summary)
    return 1 if any(row.verdict == "DIFFERS" for row in rows) else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("interrupted")
