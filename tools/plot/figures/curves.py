"""Curves on the contact surface: all of it in 2D; in space its cuts along the sliding direction x
and across it."""

import numpy

from . import shape, space
from .complaints import Unsuitable


class Curve:
    """Rows of the contact table along a curve, by column and in the order of its `axis`."""

    def __init__(self, result, axis, where, of, axis_name=None, breaks=()):
        """`of(table)`: the rows along the curve of a contact table; it does not go on before the
        rows `breaks`."""
        self.result, self.axis, self.where, self.of = result, axis, where, of
        self.axis_name, self.breaks = axis_name or axis, breaks

    def at(self, step):
        return self.of(self.result.contact(step))

    def label(self, initial=False):
        """Of the axis of current or initial positions."""
        name = self.axis_name.upper() if initial else self.axis_name
        return self.label_of(f"${name}$ [mm]")

    def label_of(self, quantity):
        return quantity + (f"   {self.where}" if self.where else "")


class Length(Curve):
    """Over the length along the initial surface, where no coordinate orders its nodes."""

    def label(self, initial=False):
        return self.label_of("length along the initial surface [mm]")


def of(result, body=None):
    """Of two bodies that meet on one of them, the first if none is given."""
    first = of_one_body(result, result.contact(0), body)
    name = name_of_body(result, first)
    if result.dim == 2:
        axis = longer_axis(first)
        return [Curve(result, axis, name,
                      lambda table: in_order(of_one_body(result, table, body), axis),
                      result.axes["xy".index(axis)])]
    edges = edges_of(space.contact_faces(result, body))
    return [Curve(result, axis, ", ".join(filter(None, [f"at ${across}$ = 0", name])),
                  lambda table, axis=axis, across=across: cut(table, edges, across, axis))
            for axis, across in ("xy", "yx")]


def that_slip(result, step):
    """As of(), of two bodies that meet on the one whose nodes carry friction that may stick."""
    if not result.has_pairs:
        return of(result)
    slip = numpy.abs(result.phase_slip(step)).sum(axis=(0, 2))
    return of(result, result.bodies[result.contact(step)["node"]][numpy.argmax(slip)])


def of_whole_surface(result, steps):
    """As of(), but where a surface in the plane turns back, along it. The curve of a closed one
    begins where it does not cut the contact at these steps in two."""
    lines = of(result)
    if result.dim != 2:
        return lines
    first = of_one_body(result, result.contact(0))
    order = numpy.argsort(first[lines[0].axis.upper() + "0"], kind="stable")
    if (numpy.abs(numpy.diff(order)) == 1).all():  # ascends or descends
        return lines
    breaks = shape.breaks_of(result, first)
    if len(shape.breaks_of(result, first[order])) <= len(breaks):
        return lines
    rows, ends = shape.outline(result, first, breaks)
    length = shape.along(first[rows])
    if len(rows) == len(first) + 1 and not len(breaks):  # closed
        touched = [of_one_body(result, result.contact(step))["pressure"] > 0 for step in steps]
        begin = middle_of_gap(numpy.any(touched, axis=0))
        length = numpy.concatenate([length[begin:-1] - length[-1], length[:begin + 1]])
        rows = numpy.concatenate([rows[begin:-1], rows[:begin + 1]])

    def along(table):
        own = of_one_body(result, table)[rows]
        return {"length": length} | {name: own[name] for name in own.dtype.names}

    return [Length(result, "length", lines[0].where, along, breaks=ends)]


def middle_of_gap(touched):
    """Of a closed curve: the row in the middle of the longest part that is not touched."""
    at = numpy.flatnonzero(touched)
    if not len(at):
        return 0
    gaps = numpy.diff(at, append=at[0] + len(touched))
    longest = numpy.argmax(gaps)
    return (at[longest] + gaps[longest] // 2) % len(touched)


def longer_axis(table):
    """Along which a surface in the plane is seen: a fit on a shaft lies along the axis."""
    return "y" if numpy.ptp(table["Y0"]) > numpy.ptp(table["X0"]) else "x"


def of_one_body(result, table, body=None):
    """Of two bodies that meet, one, the first if none is given: the pressures of the other are the
    same."""
    if not result.has_pairs:
        return table
    bodies = result.bodies[table["node"]]
    return table[bodies == (bodies[0] if body is None else body)]


def name_of_body(result, table):
    """Of two bodies that meet: whose surface the table has."""
    name = result.names_of_bodies.get(result.bodies[table["node"][0]]) if result.has_pairs else ""
    return f"on {name}" if name else ""


def in_order(table, axis):
    order = numpy.argsort(table[axis])
    return {name: table[name][order] for name in table.dtype.names}


def edges_of(faces):
    """Pairs of rows, each once."""
    pairs = numpy.concatenate([faces[:, [i, (i + 1) % 4]] for i in range(4)])
    return numpy.unique(numpy.sort(pairs, axis=1), axis=0)


def cut(table, edges, across, axis):
    """Where the current surface meets the plane `across` = 0: its nodes in the plane, and between
    the nodes of its edges that pass through it."""
    distance = table[across].copy()
    distance[numpy.abs(distance) <= 1e-9 * numpy.ptp(distance)] = 0
    of_faces = numpy.unique(edges)
    within = of_faces[distance[of_faces] == 0]
    first, second = edges[distance[edges].prod(axis=1) < 0].T
    first, second = numpy.append(within, first), numpy.append(within, second)
    if not len(first):
        raise Unsuitable(f"the contact surface does not meet {across} = 0")
    span = distance[first] - distance[second]
    weight = distance[first] / numpy.where(span == 0, 1, span)
    order = numpy.argsort((1 - weight) * table[axis][first] + weight * table[axis][second])
    return {name: ((1 - weight) * table[name][first] + weight * table[name][second])[order]
            for name in table.dtype.names}
