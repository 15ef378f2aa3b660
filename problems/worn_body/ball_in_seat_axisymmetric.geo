// Half the meridian of the lower half of a ball, in coordinates (r, z), with fine elements where it touches a conical
// seat of a half angle of 45 degrees. Lengths in mm.
R = 10;
fine = 0.015; coarse = 1;
zone = 0.03;  // angle of the fine part to both sides, rad

Point(1) = {0, 0, 0, coarse};
Point(2) = {0, -R, 0, coarse};
Point(3) = {R * Sin(Pi / 4 - zone), -R * Cos(Pi / 4 - zone), 0, fine};
Point(4) = {R * Sin(Pi / 4 + zone), -R * Cos(Pi / 4 + zone), 0, fine};
Point(5) = {R, 0, 0, coarse};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Line(4) = {5, 1};
Line(5) = {1, 2};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Recombine Surface {1};

Physical Curve("surface") = {2};
Physical Curve("top") = {4};
Physical Surface("ball") = {1};
