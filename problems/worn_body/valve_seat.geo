// The seat of a ball valve, half of its section in coordinates (r, z): a ring with a conical
// chamfer of 45 degrees, on which the ball sits. Lengths in mm.
// n elements along the chamfer, m across the ring, finer towards the bore.
If (!Exists(n)) n = 96; EndIf
If (!Exists(m)) m = 32; EndIf
bore = 5.5; outer = 12; chamfer = 3.5; height = 6;

Point(1) = {bore, 0, 0};
Point(2) = {outer, 0, 0};
Point(3) = {outer, height - chamfer, 0};
Point(4) = {outer, height, 0};
Point(5) = {bore + chamfer, height, 0};
Point(6) = {bore, height - chamfer, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {5, 4};
Line(5) = {6, 5};
Line(6) = {1, 6};
Line(7) = {6, 3};

Transfinite Curve {3, 5} = n + 1;
Transfinite Curve {1, 4, 7} = m + 1 Using Progression 1.08;
Transfinite Curve {2, 6} = m / 2 + 1;
Curve Loop(1) = {1, 2, -7, -6};
Curve Loop(2) = {7, 3, -4, -5};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Surface {1, 2};
Recombine Surface {1, 2};

Physical Curve("seat") = {5};
Physical Curve("bottom") = {1};
Physical Curve("outside") = {2, 3};
Physical Curve("bore") = {6};
Physical Curve("top") = {4};
Physical Surface("ring") = {1, 2};
