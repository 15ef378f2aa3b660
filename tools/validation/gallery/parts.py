"""Parts: whatever the shape, k F v t wears."""

import math

from program import SCENES, percent, run

from gallery.entry import Drawn, Entry, plotted

# Scene, what wears by the law, and what is said of it. The force of a seat is normal to its cone.
PARTS = {
    "block_on_ring": ("block under a sliding ring", 2e-9 * 10.8333 * 500 * 7200),
    "valve_seat": ("conical seat under a turning ball", 1e-8 * 500 * 10 * 1 * 36000),
    "disc_clutch_axisymmetric": ("lining of a clutch", None),
    "pin_on_disc_axisymmetric": ("spherical end of a pin", 1.33e-7 * 10.39 * 640),
    "half_round_ring": ("ring of half-round section", 1e-12 * 2 * math.pi * 1e5 * 100 * 2.995 * 150796320),
    "bushing": ("bushing from a STEP file, shaft turns", None),
}


def ledger(_full):
    rows, figures = [], []
    for scene, (name, law) in PARTS.items():
        done = run(SCENES / f"{scene}.toml")
        end = done.history()[-1]
        rows.append([name, done.unknowns, done.steps, f"{end['worn_volume']:.6g}",
                     percent(end["worn_volume"] / end["wear_integral"], 5),
                     percent(end["worn_volume"] / law, 4) if law else ""])
        if scene in ("valve_seat", "bushing"):
            figures += plotted(done.result, "mesh")
    return Drawn(figures, ["Valve seat: section before and after", "Bushing with an oil hole: before and after"],
                 ["part", "unknowns", "steps", "worn volume (plane: area) [mm^3, mm^2]", "against the wear integral",
                  "against k F v t"], rows,
                 "The ledger of a run is what the mesh has lost against the integral of the wear rate. k F v t needs "
                 "a closed form of the force and the speed where it acts; in the seat the contact is not quite "
                 "symmetric about the circle where the ball first touches.")


ENTRIES = [
    Entry("ledger", "Parts of any shape: the ledger", """
Archard's law determines the worn volume whatever the shape: k times the integral of force and sliding speed.
With `wear.normal = "conservative"`, the default, the mesh loses this volume, up to the tolerance in time.""", ledger),
]
