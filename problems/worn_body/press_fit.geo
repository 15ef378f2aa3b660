// A hub pressed on a shaft, half of the meridian in coordinates (r, z); lengths in mm. The meshes overlap by the
// interference. Both ends of the bore are rounded off, so that the pressure stays finite there. The two bodies share no
// point, so that they are meshed by themselves.
radius = 10; interference = 0.01; outer = 20;
length = 30;     // of the straight part of the bore
rounding = 50;   // radius of its ends
end = 2;         // their length
zone = 5;        // finely meshed inside of the bore, where the loaded end slips
lip = 1;         // of its ends that may touch
fine = 0.25; medium = 1; coarse = 3;

r = radius + interference; h = length / 2;

// The shaft.
Point(1) = {0, -h - 8, 0, coarse};
Point(2) = {r, -h - 8, 0, coarse};
Point(3) = {r, -h - end, 0, medium};
Point(4) = {r, -h - lip, 0, 2 * fine};
Point(5) = {r, -h + lip, 0, 2 * fine};
Point(6) = {r, 0, 0, medium};
Point(7) = {r, h - zone, 0, fine};
Point(8) = {r, h + lip, 0, fine};
Point(9) = {r, h + end, 0, medium};
Point(10) = {r, h + 8, 0, coarse};
Point(11) = {0, h + 8, 0, coarse};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 9};
Line(9) = {9, 10};
Line(10) = {10, 11};
Line(11) = {11, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
Plane Surface(1) = {1};

// The hub.
drop = rounding - Sqrt(rounding^2 - end^2); near = rounding - Sqrt(rounding^2 - lip^2);
Point(21) = {radius + drop, -h - end, 0, medium};
Point(22) = {radius + near, -h - lip, 0, 2 * fine};
Point(23) = {radius, -h, 0, 2 * fine};
Point(24) = {radius, -h + lip, 0, 2 * fine};
Point(25) = {radius, 0, 0, medium};
Point(26) = {radius, h - zone, 0, fine};
Point(27) = {radius, h, 0, fine};
Point(28) = {radius + near, h + lip, 0, fine};
Point(29) = {radius + drop, h + end, 0, medium};
Point(30) = {outer, h + end, 0, coarse};
Point(31) = {outer, -h - end, 0, coarse};
Point(32) = {radius + rounding, -h, 0, coarse};  // centres of the ends
Point(33) = {radius + rounding, h, 0, coarse};
Circle(21) = {21, 32, 22};
Circle(22) = {22, 32, 23};
Line(23) = {23, 24};
Line(24) = {24, 25};
Line(25) = {25, 26};
Line(26) = {26, 27};
Circle(27) = {27, 33, 28};
Circle(28) = {28, 33, 29};
Line(29) = {29, 30};
Line(30) = {30, 31};
Line(31) = {31, 21};
Curve Loop(21) = {21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
Plane Surface(21) = {21};
Recombine Surface {1, 21};

Physical Curve("pull") = {10};
Physical Curve("foot") = {1};
Physical Curve("seat") = {4, 5, 6, 7};
Physical Curve("bore") = {22, 23, 24, 25, 26, 27};
Physical Curve("back") = {31};
Physical Surface("shaft") = {1};
Physical Surface("hub") = {21};
