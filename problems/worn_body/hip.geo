// Half of a hip joint, y > 0: a hemispherical cup whose pole is down, and a hollow head in it. Lengths in mm.
// Each body is six blocks of hexahedra, n x n on the sphere, three on either side of x = 0.
n = Ceil(6 / Mesh.MeshSizeFactor - 1e-9);
layers = Ceil(3 / Mesh.MeshSizeFactor - 1e-9);

// Tags of a body begin at `t`; its points, curves and surfaces on the outer sphere are 50 beyond those on the inner one.
// On x = 0: points 1 to 3, at y, at the pole and between them; on each side 4 to 7 and 14 to 17.
Macro HalfShell
  For s In {0:1}
    r = s == 0 ? inner : outer; p = t + 50 * s;
    h = r / Sqrt(2); m = r / Sqrt(3);
    Point(p + 1) = {0, r, 0};
    Point(p + 2) = {0, 0, -r};
    Point(p + 3) = {0, h, -h};
    Circle(p + 1) = {p + 1, t, p + 3};
    Circle(p + 2) = {p + 3, t, p + 2};
    For side In {0:1}
      q = p + 10 * side; x = 1 - 2 * side;
      Point(q + 4) = {x * r, 0, 0};
      Point(q + 5) = {x * h, h, 0};
      Point(q + 6) = {x * h, 0, -h};
      Point(q + 7) = {x * m, m, -m};
      Circle(q + 3) = {q + 4, t, q + 5};
      Circle(q + 4) = {q + 5, t, p + 1};
      Circle(q + 5) = {p + 2, t, q + 6};
      Circle(q + 6) = {q + 6, t, q + 4};
      Circle(q + 7) = {q + 5, t, q + 7};
      Circle(q + 8) = {p + 3, t, q + 7};
      Circle(q + 9) = {q + 6, t, q + 7};
      Curve Loop(q + 1) = {q + 3, q + 7, -(q + 9), q + 6};
      Curve Loop(q + 2) = {q + 4, p + 1, q + 8, -(q + 7)};
      Curve Loop(q + 3) = {p + 2, q + 5, q + 9, -(q + 8)};
      For b In {1:3}
        Surface(q + b) = {q + b} In Sphere {t};
      EndFor
    EndFor
  EndFor
  points[] = {1:7, 14:17};
  For k In {0:#points[] - 1}
    Line(t + 100 + points[k]) = {t + points[k], t + 50 + points[k]};  // through the wall
  EndFor
  curves[] = {1:9, 13:19};
  from[] = {1, 3, 4, 5, 2, 6, 5, 3, 6, 14, 15, 2, 16, 15, 3, 16};
  to[] = {3, 2, 5, 1, 6, 4, 7, 7, 7, 15, 1, 16, 14, 17, 17, 17};
  For k In {0:#curves[] - 1}
    c = curves[k];
    Curve Loop(t + 200 + c) = {t + c, t + 100 + to[k], -(t + 50 + c), -(t + 100 + from[k])};
    Surface(t + 200 + c) = {t + 200 + c};
    Transfinite Curve {t + c, t + 50 + c} = n + 1;
    Transfinite Surface {t + 200 + c};
    Recombine Surface {t + 200 + c};
  EndFor
  For k In {0:#points[] - 1}
    Transfinite Curve {t + 100 + points[k]} = layers + 1;
  EndFor
  For side In {0:1}
    q = t + 10 * side; w = t + 200 + 10 * side; mid = t + 200;
    Surface Loop(q + 1) = {q + 1, q + 51, w + 3, w + 7, w + 9, w + 6};
    Surface Loop(q + 2) = {q + 2, q + 52, w + 4, mid + 1, w + 8, w + 7};
    Surface Loop(q + 3) = {q + 3, q + 53, mid + 2, w + 5, w + 9, w + 8};
    For b In {1:3}
      Transfinite Surface {q + b, q + 50 + b};
      Recombine Surface {q + b, q + 50 + b};
      Volume(q + b) = {q + b};
      Transfinite Volume {q + b};
    EndFor
  EndFor
Return

Point(1000) = {0, 0, 0}; t = 1000; inner = 14.1; outer = 20;
Call HalfShell;
Point(2000) = {0, 0, 0}; t = 2000; inner = 8; outer = 14;
Call HalfShell;

Physical Volume("cup") = {1001:1003, 1011:1013};
Physical Surface("bearing") = {1001:1003, 1011:1013};
Physical Surface("shell") = {1051:1053, 1061:1063};
Physical Surface("cup_middle") = {1205, 1206, 1215, 1216};
Physical Volume("head") = {2001:2003, 2011:2013};
Physical Surface("bore") = {2001:2003, 2011:2013};
Physical Surface("ball") = {2051:2053, 2061:2063};
Physical Surface("head_middle") = {2205, 2206, 2215, 2216};
Physical Surface("rims") = {1203, 1204, 1213, 1214, 2203, 2204, 2213, 2214};
