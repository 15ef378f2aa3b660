// The lower cap of a cylinder of 6 mm radius, cut off at a height of 1.6 mm, on a flat, 3.2 mm x 1.6 mm. Lengths in mm.
// The two bodies share no point, so that they are meshed by themselves.
radius = 6; width = 1.6; height = 1.6;
half = 0.375;  // of the surfaces that may touch
fine = 0.025; coarse = 0.6;

lift = radius - Sqrt(radius^2 - half^2);
side = radius - Sqrt(radius^2 - width^2);
Point(1) = {0, radius, 0, coarse};  // axis
Point(2) = {-width, side, 0, coarse};
Point(3) = {-half, lift, 0, fine};
Point(4) = { half, lift, 0, fine};
Point(5) = { width, side, 0, coarse};
Point(6) = { width, height, 0, coarse};
Point(7) = {-width, height, 0, coarse};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {7, 2};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};

Point(11) = {-width, -height, 0, coarse};
Point(12) = { width, -height, 0, coarse};
Point(13) = { width, 0, 0, coarse};
Point(14) = { half, 0, 0, fine};
Point(15) = {-half, 0, 0, fine};
Point(16) = {-width, 0, 0, coarse};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 15};
Line(15) = {15, 16};
Line(16) = {16, 11};
Curve Loop(11) = {11, 12, 13, 14, 15, 16};
Plane Surface(11) = {11};
Recombine Surface {1, 11};

Physical Curve("round") = {2};
Physical Curve("top") = {5};
Physical Curve("sides") = {4, 6};
Physical Curve("face") = {14};
Physical Curve("bottom") = {11};
Physical Surface("cylinder") = {1};
Physical Surface("flat") = {11};
