// A ring of 20 mm radius with a bore of 8 mm, which touches y = 0 at the origin from above. Lengths in mm.
// Elements of `fine` near the contact; gnomon's mesh.factor multiplies all sizes.
fine = 0.04; coarse = 3;
radius = 20; bore = 8;
half = 1.6;  // of the surface that may touch

Point(1) = {0, radius, 0, coarse};  // axis
Point(2) = {-half, radius - Sqrt(radius^2 - half^2), 0, fine};
Point(3) = { half, radius - Sqrt(radius^2 - half^2), 0, fine};
Point(4) = { radius, radius, 0, coarse};
Point(5) = {0, 2 * radius, 0, coarse};
Point(6) = {-radius, radius, 0, coarse};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 6};
Circle(5) = {6, 1, 2};
Point(7) = {0, radius - bore, 0, coarse};
Point(8) = {bore, radius, 0, coarse};
Point(9) = {0, radius + bore, 0, coarse};
Point(10) = {-bore, radius, 0, coarse};
Circle(6) = {7, 1, 8};
Circle(7) = {8, 1, 9};
Circle(8) = {9, 1, 10};
Circle(9) = {10, 1, 7};
Curve Loop(1) = {1, 2, 3, 4, 5};
Curve Loop(2) = {6, 7, 8, 9};
Plane Surface(1) = {1, 2};
Recombine Surface {1};

Physical Curve("track") = {1, 2, 3, 4, 5};
Physical Curve("bore") = {6, 7, 8, 9};
Physical Surface("ring") = {1};
