"""Curves on the contact surface: all of it in 2D; in space its cuts along the sliding direction x
and across it."""

import numpy

from . import space
from .complaints import Unsuitable


class Curve:
    """Rows of the contact table along a curve, by column and in the order of its `axis`."""

    def __init__(self, result, axis, where, of, axis_name=None):
        """`of(table)`: the rows along the curve of a contact table."""
        self.result, self.axis, self.where, self.of = result, axis, where, of
        self.axis_name = axis_name or axis

    def at(self, step):
        return self.of(self.result.contact(step))


def of(result):
    if result.dim == 2:
        axis = longer_axis(of_one_body(result, result.contact(0)))
        return [Curve(result, axis, "", lambda table: in_order(of_one_body(result, table), axis),
                      result.axes["xy".index(axis)])]
    edges = edges_of(space.contact_faces(result))
    return [Curve(result, "x", "$y$ = 0", lambda table: cut(table, edges, "y", "x")),
            Curve(result, "y", "$x$ = 0", lambda table: cut(table, edges, "x", "y"))]


def longer_axis(table):
    """Along which a surface in the plane is seen: a fit on a shaft lies along the axis."""
    return "y" if numpy.ptp(table["Y0"]) > numpy.ptp(table["X0"]) else "x"


def of_one_body(result, table):
    """Of two bodies that meet, one: the pressures of the other are the same."""
    if not result.has_pairs:
        return table
    bodies = result.bodies[table["node"]]
    return table[bodies == bodies[0]]


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
    within = numpy.flatnonzero(distance == 0)
    first, second = edges[distance[edges].prod(axis=1) < 0].T
    first, second = numpy.append(within, first), numpy.append(within, second)
    if not len(first):
        raise Unsuitable(f"the contact surface does not meet {across} = 0")
    span = distance[first] - distance[second]
    weight = distance[first] / numpy.where(span == 0, 1, span)
    order = numpy.argsort((1 - weight) * table[axis][first] + weight * table[axis][second])
    return {name: ((1 - weight) * table[name][first] + weight * table[name][second])[order]
            for name in table.dtype.names}
