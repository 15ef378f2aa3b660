// Half the meridian of a ring with a half-round section, in coordinates (r, z), with fine elements at its lowest point.
// Lengths in mm.
R = 20; mean = 100;
fine = 0.015; coarse = 2;
zone = 0.015;  // angle of the fine part to both sides, rad

Point(1) = {mean, 0, 0, coarse};
Point(2) = {mean - R, 0, 0, coarse};
Point(3) = {mean - R * Sin(zone), -R * Cos(zone), 0, fine};
Point(4) = {mean + R * Sin(zone), -R * Cos(zone), 0, fine};
Point(5) = {mean + R, 0, 0, coarse};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Line(4) = {5, 1};
Line(5) = {1, 2};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Recombine Surface {1};

Physical Curve("surface") = {2};
Physical Curve("top") = {4, 5};
Physical Surface("ring") = {1};
