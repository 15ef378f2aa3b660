"""How a worn shape changes with a setting of a cycle; shared by cam.py, ball_joint.py and
groove_cycle.py."""

import math

from program import run, table


def worn_places(done, time=None):
    """Places of the contact nodes of a run, undeformed, by node."""
    return {row["node"]: (row["X"], row["Y"], row.get("Z", 0.0)) for row in done.contact(time)}


def deepest(done):
    return max(row["wear_depth"] for row in done.contact())


def largest_difference(done, reference):
    """Of the places of the same contact nodes at the end, in terms of the greatest depth of wear."""
    there = worn_places(reference)
    apart = (math.dist(place, there[node]) for node, place in worn_places(done).items())
    return max(apart) / deepest(reference)


def compare(scene, key, values, reference, *settings):
    """Runs a scene with each value of a key, and with that of the reference; prints the table.
    Returns the runs by their values."""
    runs = {value: run(scene, *settings, f"{key}={value}") for value in (*values, reference)}
    rows = []
    for value, done in runs.items():
        end = done.history()[-1]
        rows.append([value, f"{deepest(done):.5f}", f"{end['worn_volume']:.6g}",
                     f"{end['max_pressure']:.2f}",
                     "" if value == reference else
                     f"{100 * largest_difference(done, runs[reference]):.2g} %",
                     done.steps, done.newton, f"{done.cpu:.1f}"])
    table([f"`{key}`", "greatest depth [mm]", "worn", "largest pressure [MPa]",
           f"shape, of that with {reference}", "steps", "Newton iterations", "CPU [s]"], rows)
    return runs
