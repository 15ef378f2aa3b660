// A cam, a disc that turns about a point beside its centre, and a flat follower; lengths in mm. The
// cam's outline is divided, so that its elements are equally fine all around.
radius = 10;
eccentricity = 3;
bore = 3;
fine = 1.5;

Point(1) = {0, 0, 0, fine};              // axis
Point(2) = {0, eccentricity, 0, fine};   // centre of the disc
Point(3) = {radius, eccentricity, 0, fine};
Point(4) = {0, eccentricity + radius, 0, fine};
Point(5) = {-radius, eccentricity, 0, fine};
Point(6) = {0, eccentricity - radius, 0, fine};
Circle(1) = {3, 2, 4};
Circle(2) = {4, 2, 5};
Circle(3) = {5, 2, 6};
Circle(4) = {6, 2, 3};
Point(7) = {bore, 0, 0, 2 * fine};
Point(8) = {0, bore, 0, 2 * fine};
Point(9) = {-bore, 0, 0, 2 * fine};
Point(10) = {0, -bore, 0, 2 * fine};
Circle(5) = {7, 1, 8};
Circle(6) = {8, 1, 9};
Circle(7) = {9, 1, 10};
Circle(8) = {10, 1, 7};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(1) = {1, 2};

// Above the cam where this is highest.
low = eccentricity + radius;
Point(11) = {-6, low, 0, fine};
Point(12) = {6, low, 0, fine};
Point(13) = {6, low + 4, 0, 3 * fine};
Point(14) = {-6, low + 4, 0, 3 * fine};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(3) = {11, 12, 13, 14};
Plane Surface(2) = {3};

Physical Surface("cam") = {1};
Physical Surface("follower") = {2};
Physical Curve("outline") = {1, 2, 3, 4};
Physical Curve("bore") = {5, 6, 7, 8};
Physical Curve("face") = {11};
Physical Curve("stem") = {13};
Physical Curve("guide") = {12, 14};
