// A hub pressed on a hollow shaft, one half beside the plane y = 0 in which the shaft bends; lengths in mm. Sections in
// the plane y = 0, x > 0, are turned by 180 degrees about the axis z. The meshes overlap by the interference. Both ends
// of the bore are rounded off, so that the pressure stays finite there.
radius = 10; interference = 0.01; outer = 20; inner = 3;
half = 10;       // of the straight part of the bore
rounding = 50;   // radius of its ends
end = 2;         // their length
beside = 6;      // length of the shaft on both sides of the hub
f = Mesh.MeshSizeFactor;  // gnomon's mesh.factor
around = Round(8 / f);  // elements over 180 degrees
deep = Round(2 / f);    // elements over the radius of the shaft, and of the hub
fit = Round(14 / f); free = Round(2 / f);  // elements along the seat and along the ends of the shaft
finer = 0.85;        // ratio of their lengths towards the end that is turned

r = radius + interference;
Point(1) = {inner, 0, -half - end - beside};
Point(2) = {r, 0, -half - end - beside};
Point(3) = {r, 0, -half - end};
Point(4) = {r, 0, half + end};
Point(5) = {r, 0, half + end + beside};
Point(6) = {inner, 0, half + end + beside};
Point(7) = {inner, 0, half + end};
Point(8) = {inner, 0, -half - end};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 1};
Line(9) = {8, 3}; Line(10) = {7, 4};
Curve Loop(1) = {1, 2, -9, 8}; Plane Surface(1) = {1};
Curve Loop(2) = {9, 3, -10, 7}; Plane Surface(2) = {2};
Curve Loop(3) = {10, 4, 5, 6}; Plane Surface(3) = {3};
Transfinite Curve {1, 9, 10, 5} = deep + 1;
Transfinite Curve {2, 8, 4, 6} = free + 1;
Transfinite Curve {3} = fit + 1 Using Progression finer;
Transfinite Curve {7} = fit + 1 Using Progression 1 / finer;

drop = rounding - Sqrt(rounding^2 - end^2);
Point(21) = {radius + drop, 0, -half - end};
Point(22) = {radius, 0, -half};
Point(23) = {radius, 0, half};
Point(24) = {radius + drop, 0, half + end};
Point(25) = {outer, 0, half + end};
Point(26) = {outer, 0, half};
Point(27) = {outer, 0, -half};
Point(28) = {outer, 0, -half - end};
Point(29) = {radius + rounding, 0, -half};
Point(30) = {radius + rounding, 0, half};
Circle(21) = {21, 29, 22}; Line(22) = {22, 23}; Circle(23) = {23, 30, 24};
Line(24) = {24, 25}; Line(25) = {25, 26}; Line(26) = {26, 27}; Line(27) = {27, 28}; Line(28) = {28, 21};
Line(29) = {22, 27}; Line(30) = {23, 26};
Curve Loop(21) = {21, 29, 27, 28}; Plane Surface(21) = {21};
Curve Loop(22) = {22, 30, 26, -29}; Plane Surface(22) = {22};
Curve Loop(23) = {23, 24, 25, -30}; Plane Surface(23) = {23};
Transfinite Curve {24, 28, 29, 30} = deep + 1;
Transfinite Curve {21, 27, 23, 25} = 3;
Transfinite Curve {22} = fit - 1 Using Progression finer;
Transfinite Curve {26} = fit - 1 Using Progression 1 / finer;
Transfinite Surface {1, 2, 3, 21, 22, 23};
Recombine Surface {1, 2, 3, 21, 22, 23};
a[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi} { Surface{1}; Layers{around}; Recombine; };
b[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi} { Surface{2}; Layers{around}; Recombine; };
c[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi} { Surface{3}; Layers{around}; Recombine; };
d[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi} { Surface{21}; Layers{around}; Recombine; };
e[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi} { Surface{22}; Layers{around}; Recombine; };
f[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi} { Surface{23}; Layers{around}; Recombine; };
Physical Volume("shaft") = {a[1], b[1], c[1]};
Physical Volume("hub") = {d[1], e[1], f[1]};
Physical Surface("symmetry") = {1, 2, 3, 21, 22, 23, a[0], b[0], c[0], d[0], e[0], f[0]};
Physical Surface("foot") = {a[2]};
Physical Surface("turned") = {c[4]};
Physical Surface("seat") = {b[3]};
Physical Surface("bore") = {d[2], e[2], f[2]};
Physical Surface("back") = {d[5]};
