// Half the meridian of a pin of 8 mm diameter with a spherical end of 50 mm radius, in coordinates (r, z). Lengths in
// mm.
R = 50; radius = 4; height = 5;
fine = 0.015; coarse = 0.5;
zone = 0.6;  // radius of the surface that may wear

Point(1) = {0, 0, 0, fine};
Point(2) = {zone, R - Sqrt(R^2 - zone^2), 0, fine};
Point(3) = {radius, R - Sqrt(R^2 - radius^2), 0, coarse};
Point(4) = {radius, height, 0, coarse};
Point(5) = {0, height, 0, coarse};
Point(6) = {0, R, 0};
Circle(1) = {1, 6, 2};
Circle(2) = {2, 6, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Recombine Surface {1};

Physical Curve("surface") = {1};
Physical Curve("top") = {4};
Physical Surface("pin") = {1};
