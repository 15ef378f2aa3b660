// A pin with a round end on a piece of the disc's track, in the plane of sliding; lengths in mm. The
// two bodies share no point, so that they are meshed by themselves.
radius = 20;
fine = 0.05;  // elements near the contact, of the pin
coarse = 0.8;
drop = radius - Sqrt(radius^2 - 2^2);  // of the round end, at the sides

Point(1) = {0, 0, 0, fine};
Point(2) = {0, radius, 0, coarse};
Point(3) = {2, drop, 0, 0.1};
Point(4) = {2, 5, 0, coarse};
Point(5) = {-2, 5, 0, coarse};
Point(6) = {-2, drop, 0, 0.1};
Point(7) = {2, 2, 0, coarse};  // the holder begins here
Point(8) = {-2, 2, 0, coarse};
Circle(1) = {6, 2, 1};
Circle(2) = {1, 2, 3};
Line(3) = {3, 7};
Line(4) = {4, 5};
Line(5) = {8, 6};
Line(6) = {7, 4};
Line(7) = {5, 8};
Curve Loop(1) = {1, 2, 3, 6, 4, 7, 5};
Plane Surface(1) = {1};

Point(11) = {0, 0, 0, 0.7 * fine};
Point(12) = {4, 0, 0, coarse};
Point(13) = {4, -4, 0, coarse};
Point(14) = {-4, -4, 0, coarse};
Point(15) = {-4, 0, 0, coarse};
Line(11) = {11, 15};
Line(12) = {15, 14};
Line(13) = {14, 13};
Line(14) = {13, 12};
Line(15) = {12, 11};
Curve Loop(11) = {11, 12, 13, 14, 15};
Plane Surface(11) = {11};

Physical Surface("pin") = {1};
Physical Surface("disc") = {11};
Physical Curve("tip") = {1, 2};
Physical Curve("top") = {4};
Physical Curve("holder") = {6, 7};
Physical Curve("track") = {11, 15};
Physical Curve("base") = {13};
Physical Curve("ends") = {12, 14};
