// An eccentric cam about the origin, and above it a rocker with a pivot at its right end, somewhat turned away from where
// it rests. Lengths in mm; gnomon's mesh.factor multiplies all sizes.
fine = 0.4; coarse = 2.5;
radius = 10; eccentric = 2; bore = 4;

Point(1) = {eccentric, 0, 0};
Point(2) = {eccentric + radius, 0, 0, fine};
Point(3) = {eccentric, radius, 0, fine};
Point(4) = {eccentric - radius, 0, 0, fine};
Point(5) = {eccentric, -radius, 0, fine};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Point(6) = {0, 0, 0};
Point(7) = {bore, 0, 0, coarse};
Point(8) = {0, bore, 0, coarse};
Point(9) = {-bore, 0, 0, coarse};
Point(10) = {0, -bore, 0, coarse};
Circle(5) = {7, 6, 8};
Circle(6) = {8, 6, 9};
Circle(7) = {9, 6, 10};
Circle(8) = {10, 6, 7};
Curve Loop(1) = {1:4};
Curve Loop(2) = {5:8};
Plane Surface(1) = {1, 2};

low = radius + 0.8; high = low + 6; right = 40;
Point(20) = {-6, low, 0, fine};
Point(21) = {6, low, 0, fine};
Point(22) = {right, low, 0, coarse};
Point(23) = {right, low + 3, 0, coarse};
Point(24) = {right, high, 0, coarse};
Point(25) = {0, high, 0, coarse};
Point(26) = {-6, high, 0, coarse};
Line(20) = {20, 21};
Line(21) = {21, 22};
Line(22) = {22, 23};
Line(23) = {23, 24};
Line(24) = {24, 25};
Line(25) = {25, 26};
Line(26) = {26, 20};
Curve Loop(3) = {20:26};
Plane Surface(2) = {3};

Physical Surface("cam") = {1};
Physical Surface("rocker") = {2};
Physical Curve("outline") = {1:4};
Physical Curve("bore") = {5:8};
Physical Curve("pad") = {20};
Physical Point("pivot") = {23};
Physical Curve("spring") = {25};
