// Half the meridian of a round block, in coordinates (r, z), with fine elements where a ball presses on it. Lengths in
// mm.
fine = 0.02; coarse = 1.5;
zone = 0.4;  // radius of the surface that may touch
radius = 10; depth = 10;

Point(1) = {0, -depth, 0, coarse};
Point(2) = {radius, -depth, 0, coarse};
Point(3) = {radius, 0, 0, coarse};
Point(4) = {zone, 0, 0, fine};
Point(5) = {0, 0, 0, fine};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Recombine Surface {1};

Physical Curve("bottom") = {1};
Physical Curve("surface") = {4};
Physical Surface("block") = {1};
