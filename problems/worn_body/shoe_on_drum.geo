// A shoe with a round sole above a quarter of a drum, lengths in mm. The shoe is not yet where it
// rests: it is a little above the drum and turned by `tilt` about the pin that presses it.
radius = 60;   // of the drum
sole = 60.5;   // of the sole
half = 18;     // half of the length of the shoe
height = 15;   // of the pin above the top of the drum
tilt = 1.5 * Pi / 180;
fine = 1.5;
coarse = 5;

up = radius + height;  // of the pin
gap = 0.2;
middle = radius + gap - sole;  // height of the centre of the sole
Point(1) = {0, middle, 0};
Point(2) = {-half, middle + Sqrt(sole * sole - half * half), 0, fine};
Point(3) = {half, middle + Sqrt(sole * sole - half * half), 0, fine};
Point(4) = {half, up, 0, fine};
Point(5) = {2, up, 0, fine};
Point(6) = {-2, up, 0, fine};
Point(8) = {0, up, 0, fine};
Point(7) = {-half, up, 0, fine};
Circle(1) = {2, 1, 3};
Line(2) = {3, 4};
Line(3) = {4, 5};
Line(4) = {5, 8};
Line(7) = {8, 6};
Line(5) = {6, 7};
Line(6) = {7, 2};
Curve Loop(1) = {1, 2, 3, 4, 7, 5, 6};
Plane Surface(1) = {1};
Rotate {{0, 0, 1}, {0, up, 0}, tilt} { Surface{1}; }

Point(10) = {0, 0, 0};
Point(11) = {-Sin(Pi / 4) * radius, Cos(Pi / 4) * radius, 0, coarse};
Point(12) = {0, radius, 0, fine};
Point(13) = {Sin(Pi / 4) * radius, Cos(Pi / 4) * radius, 0, coarse};
Point(14) = {Sin(Pi / 4) * (radius - 15), Cos(Pi / 4) * (radius - 15), 0, coarse};
Point(15) = {0, radius - 15, 0, coarse};
Point(16) = {-Sin(Pi / 4) * (radius - 15), Cos(Pi / 4) * (radius - 15), 0, coarse};
Circle(11) = {11, 10, 12};
Circle(12) = {12, 10, 13};
Line(13) = {13, 14};
Circle(14) = {14, 10, 15};
Circle(15) = {15, 10, 16};
Line(16) = {16, 11};
Curve Loop(11) = {11, 12, 13, 14, 15, 16};
Plane Surface(11) = {11};

Physical Surface("shoe") = {1};
Physical Surface("drum") = {11};
Physical Curve("sole") = {1};
Physical Curve("pin") = {4, 7};
Physical Point("pivot") = {8};
Physical Curve("rim") = {11, 12};
Physical Curve("hub") = {14, 15};
