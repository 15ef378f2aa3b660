// A block of 20 mm x 10 mm with fine elements where a cylinder presses on it. Lengths in mm.
fine = 0.02; coarse = 1.5;
zone = 0.4;  // half the length of the surface that may touch
width = 10; depth = 10;

Point(1) = {-width, -depth, 0, coarse};
Point(2) = { width, -depth, 0, coarse};
Point(3) = { width, 0, 0, coarse};
Point(4) = { zone, 0, 0, fine};
Point(5) = {-zone, 0, 0, fine};
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
Physical Surface("block") = {1};
