"""Wear with closed forms: springs, flat punch, rigid limits, a lining that turns."""

import math

import numpy
from figures import style
from program import ROOT, SCENES, bisect, percent, run

from gallery.entry import Drawn, Entry, column, panels

PROBLEMS = ROOT / "problems"
TIMES = (0, 100, 300, 1000)


class Springs:
    """A parabola on springs of modulus K, pressed by F and worn by k v p: 2 a^3/(3 R) = F/K + k F v t."""
    radius, force, modulus, wear = 5.0, 20.0, 70.33, 1e-7 * 1000

    def half_width(self, t):
        return (1.5 * self.radius * (self.force / self.modulus + self.wear * self.force * t)) ** (1 / 3)

    def first_contact(self, x):
        return numpy.maximum(0, (2 * abs(x) ** 3 / (3 * self.radius) - self.force / self.modulus)
                             / (self.wear * self.force))

    def pressure(self, x, t):
        """dp/dt = K (approach' - k v p) from first contact on, with the approach a^2/(2 R)."""
        begin, rate = self.first_contact(x), self.modulus * self.wear
        start = self.modulus * max(0.0, self.half_width(0) ** 2 - x**2) / (2 * self.radius)
        if begin >= t:
            return start if t == 0 else 0.0
        tau = numpy.linspace(begin, t, 4001)
        speed = self.wear * self.force / (2 * self.half_width(tau))
        loaded = self.modulus * numpy.trapz(speed * numpy.exp(-rate * (t - tau)), tau)
        return start * math.exp(-rate * (t - begin)) + loaded


