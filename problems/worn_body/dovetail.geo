// Half of a blade root in its slot, both flanks at 45 degrees; lengths in mm. The flank of the root is crowned, so that
// contact ends before the flank does. The two bodies share no point, so that they are meshed by themselves.
crown = 60;   // radius of the crown
half = 0.75;  // of the flanks that may touch
fine = 0.05; medium = 0.35; coarse = 1;

w = Sqrt(2) / 2;                            // the flank runs along (w, -w), its middle is at (5, -1)
sag = crown - Sqrt(crown^2 - half^2);

// The root: x = 0 is its plane of symmetry.
Point(1) = {0, 8, 0, coarse};
Point(2) = {3.2, 8, 0, coarse};
Point(3) = {3.2, 0.2, 0, medium};           // neck
Point(4) = {5 - (half + sag) * w, -1 + (half - sag) * w, 0, fine};
Point(5) = {5 + (half - sag) * w, -1 - (half + sag) * w, 0, fine};
Point(6) = {6.4, -2.9, 0, medium};
Point(7) = {6.4, -5, 0, coarse};
Point(8) = {0, -5, 0, coarse};
Point(9) = {5 - crown * w, -1 - crown * w, 0, coarse};  // centre of the crown
Line(1) = {1, 8};
Line(2) = {8, 7};
Line(3) = {7, 6};
Line(4) = {6, 5};
Circle(5) = {5, 9, 4};
Line(6) = {4, 3};
Line(7) = {3, 2};
Line(8) = {2, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8};
Plane Surface(1) = {1};

// The lug of the disc.
Point(11) = {3.6, 8, 0, coarse};
Point(12) = {3.6, 0.4, 0, medium};
Point(13) = {5 - half * w, -1 + half * w, 0, fine};
Point(14) = {5 + half * w, -1 - half * w, 0, fine};
Point(15) = {6.4, -2.4, 0, medium};
Point(16) = {7.4, -2.4, 0, medium};
Point(17) = {7.4, -7, 0, coarse};
Point(18) = {12, -7, 0, coarse};
Point(19) = {12, 8, 0, coarse};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 15};
Line(15) = {15, 16};
Line(16) = {16, 17};
Line(17) = {17, 18};
Line(18) = {18, 19};
Line(19) = {19, 11};
Curve Loop(11) = {11, 12, 13, 14, 15, 16, 17, 18, 19};
Plane Surface(11) = {11};
Recombine Surface {1, 11};

Physical Curve("symmetry") = {1};
Physical Curve("pull") = {8};
Physical Curve("root") = {5};
Physical Curve("slot") = {13};
Physical Curve("hub") = {17, 18};
Physical Surface("blade") = {1};
Physical Surface("disc") = {11};
