// A long flat, 4.4 mm x 1.5 mm, under a cylinder that is held. Lengths in mm. Elements of `fine` on the surface that may
// touch; gnomon's mesh.factor multiplies all sizes.
fine = 0.04; coarse = 0.4;
half = 1.8; width = 2.2; depth = 1.5;
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
Physical Curve("ends") = {3, 5};
Physical Curve("surface") = {4};
Physical Surface("flat") = {1};
