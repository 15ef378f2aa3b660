// A flat, 3.2 mm x 1.6 mm, whose middle a reciprocating cylinder of 6 mm radius wears. Lengths in mm.
// Elements of `fine` near the contact; gnomon's mesh.factor multiplies all sizes.
fine = 0.01; coarse = 0.3;
half = 0.26;  // of the surface that may touch
width = 1.6; depth = 1.6;
Point(1) = {-width, -depth, 0, coarse};
Point(2) = { width, -depth, 0, coarse};
Point(3) = { width, 0, 0, coarse};
Point(4) = { half, 0, 0, fine};
Point(5) = {-half, 0, 0, fine};
Point(6) = {-width, 0, 0, coarse};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Recombine Surface {1};
Physical Curve("bottom") = {1};
Physical Curve("surface") = {4};
Physical Surface("flat") = {1};
