// The ring of half_round_ring.geo on a flat ring from r = 50 mm to 150 mm, 50 mm high, which lies on a platen, in
// coordinates (r, z). Lengths in mm.
Include "half_round_ring.geo";
inside = 50; outside = 150; height = 50; platen = 20;
half = 20;  // of the part of the face that may touch

Point(11) = {inside, -height, 0, 3 * coarse};
Point(12) = {outside, -height, 0, 3 * coarse};
Point(13) = {outside, 0, 0, 3 * coarse};
Point(14) = {mean + half, 0, 0, fine};
Point(15) = {mean - half, 0, 0, fine};
Point(16) = {inside, 0, 0, 3 * coarse};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 15};
Line(15) = {15, 16};
Line(16) = {16, 11};
Curve Loop(11) = {11, 12, 13, 14, 15, 16};
Plane Surface(11) = {11};

Point(21) = {inside, -height - platen, 0, 3 * coarse};
Point(22) = {outside, -height - platen, 0, 3 * coarse};
Line(21) = {11, 21};
Line(22) = {21, 22};
Line(23) = {22, 12};
Curve Loop(21) = {21, 22, 23, -11};
Plane Surface(21) = {21};
Recombine Surface {11, 21};

Physical Curve("face") = {14};
Physical Curve("base") = {22};
Physical Surface("flat") = {11};
Physical Surface("platen") = {21};
