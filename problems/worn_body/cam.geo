// The end of a flat follower (tappet) of 7 mm width, whose lower face a cam wears, in the plane. Lengths in mm.
// Elements of `fine` where the cam passes; gnomon's mesh.factor multiplies all sizes.
fine = 0.1; coarse = 0.8;
half = 2.8;  // of the face that may touch
width = 3.5; face = 14; height = 4;  // the axis of the cam is the origin

Point(1) = {-width, face, 0, coarse};
Point(2) = {-half, face, 0, fine};
Point(3) = { half, face, 0, fine};
Point(4) = { width, face, 0, coarse};
Point(5) = { width, face + height, 0, coarse};
Point(6) = {-width, face + height, 0, coarse};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Recombine Surface {1};

Physical Curve("face") = {2};
Physical Curve("top") = {5};
Physical Surface("follower") = {1};
