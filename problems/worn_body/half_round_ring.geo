// Half the meridian of a ring with a half-round section, radius 30 mm at the mean radius 100 mm, in coordinates (r, z).
// Lengths in mm.
R = 30; mean = 100;
fine = 1; coarse = 4;
zone = 0.6;  // angle of the surface that may wear, to both sides, rad

Point(1) = {mean, R, 0, coarse};
Point(2) = {mean - R, R, 0, coarse};
Point(3) = {mean - R * Sin(zone), R - R * Cos(zone), 0, fine};
Point(4) = {mean + R * Sin(zone), R - R * Cos(zone), 0, fine};
Point(5) = {mean + R, R, 0, coarse};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Line(4) = {5, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Recombine Surface {1};

Physical Curve("surface") = {2};
Physical Curve("top") = {4};
Physical Surface("ring") = {1};
