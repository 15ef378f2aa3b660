#!/usr/bin/python3
"""The worn pin by GetFEM (Debian: python3-getfem): nodal contact by the augmented Lagrangian, MUMPS.

    getfem_pin.py MESH.npz [--steps N] [-o RESULT.npz]

Without --steps: one contact solve of the initial shape."""

import getfem
import numpy as np

from pin import Pin, Surface, command_line, wear_loop

getfem.util_trace_level(0)
TOLERANCE = 1e-6  # of the residual, of the load; an error of the shape of 1e-9 mm

# Eq. (38) in plane strain, bilinear elements with 2 x 2 Gauss points: gnomon's `plain`.
STRESS = ("Def F := (Id(2)+Grad_u); Def J := Det(F); Def G := (Inv(F)');"
          "(mu*(F-G)+la*J*(J-1)*G):Grad_Test_u")


class Contact:
    """Contact of the pin with the plane y = 0. The last solution is the next one's first guess."""

    def __init__(self, pin, tolerance=TOLERANCE):
        self.tolerance = tolerance
        self.pin, self.mesh = pin, getfem.Mesh("empty", 2)
        order = pin.cells[:, [0, 1, 3, 2]]  # GetFEM's order of corners
        self.mesh.add_point(pin.points.T)
        self.mesh.add_convex(getfem.GeoTrans("GT_QK(2,1)"), pin.points[order].transpose(2, 1, 0))
        self.fem = getfem.MeshFem(self.mesh, 2)
        self.fem.set_fem(getfem.Fem("FEM_QK(2,1)"))
        self.unknowns = self.unknown_of_node(pin.points)
        self.points = pin.points
        held = self.unknowns[np.union1d(pin.left, pin.right), 0]
        free = np.setdiff1d(np.arange(self.fem.nbdof()), held)
        self.model = self.make_model(free)

    def unknown_of_node(self, points):
        """Number of the first and second component of each node among all unknowns."""
        places = self.fem.basic_dof_nodes().T[::2]
        first = np.empty(len(points), dtype=int)
        first[np.lexsort(np.round(points, 9).T)] = 2 * np.lexsort(np.round(places, 9).T)
        return np.column_stack([first, first + 1])

    def make_model(self, free):
        pin, model = self.pin, getfem.Model("real")
        self.free_fem = getfem.MeshFem("partial", self.fem, free)
        model.add_fem_variable("u", self.free_fem)
        lame, mu = pin.lame()
        model.add_initialized_data("la", [lame])
        model.add_initialized_data("mu", [mu])
        quadrature = getfem.MeshIm(self.mesh, getfem.Integ("IM_GAUSS_PARALLELEPIPED(2,2)"))
        model.add_nonlinear_term(quadrature, STRESS)
        self.mesh.set_region(1, self.mesh.faces_from_pid(
            self.mesh.pid_from_coords(pin.points[pin.top].T)))
        model.add_initialized_data("t", [0, -pin.force / pin.width])
        model.add_source_term_brick(quadrature, "u", "t", 1)
        count = len(pin.contact)
        order = np.argsort(self.unknowns.ravel())[free]
        self.nodes, self.components = order // 2, order % 2
        normal = getfem.Spmat("empty", count, len(free))
        for row, column in enumerate(np.searchsorted(free, self.unknowns[pin.contact, 1])):
            normal.assign(row, int(column), -1.0)
        model.add_variable("contact", count)
        model.add_initialized_data("r", [pin.modulus])
        model.add_initialized_data("gap", np.zeros(count))
        model.add_basic_contact_brick("u", "contact", "r", normal, "gap")
        return model

    def solve(self, points):
        """Forces on the contact nodes, upwards, N per mm of thickness, for a worn shape."""
        self.mesh.set_pts(points.T)
        self.model.set_variable("gap", points[self.pin.contact, 1])
        guess = self.displacement() + self.points - points  # keeps what touches in contact
        self.points = points
        self.model.set_variable("u", guess[self.nodes, self.components])
        self.iterations, _ = self.model.solve("max_res", self.tolerance, "max_iter", 50,
                                             "lsolver", "mumps")
        return -self.model.variable("contact")

    def displacement(self):
        """Of all nodes, n x 2, mm."""
        return self.free_fem.extend_vector(self.model.variable("u"))[self.unknowns]


def main():
    options = command_line(__doc__)
    pin = Pin.load(options.mesh)
    contact = Contact(pin)
    if options.steps:
        result = {"worn": wear_loop(pin, contact.solve, options.steps)[pin.contact]}
    else:
        pressure = contact.solve(pin.points) / Surface(pin).areas(pin.points)
        result = {"pressure": pressure, "displacement": contact.displacement()}
    if options.output:
        np.savez(options.output, **result)


if __name__ == "__main__":
    main()
