"""Bodies in space: faces of hexahedra, symmetry, and the view onto the contact surface."""

import numpy
from matplotlib.collections import PolyCollection

from . import plane, style
from .complaints import Unsuitable

# Nodes of a hexahedron's faces, counterclockwise as seen from outside.
FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def boundary_faces(cells):
    """Faces that belong to one cell, F x 4, and these cells."""
    faces = numpy.concatenate([cells[:, face] for face in FACES])
    _, first, count = numpy.unique(numpy.sort(faces, axis=1), axis=0, return_index=True,
                                   return_counts=True)
    outer = first[count == 1]
    return faces[outer], outer % len(cells)


def contact_faces(result, body=None):
    """Boundary faces that lie in the contact surface, by rows of the contact table; of two bodies
    that meet those of one of them, the first if none is given."""
    nodes = result.contact(0)["node"]
    row = numpy.full(len(result.points), -1)
    row[nodes] = numpy.arange(len(nodes))
    every, _ = boundary_faces(result.cells)
    faces = row[every][(row[every] >= 0).all(axis=1)]
    if result.has_pairs:
        of_row = result.bodies[nodes]
        faces = faces[of_row[faces[:, 0]] == (of_row[0] if body is None else body)]
    if not len(faces):
        raise Unsuitable("the contact surface holds no face of the mesh")
    return faces


def add_faces(axes, corners, colours, scale, many):
    """Faces on the screen, the farthest first, with the mesh lines that can be seen. `scale`: points
    of paper per mm; `many`: above this number they are a bitmap in an SVG."""
    sides = numpy.linalg.norm(corners - numpy.roll(corners, -1, axis=1), axis=2)
    lines = plane.line_widths(scale * numpy.sort(sides, axis=1)[:, 1])
    # Faces without lines get hairlines of their own colour, so that no gaps show between them.
    edges = numpy.where((lines > 0)[:, None], [[0, 0, 0, 1]], colours)
    axes.add_collection(PolyCollection(corners, facecolor=colours, edgecolor=edges,
                                       linewidth=numpy.where(lines > 0, lines, 0.1),
                                       rasterized=len(corners) > many))
    axes.autoscale_view()


def is_half(result):
    """Whether the body begins at y = 0 and does not leave this plane: half of a symmetric one."""
    y = result.points[:, 1]
    tolerance = 1e-9 * numpy.ptp(y)
    if abs(y.min()) > tolerance:
        return False
    last = len(result.times) - 1
    return all(numpy.abs(result.field(last, name)[y <= tolerance, 1]).max() <= tolerance
               for name in ("shape", "displacement"))


def normals(corners):
    """Normals of faces, F x 4 x 3, with twice their areas as lengths."""
    return numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])


class Eye:
    """A parallel projection, seen from `eye`, a direction: z up on the screen."""

    def __init__(self, eye):
        self.eye = unit(numpy.array(eye))
        right = unit(numpy.cross([0, 0, 1], self.eye))
        self.screen = numpy.stack([right, numpy.cross(self.eye, right)], axis=1)


class View(Eye):
    """x to the right, z up; the plane y = 0 in front, the contact surface seen from the side to
    which it faces, above or below."""

    def __init__(self, result):
        self.faces, self.owners = boundary_faces(result.cells)
        nodes = result.contact(0)["node"]
        facing = normals(result.points[nodes[contact_faces(result)]]).sum(axis=0)[2]
        super().__init__([-0.45, -1.0, 0.9 if facing > 0 else -0.9])

    def polygons(self, points):
        """Visible faces, the farthest first: corners on the screen, cells, and brightness
        from 0 to 1."""
        corners = points[self.faces]
        towards = unit(normals(corners)) @ self.eye
        order = numpy.argsort(corners.mean(axis=1) @ self.eye)
        order = order[towards[order] > 0]
        return corners[order] @ self.screen, self.owners[order], towards[order]


def finish(axes):
    """A projection has no scales: there are arms of known length instead, in a strip below."""
    axes.set(xticks=[], yticks=[], aspect="equal")
    axes.spines[:].set_visible(False)
    low, high = axes.get_ylim()
    axes.set_ylim(low - arm_length(axes), high)


def arm_length(axes):
    left, right = axes.get_xlim()
    return style.round_number(0.16 * (right - left))


def add_arms(axes, screen):
    """The coordinate axes, at the lower left."""
    arm = arm_length(axes)
    tips = arm * screen
    corner = numpy.array([axes.get_xlim()[0], axes.get_ylim()[0]])
    origin = corner - 1.5 * numpy.minimum(tips.min(axis=0), 0)
    for name, tip in zip("xyz", tips):
        axes.annotate("", origin + tip, origin,
                      arrowprops={"arrowstyle": "-|>,head_width=0.1,head_length=0.2",
                                  "linewidth": 0.6, "color": "black", "shrinkA": 0, "shrinkB": 0})
        axes.text(*(origin + 1.35 * tip), f"${name}$", ha="center", va="center", fontsize=7)
    right = max(origin[0], *(origin + 1.7 * tips)[:, 0])
    axes.text(right, corner[1], f"arms: {style.number(arm)} mm", fontsize=7)


def ratio(axes):
    """Height by width of what the axes show."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    return (high - low) / (right - left)


def unit(vectors):
    return vectors / numpy.maximum(numpy.linalg.norm(vectors, axis=-1, keepdims=True), 1e-300)
