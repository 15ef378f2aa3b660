// A quarter of a hemispherical cup with its pole down, lengths in mm: three blocks of hexahedra that meet in the
// middle of the quarter, n x n elements on the sphere each, `layers` through the wall.
inner = 14.1; outer = 22;
n = Ceil(8 / Mesh.MeshSizeFactor - 1e-9);
layers = Ceil(4 / Mesh.MeshSizeFactor - 1e-9);
thicker = 1.3;  // each layer than the one inside of it

Point(100) = {0, 0, 0};
// On both spheres: two points of the rim, the pole, the middles between them, the middle of the quarter.
For s In {0:1}
  r = s == 0 ? inner : outer;
  h = r / Sqrt(2); m = r / Sqrt(3);
  Point(1 + 10 * s) = {r, 0, 0};
  Point(2 + 10 * s) = {0, r, 0};
  Point(3 + 10 * s) = {0, 0, -r};
  Point(4 + 10 * s) = {h, h, 0};
  Point(5 + 10 * s) = {0, h, -h};
  Point(6 + 10 * s) = {h, 0, -h};
  Point(7 + 10 * s) = {m, m, -m};
  Circle(1 + 20 * s) = {1 + 10 * s, 100, 4 + 10 * s};
  Circle(2 + 20 * s) = {4 + 10 * s, 100, 2 + 10 * s};
  Circle(3 + 20 * s) = {2 + 10 * s, 100, 5 + 10 * s};
  Circle(4 + 20 * s) = {5 + 10 * s, 100, 3 + 10 * s};
  Circle(5 + 20 * s) = {3 + 10 * s, 100, 6 + 10 * s};
  Circle(6 + 20 * s) = {6 + 10 * s, 100, 1 + 10 * s};
  Circle(7 + 20 * s) = {4 + 10 * s, 100, 7 + 10 * s};
  Circle(8 + 20 * s) = {5 + 10 * s, 100, 7 + 10 * s};
  Circle(9 + 20 * s) = {6 + 10 * s, 100, 7 + 10 * s};
  Curve Loop(1 + 20 * s) = {1 + 20 * s, 7 + 20 * s, -(9 + 20 * s), 6 + 20 * s};
  Curve Loop(2 + 20 * s) = {2 + 20 * s, 3 + 20 * s, 8 + 20 * s, -(7 + 20 * s)};
  Curve Loop(3 + 20 * s) = {4 + 20 * s, 5 + 20 * s, 9 + 20 * s, -(8 + 20 * s)};
  For b In {1:3}
    Surface(b + 20 * s) = {b + 20 * s} In Sphere {100};
  EndFor
EndFor
For p In {1:7}
  Line(40 + p) = {p, p + 10};  // through the wall
EndFor
// Sides of the blocks: from curve c of the inner sphere, which goes from point a to point b.
from[] = {1, 4, 2, 5, 3, 6, 4, 5, 6};
to[] = {4, 2, 5, 3, 6, 1, 7, 7, 7};
For c In {1:9}
  Curve Loop(40 + c) = {c, 40 + to[c - 1], -(c + 20), -(40 + from[c - 1])};
  Surface(40 + c) = {40 + c};
EndFor
Surface Loop(1) = {1, 21, 41, 47, 49, 46};
Surface Loop(2) = {2, 22, 42, 43, 48, 47};
Surface Loop(3) = {3, 23, 44, 45, 49, 48};
For b In {1:3}
  Volume(b) = {b};
EndFor

Transfinite Curve {1:9, 21:29} = n + 1;
Transfinite Curve {41:47} = layers + 1 Using Progression thicker;
Transfinite Surface {1:3, 21:23, 41:49};
Recombine Surface {1:3, 21:23, 41:49};
Transfinite Volume {1:3};

Physical Surface("bearing") = {1:3};
Physical Surface("shell") = {21:23};
Physical Surface("rim") = {41, 42};
Physical Surface("across_x") = {43, 44};
Physical Surface("across_y") = {45, 46};
Physical Volume("cup") = {1:3};
