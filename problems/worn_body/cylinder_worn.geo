// The lower cap of a cylinder of 6 mm radius, cut off at a height of 1.6 mm, which a reciprocating flat wears at its
// lowest point. Lengths in mm. Elements of `fine` near the contact; gnomon's mesh.factor multiplies all sizes.
fine = 0.01; coarse = 0.3;
half = 0.22;  // of the surface that may touch
radius = 6; height = 1.6; width = 1.6;
lift = radius - Sqrt(radius^2 - half^2);
side = radius - Sqrt(radius^2 - width^2);
Point(1) = {0, radius, 0, coarse};  // axis
Point(2) = {-width, side, 0, coarse};
Point(3) = {-half, lift, 0, fine};
Point(4) = { half, lift, 0, fine};
Point(5) = { width, side, 0, coarse};
Point(6) = { width, height, 0, coarse};
Point(7) = {-width, height, 0, coarse};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {7, 2};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Recombine Surface {1};
Physical Curve("top") = {5};
Physical Curve("surface") = {2};
Physical Surface("cylinder") = {1};
