"""The paper's examples: the pin in the plane, the ball and the groove in space."""

import csv
import pathlib
import tempfile

from program import ROOT, gnomon, percent, run

from gallery.entry import Drawn, Entry, plotted

PROBLEMS = ROOT / "problems"


def study(name, *figures):
    """Rows and figures of a study of the pin."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "study"
        gnomon("study", PROBLEMS / "pin_on_flat/studies" / f"{name}.toml", "-o", out, "--jobs", 1, "--quiet")
        with open(out / "study.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file)), plotted(out, *figures)


def shapes(_full):
    rows, figures = study("shapes", "shapes-body.young-modulus-20", "shapes-body.young-modulus-640")
    table = [[f"{float(row['body.young_modulus']):g}", row["integrator"], f"{float(row['setting']):g}",
              f"{float(row['shape_error']):.1e}", f"{float(row['max_pressure']):.2f}"] for row in rows]
    return Drawn(figures, ["Worn surfaces for E = 20 MPa, steps of 200 s and 5 s",
                           "Worn surfaces for E = 640 MPa, steps of 200 s and 5 s"],
                 ["E [MPa]", "method", "step [s]", "shape error [mm]", "largest pressure at 1000 s [MPa]"], table)


def errors(_full):
    rows, figures = study("quick", "error-step")
    table = [[f"{float(row['body.young_modulus']):g}", row["integrator"],
              f"{row['setting_kind']} {float(row['setting']):g}", f"{float(row['shape_error']):.1e}", row["steps"],
              row["newton_iterations"]] for row in rows]
    return Drawn(figures, ["Shape error against the step, for two stiffnesses"],
                 ["E [MPa]", "method", "setting", "shape error [mm]", "steps", "Newton iterations"], table)


# Settings of coarse meshes, and the number of steps that the paper took.
SPACE = {
    "ball_on_flat/small_deformation": (["mesh.elements=[8, 3, 4]"], 17),
    "ball_on_flat/finite_deformation": (["mesh.elements=[8, 3, 4]"], 10),
    "ball_on_half_space/small_deformation": (
        ["mesh.elements=[10, 20, 6]", "mesh.size=[0.06, 0.06, 0.06]", "mesh.fine=[0, 0, 0]"], 26),
    "ball_on_half_space/finite_deformation": (["mesh.elements=[8, 10, 6]", "mesh.fine=[0, 0, 0]"], 32),
}


def in_space(problem, figure):
    def draw(full):
        rows, figures = [], []
        for kind in ("small", "finite"):
            scene = f"{problem}/{kind}_deformation"
            settings, steps = SPACE[scene]
            done = run(PROBLEMS / f"{scene}.toml", *([] if full else settings))
            end = done.history()[-1]
            figures += plotted(done.result, figure)
            size = end.get("groove_section")
            rows.append([kind, done.unknowns, f"{done.steps} ({steps})", done.newton, f"{end['max_pressure']:.4g}",
                         f"{end['approach']:.4f}", f"{end['worn_volume']:.4f}",
                         percent(end["worn_volume"] / end["wear_integral"]), "" if size is None else f"{size:.4f}"])
        return Drawn(figures, [f"{kind} deformations" for kind in ("Small", "Finite")],
                     ["deformations", "unknowns", "steps (paper)", "Newton iterations", "largest pressure [MPa]",
                      "approach [mm]", "worn volume [mm^3]", "against the wear integral",
                      "section of the groove [mm^2]"], rows)
    return draw


ENTRIES = [
    Entry("pin-shapes", "The paper's pin: shapes (figs. 2 and 4)", """
Contact surfaces of the pin by backward and forward Euler with steps of 200 s (solid) and 5 s (dashed). With E =
20 MPa both methods follow the short steps; with E = 640 MPa forward Euler is unstable at 200 s, as in the
paper.""",
          shapes),
    Entry("pin-errors", "The paper's pin: errors against steps (figs. 5 and 6)", """
20 x 20 elements. Errors are Euclidean norms over the contact nodes against a reference whose own error is
estimated ([studies](studies.md)). Euler's methods are of order one, forward Euler up to its critical step. [All
stiffnesses and meshes](stability.md#over-youngs-modulus-and-mesh).""", errors),
    Entry("ball", "The paper's ball on a flat (sec. 4.2)", """
Contact pressures at four times, with friction; small deformations (E = 100 GPa) and finite ones (E = 10 MPa); a
coarse mesh with elements of 0.3 mm. [At the paper's size](three_dimensions.md).""",
          in_space("ball_on_flat", "pressure-map")),
    Entry("groove", "The paper's groove in a half-space (sec. 4.3)", """
The block streams past the ball, and its worn shape is a field of one cross-section. Worn and deformed meshes
with the equivalent stress, small and finite deformations, on coarse meshes. [At the paper's
size](three_dimensions.md).""",
          in_space("ball_on_half_space", "mesh")),
]
