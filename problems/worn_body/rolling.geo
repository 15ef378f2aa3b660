// The neighbourhood of a contact as a half-plane, 120 mm x 60 mm, that a roller passes: a rectangle of equal elements where
// it touches, and graded layers around it. Lengths in mm. `n` elements over half of the rectangle, `m` layers.
b = 0.45; w = 60; n = 30; m = 22; r = 1.3;
Point(1) = {-b, 0, 0}; Point(2) = {-b, -b, 0}; Point(3) = {b, -b, 0}; Point(4) = {b, 0, 0};
Point(5) = {-w, 0, 0}; Point(6) = {-w, -w, 0}; Point(7) = {w, -w, 0}; Point(8) = {w, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {1, 5}; Line(6) = {2, 6}; Line(7) = {3, 7}; Line(8) = {4, 8};
Line(9) = {5, 6}; Line(10) = {6, 7}; Line(11) = {7, 8};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 9, -6, -1}; Plane Surface(2) = {2};
Curve Loop(3) = {6, 10, -7, -2}; Plane Surface(3) = {3};
Curve Loop(4) = {7, 11, -8, -3}; Plane Surface(4) = {4};
Transfinite Curve {2, 4, 10} = 2 * n + 1;
Transfinite Curve {1, 3, 9, 11} = n + 1;
Transfinite Curve {5, 6, 7, 8} = m + 1 Using Progression r;
Transfinite Surface {1}; Transfinite Surface {2}; Transfinite Surface {3}; Transfinite Surface {4};
Recombine Surface {1, 2, 3, 4};
Physical Curve("bottom") = {10};
Physical Curve("surface") = {4, 5, 8};
Physical Surface("disc") = {1, 2, 3, 4};
