// A quarter of a ball of 5 mm radius that touches z = 0 at the origin, up to its middle: y > 0, z < 5. Lengths in mm.
// Tetrahedra, of `fine` where it may touch; gnomon subdivides them, and multiplies all sizes by mesh.factor.
SetFactory("OpenCASCADE");
radius = 5;
touching = 3;  // mm from the axis
fine = 0.5; coarse = 1.5;

// The part below the edge of the contact surface, and that from there to the middle.
edge = -Acos(touching / radius);
Sphere(1) = {0, 0, radius, radius, -Pi / 2, edge, Pi};
Sphere(2) = {0, 0, radius, radius, edge, 0, Pi};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }

level = radius + radius * Sin(edge);
e = 1e-3;
symmetry[] = Surface In BoundingBox {-radius - e, -e, -e, radius + e, e, radius + e};
top[] = Surface In BoundingBox {-radius - e, -e, radius - e, radius + e, radius + e, radius + e};
low[] = Surface In BoundingBox {-radius, -e, -e, radius, radius, level + e};
within[] = Surface In BoundingBox {-radius, -e, level - e, radius, radius, level + e};
high[] = Surface In BoundingBox {-radius - e, -e, level - e, radius + e, radius + e, radius + e};
low[] -= {symmetry[], within[]};
high[] -= {symmetry[], top[], within[]};
Physical Surface("symmetry") = {symmetry[]};
Physical Surface("top") = {top[]};
Physical Surface("contact") = {low[]};
Physical Surface("free") = {high[]};
Physical Volume("ball") = {1, 2};

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = Ball;
Field[1].Radius = 1.1 * touching;
Field[1].Thickness = radius;
Field[1].VIn = fine;
Field[1].VOut = coarse;
Background Field = 1;
