// Half the meridian of a disc of 8 mm diameter and 4 mm height below z = 0, in coordinates (r, z). Lengths in mm.
radius = 4; height = 4;
fine = 0.015; coarse = 0.5;
zone = 0.6;  // radius of the surface that may wear

Point(1) = {0, 0, 0, fine};
Point(2) = {0, -height, 0, coarse};
Point(3) = {radius, -height, 0, coarse};
Point(4) = {radius, 0, 0, coarse};
Point(5) = {zone, 0, 0, fine};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Recombine Surface {1};

Physical Curve("base") = {2};
Physical Curve("face") = {5};
Physical Surface("disc") = {1};
