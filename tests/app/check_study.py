"""What the figures of a study show of its table.

usage: check_study.py FOLDER_OF_THE_PLOTS
"""

import dataclasses
import json
import math
import pathlib
import sys
import tempfile

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
from figures import errors, fretting_map, parameters, style, work  # noqa: E402
from figures.complaints import Unsuitable  # noqa: E402
from figures.study import Run, mark_unstable  # noqa: E402

style.apply()


def run(method, integrator, setting, sweep="", pressure_error=1e-2):
    return Run(study="a", sweep=sweep, method=method, integrator=integrator, setting_kind="rtol",
               run="", status="finished", marked=False, setting=setting, shape_error=setting,
               shape_error_self=math.nan, pressure_error=pressure_error, reference_error=1e-9,
               newton_iterations=1 / setting, factorizations=0.1 / setting, cpu_seconds=1.0)


def runs(sweep="", **further):
    return [run(method, integrator, setting, sweep, **further)
            for method, integrator in (("bdf", "bdf"), ("esdirk-4", "esdirk-4"),
                                       ("esdirk-4 located", "esdirk-4"))
            for setting in (1e-2, 1e-4)]


# The methods of an integrator: one colour and one sign, filled for the first only.
looks = work.looks_of_methods(runs())
first, second = looks["esdirk-4"], looks["esdirk-4 located"]
assert first["color"] == second["color"] != looks["bdf"]["color"]
assert first["marker"] == second["marker"] != looks["bdf"]["marker"]
assert "markerfacecolor" not in first and second["markerfacecolor"] == "white"

# Shape errors against three costs; pressure errors below them if they are known.
drawn = work.draw(runs())
assert [axes.get_ylabel() for axes in drawn.axes[::3]] == ["shape error [mm]",
                                                           "pressure error [MPa]"]
assert list(drawn.axes[3].lines[1].get_ydata()) == [1e-2, 1e-2]
assert list(drawn.axes[3].lines[1].get_xdata()) == [1e4, 1e2]
assert len(work.draw(runs(pressure_error=math.nan)).axes) == 3

# Errors against Newton iterations: a panel for each method, a line for each value of the sweep.
swept = errors.draw_sweep_work(runs("kappa=0") + runs("kappa=0.1"))
assert [axes.get_title() for axes in swept.axes] == ["bdf", "esdirk-4", "esdirk-4 located"]
lines = [line for line in swept.axes[0].lines if len(line.get_xdata())]
assert all(list(line.get_xdata()) == [1e4, 1e2] for line in lines)
assert len({line.get_color() for line in lines}) == 2
timed = errors.draw_sweep_time(runs("mesh.factor=2") + runs("mesh.factor=1"))
assert timed.axes[-1].get_xlabel() == "CPU time [s]"
try:
    errors.draw_sweep_time(runs("kappa=0") + runs("kappa=0.1"))
    raise AssertionError("these meshes are the same")
except Unsuitable:
    pass
try:
    errors.draw_sweep_work(runs())
    raise AssertionError("without a sweep there is nothing to compare")
except Unsuitable:
    pass

# Runs beyond the critical step, whose pressures are wrong, are crosses and have no slope: first order, not second.
def euler(setting, shape_error, pressure_error, largest):
    made = run("forward-euler", "forward-euler", setting, pressure_error=pressure_error)
    return dataclasses.replace(made, setting_kind="step", shape_error=shape_error, max_pressure=largest)


steps = [euler(6.25, 7.5e-4, 3.3e-4, 4.47), euler(12.5, 1.5e-3, 6.6e-4, 4.47), euler(25, 3e-3, 1.3e-3, 4.47)]
unstable = [euler(50, 2.7e-2, 5.5, 10), euler(100, 1e-1, 8, 14), euler(200, 3.8e-1, 15.9, 20.3)]
mark_unstable(steps + unstable)
assert [made.unstable for made in steps + unstable] == [False] * 3 + [True] * 3
(axes,) = errors.draw_steps(steps + unstable).axes
crosses = [line for line in axes.lines if line.get_marker() == "x"]
assert [list(line.get_xdata()) for line in crosses] == [[50, 100, 200]]
assert list(crosses[0].get_ydata()) == [2.7e-2, 1e-1, 3.8e-1], "where they are"
assert [text.get_text() for text in axes.texts] == ["1"]

# A parameter sweep: the swept key with the unit that study.json has for it.
rows = [{"status": "finished", "sweep": f"body.young_modulus={value}", "method": "bdf", "setting_kind": "rtol",
         "setting": "1e-3", "body.young_modulus": value, "worn_volume": value} for value in ("20", "640")]
with tempfile.TemporaryDirectory() as folder:
    table = pathlib.Path(folder) / "study.csv"
    assert parameters.draw(table, rows).axes[0].get_xlabel() == "body.young_modulus"
    columns = [{"name": "body.young_modulus", "unit": "MPa"}]
    for some, reason in ((rows[:1], "do not differ"), ([rows[0] | {"status": "missing"}], "no run finished"),
                         ([row | {"worn_volume": ""} for row in rows], "no run has a worn volume or")):
        try:
            parameters.draw(table, some)
            raise AssertionError("no curve can be drawn")
        except Unsuitable as complaint:
            assert reason in str(complaint), complaint
    table.with_suffix(".json").write_text(json.dumps({"columns": columns}))
    assert parameters.draw(table, rows).axes[0].get_xlabel() == "body.young_modulus [MPa]"

# A fretting map: the energy of a parallelogram 2 um wide and 4 N/mm high with a work of 3e-3 N; its runs tell what sticks.
row = {"status": "finished", "run": "a", "stroke": "2e-3", "friction_force": "2", "friction_work": "3e-3",
       "stick_area": "0", "contact_force": "10"}
fretting_map.sticking = lambda path, row: {"a": (1.0, 0.5), "b": (1.0, 0.0), "c": (0.0, 0.0)}[row["run"]]
for run, name in (("a", "partial slip"), ("b", "mixed"), ("c", "gross slip")):
    found = fretting_map.point_of(table, row | {"run": run})
    assert found[2] == name and all(map(math.isclose, (found[0], found[1], found[3]), (1, 10, 0.375))), found
try:
    fretting_map.draw(table, rows)
    raise AssertionError("nothing of it may stick")
except Unsuitable:
    pass