def springs(_full):
    exact = Springs()
    done = run(PROBLEMS / "winkler/pin.toml", f"output.times={[float(t) for t in TIMES[1:]]}", "output.every=0")
    figure, (left, right) = panels(2, 0.38)
    history = done.history()
    t = numpy.linspace(0, 1000, 401)
    left.plot(t, exact.half_width(t), color=style.GREY, label="closed form")
    left.plot(column(history, "t"), column(history, "contact_half_width"), "o",
              color=style.COLOURS[0], label="steps of gnomon")
    left.set(xlabel="time [s]", ylabel="half width of contact [mm]")
    style.legend(left)
    rows = []
    for time, colour in zip(TIMES, style.sequence(len(TIMES))):
        nodes = done.contact(time)
        x = numpy.array(column(nodes, "X0"))
        p = numpy.array(column(nodes, "pressure"))
        expected = numpy.array([exact.pressure(position, time) for position in x])
        half = x >= 0
        right.plot(x[half], expected[half], color=colour, label=f"{time} s")
        some = slice(None, None, max(1, len(x) // 100))
        right.plot(x[half][some], p[half][some], "o", markersize=2, color=colour)
        at = done.at(time)
        width = at["contact_half_width"]
        rows.append([time, f"{width:.5f}", percent(width / exact.half_width(time), 3), f"{p.max():.4f}",
                     f"{abs(p - expected).max() / expected.max():.1e}"])
    right.set(xlabel="x [mm]", ylabel="pressure [MPa]", xlim=(0, 3))
    style.legend(right, columns=4)
    return Drawn([figure], ["Half width of contact over time, and pressure profiles"],
                 ["t [s]", "half width [mm]", "of the closed form", "largest pressure [MPa]",
                  "largest difference of a pressure / largest pressure"], rows,
                 f"{done.steps} steps of `esdirk-4` at rtol 1e-4. The half width is exact to a fraction of the "
                 f"distance of "
                 "the springs; pressures differ most where a spring has just been reached.")


def punch(_full):
    times = [1.0, *(float(t) for t in range(2, 21, 2))]
    done = run(PROBLEMS / "flat_punch/half_plane.toml", f"output.times={times}", "output.every=0",
               "integrator.rtol=1e-6")
    decay = 1.7267 * 2000 / (1 - 0.3**2) * 1e-7 * 1000  # 1/s
    figure, (left, right) = panels(2, 0.38)
    middle = []
    for time, colour in zip([0.0, *times], style.sequence(1 + len(times))):
        nodes = done.contact(time)
        centre = min(nodes, key=lambda node: abs(node["X0"]))
        middle.append(1 - centre["pressure"])  # the mean F/(2 a) is 1 MPa
        if time in (0.0, 1.0, 2.0, 4.0, 8.0):
            left.plot(column(nodes, "X0"), column(nodes, "pressure"), color=colour,
                      label=f"{time:g} s")
    left.set(xlabel="x / a", ylabel="pressure / mean", ylim=(0.4, 2.5))
    style.legend(left, columns=5)
    t = numpy.array([0.0, *times])
    right.semilogy(t, middle, "o", color=style.COLOURS[0], label="1 - pressure in the middle / mean")
    right.semilogy(t, middle[-1] * numpy.exp(-decay * (t - t[-1])), color=style.GREY,
                   label="slope of the closed form")
    right.set(xlabel="time [s]")
    style.legend(right, columns=1)
    rows = []
    for i in range(5, len(t)):
        rate = math.log(middle[i - 1] / middle[i]) / (t[i] - t[i - 1])
        rows.append([f"{t[i - 1]:g} to {t[i]:g}", f"{rate:.4f}", percent(rate / decay)])
    return Drawn([figure], ["Pressure under the punch, and its decay to the mean in the middle"],
                 ["time [s]", "rate of decay in the middle [1/s]", f"of the closed form, {decay:.4f}"], rows,
                 "At first faster modes, of at least 1.9 times this rate, are there too. What remains in the "
                 "end is the "
                 "error of a block of finite size and of elements of a/20.")


def rigid_limit(_full):
    figure, (axes, right) = panels(2, 0.38)
    rows = []
    t = numpy.linspace(0, 1000, 401)
    axes.plot(t, (1.5 * 5 * 0.002 * t) ** (1 / 3), color=style.GREY, label="rigid limit")
    for young, colour in zip((640, 6400, 64000), style.COLOURS):
        done = run(PROBLEMS / "pin_on_flat/small_deformation.toml", f"body.young_modulus={young}",
                   "integrator.name=esdirk-3", "wear.normal=conservative", "output.times=[100.0, 300.0]",
                   "output.every=0")
        history = done.history()
        axes.plot(column(history, "t"), column(history, "contact_half_width"), "o", color=colour,
                  label=f"E = {young} MPa")
        if young == 640:
            for time, shade in zip((0, 100, 300, 1000), style.sequence(4)):
                nodes = done.contact(time)
                right.plot(column(nodes, "X"), column(nodes, "Y"), color=shade, label=f"{time} s")
        end = history[-1]
        limit = (1.5 * 5 * 2) ** (1 / 3)
        rows.append([young, done.steps, f"{end['contact_half_width']:.5f}", percent(end["contact_half_width"] / limit),
                     percent(end["worn_volume"] / 2, 5), percent(end["contact_force"] / 20, 4)])
    axes.set(xlabel="time [s]", ylabel="half width of contact [mm]")
    right.set(xlabel="x [mm]", ylabel="worn surface [mm]")
    style.legend(axes, columns=2)
    style.legend(right, columns=4)
    return Drawn([figure], ["Half width of contact for three stiffnesses, and the worn end of the pin for E = 640 MPa"],
                 ["E [MPa]", "steps", "half width at 1000 s [mm]", "of the rigid limit", "worn area against k F v t",
                  "force against F"], rows,
                 "The difference falls with 1/E down to that of the mesh. The worn area does not depend on the shape.")


def clutch(_full):
    done = run(SCENES / "disc_clutch_axisymmetric.toml")
    figure, (left, right) = panels(2, 0.38)
    r = numpy.linspace(50, 100, 101)
    left.plot(r, 23561.945 / (2 * math.pi * r * 50), color=style.GREY, label="F / (2 pi r (b - a))")
    rows = []
    for time, colour in zip((0, 1000, 3000, 20000), style.sequence(4)):
        nodes = done.contact(time)
        left.plot(column(nodes, "X0"), column(nodes, "pressure"), "o", markersize=2.5,
                  color=colour, label=f"{time} s")
        products = [node["pressure"] * node["x"] for node in nodes]
        rows.append([time, f"{nodes[0]['pressure']:.5f}", f"{nodes[-1]['pressure']:.5f}",
                     f"{min(products):.3f} to {max(products):.3f}"])
    left.set(xlabel="r [mm]", ylabel="pressure [MPa]")
    style.legend(left, columns=3)
    history = done.history()
    expected = 1e-8 * 10 * 23561.945 * 75
    right.plot(column(history, "t"), column(history, "wear_flux"), "o-", color=style.COLOURS[0],
               label="gnomon")
    right.axhline(expected, color=style.GREY, label="k omega F (a + b)/2")
    right.set(xlabel="time [s]", ylabel="wear per time [mm³/s]")
    style.legend(right, columns=2)
    return Drawn([figure], ["Pressure over the radius, and the wear per time"],
                 ["t [s]", "pressure inside [MPa]", "outside [MPa]", "p r [N/mm]"], rows,
                 "At the start the pressure is uniform, 1 MPa. In the end p r is F/(2 pi (b - a)) = 75 N/mm; "
                 "the wear per "
                 f"time differs from k omega F (a + b)/2 by {percent(history[-1]['wear_flux'] / expected, 3)}. "
                 "[Details](validation.md#lining-of-a-disc-clutch).")


def cap_depth(volume, radius):
    """Depth of a spherical cap."""
    return bisect(lambda h: math.pi * h * h * (3 * radius - h) / 3 - volume, 0, radius)


def rigid_ball(full):
    times = [0.0, 50.0, 100.0, 200.0, 500.0, 1000.0]
    done = run(PROBLEMS / "ball_on_flat/small_deformation.toml", f"output.times={times[1:]}", "output.every=0",
               *([] if full else ["mesh.elements=[8, 3, 4]"]))
    figure, (left, right) = panels(2, 0.38)
    t = numpy.linspace(0, 1000, 201)
    left.plot(t, [cap_depth(0.005 * time, 5) for time in t], color=style.GREY, label="cap of the volume K f F v t")
    history = done.history()
    left.plot(column(history, "t"), column(history, "approach"), "o", color=style.COLOURS[0],
              label="approach in gnomon")
    left.set(xlabel="time [s]", ylabel="depth [mm]")
    style.legend(left, columns=1)
    rows = []
    for time, colour in zip(times[1:], style.sequence(len(times) - 1)):
        depth = cap_depth(0.005 * time, 5)
        a = math.sqrt(depth * (10 - depth))
        mean = 100 / (math.pi * a * a)
        at, nodes = done.at(time), done.contact(time)
        middle = [node["pressure"] for node in nodes if math.hypot(node["x"], node["y"]) < 0.5 * a]
        rows.append([f"{time:.0f}", f"{at['approach']:.4f}", percent(at["approach"] / depth),
                     percent(at["worn_volume"] / (0.005 * time)), f"{mean:.3f}",
                     f"{min(middle):.3f} to {max(middle):.3f}"])
        right.plot([math.hypot(node["x"], node["y"]) for node in nodes], column(nodes, "pressure"), "o",
                   markersize=1.5, color=colour, label=f"{time:.0f} s")
        right.plot([0, a, a], [mean, mean, 0], color=colour)
    right.set(xlabel="distance from the axis [mm]", ylabel="pressure [MPa]", xlim=(0, 3), ylim=(0, 45))
    style.legend(right, columns=3)
    return Drawn([figure], ["Depth of the worn ball over time, and pressures of all contact nodes"],
                 ["t [s]", "approach [mm]", "of the cap's depth", "worn volume against K f F v t", "F/(pi a^2) [MPa]",
                  "pressures within a/2 [MPa]"], rows,
                 "The volume is a little too small because this scene of the paper uses its rule of normals "
                 "(`wear.normal = \"averaged\"`).")


ENTRIES = [
    Entry("springs", "Parabola on springs: exact at every time", """
The pin of the paper on springs instead of an elastic body (`problems/winkler`). Half width and pressures have a
closed form from the first contact on: 2 a^3/(3 R) = F/K + k F v t, and along a spring dp/dt = K (delta' - k v
p) with the approach delta = a^2/(2 R). Lines are the closed form, dots gnomon.""", springs),
    Entry("punch", "Flat punch on a half-plane: modes that decay", """
A rigid flat punch slides on a half-plane. Its pressure, singular at the edges, becomes uniform; the slowest
symmetric mode decays at the rate 1.7267 E* k v/a. The contact never changes.""", punch),
    Entry("rigid-limit", "Worn pin and the rigid limit", """
The pin of the paper's sec. 4.1. A rigid pin would wear to the half width a with 2 a^3/(3 R) = k F v t. An
elastic one is wider by a part in proportion to 1/E.""", rigid_limit),
    Entry("clutch", "Lining of a disc clutch", """
A flat ring is worn by a disc that turns, so that the sliding speed is omega r. In the end all of the surface
wears at the same rate, with the pressure F/(2 pi r (b - a)).""", clutch),
    Entry("rigid-ball", "Worn ball and the rigid limit, in space", """
The ball of the paper's sec. 4.2 with friction, E = 100 GPa. Lines: a spherical cap of the volume K f F v t, and
the pressure uniform on its circle. Dots are gnomon's nodes.""", rigid_ball),
]
