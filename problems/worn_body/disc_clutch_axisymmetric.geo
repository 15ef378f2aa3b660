// Half the meridian of a flat lining, a ring, in coordinates (r, z). Lengths in mm.
inner = 50; outer = 100; height = 10;
size = 2.5;

Point(1) = {inner, 0, 0, size};
Point(2) = {outer, 0, 0, size};
Point(3) = {outer, height, 0, size};
Point(4) = {inner, height, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Recombine Surface {1};

Physical Curve("surface") = {1};
Physical Curve("top") = {3};
Physical Surface("lining") = {1};
