// A quarter of a plate and of a cylinder that rests on it, symmetric about x = 0; lengths in mm.
// The two bodies share no point, so that they are meshed by themselves.
radius = 5;
fine = 0.03;  // elements near the contact, of the cylinder
coarse = 1;

Point(1) = {0, 0, 0, fine};
Point(2) = {0, radius, 0, coarse};
Point(3) = {3, radius - 4, 0, coarse / 2};
Point(4) = {3, radius + 1, 0, coarse};
Point(5) = {0, radius + 1, 0, coarse};
Circle(1) = {1, 2, 3};
Line(2) = {3, 4};
Line(3) = {4, 5};
Line(4) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Point(11) = {0, 0, 0, 0.7 * fine};
Point(12) = {4, 0, 0, coarse};
Point(13) = {4, -4, 0, coarse};
Point(14) = {0, -4, 0, coarse};
Line(11) = {11, 14};
Line(12) = {14, 13};
Line(13) = {13, 12};
Line(14) = {12, 11};
Curve Loop(11) = {11, 12, 13, 14};
Plane Surface(11) = {11};

Physical Surface("cylinder") = {1};
Physical Surface("plate") = {11};
Physical Curve("round") = {1};
Physical Curve("top") = {3};
Physical Curve("cylinder_axis") = {4};
Physical Curve("face") = {14};
Physical Curve("base") = {12};
Physical Curve("plate_axis") = {11};
