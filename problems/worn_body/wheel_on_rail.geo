// A piece of a wheel above a piece of a rail: x runs along the rail, y across it, z upwards; lengths in mm. The two share
// no point. Blocks of hexahedra: nodes of the head lie on lines along x from end to end, by which it wears.
radius = 460;  // of the wheel
crown = 300;   // of the head of the rail, across it
cone = 0;      // slope of the tread across the rail
x() = {-24, -5, 5, 24};  // the middle block has small elements
y() = {-24, -6, 6, 24};
high = 24;  // of each body
nx = Round(14 / Mesh.MeshSizeFactor);  // elements of the middle block
ny = Round(10 / Mesh.MeshSizeFactor);
layers = Round(2 / Mesh.MeshSizeFactor);  // from there to the ends
deep = Round(5 / Mesh.MeshSizeFactor);
grow = 3^Mesh.MeshSizeFactor;

For b In {0:1}  // the rail, the wheel; 3 x 3 blocks each, k = 0 where they touch
  o = 1000 * b;
  For k In {0:1}
    For j In {0:3}
      For i In {0:3}
        z = Sqrt(crown^2 - y(j)^2) - crown;
        If (b == 1)
          z = radius - Sqrt(radius^2 - x(i)^2) + cone * y(j);
        EndIf
        If (k == 1)
          z = (2 * b - 1) * high;
        EndIf
        Point(o + 1 + i + 4 * j + 16 * k) = {x(i), y(j), z};
      EndFor
    EndFor
  EndFor
  For i In {0:3}  // centres of the arcs
    If (b == 0)
      Point(o + 40 + i) = {x(i), 0, -crown};
    Else
      Point(o + 50 + i) = {0, y(i), radius + cone * y(i)};
    EndIf
  EndFor
  For k In {0:1}
    For j In {0:3}
      For i In {0:2}
        p = o + 1 + i + 4 * j + 16 * k;
        q = o + 1 + j + 4 * i + 16 * k;
        If (b == 1 && k == 0)
          Circle(o + 100 + i + 3 * j + 12 * k) = {p, o + 50 + j, p + 1};
        Else
          Line(o + 100 + i + 3 * j + 12 * k) = {p, p + 1};
        EndIf
        If (b == 0 && k == 0)
          Circle(o + 200 + j + 4 * i + 12 * k) = {q, o + 40 + j, q + 4};
        Else
          Line(o + 200 + j + 4 * i + 12 * k) = {q, q + 4};
        EndIf
        t = o + 100 + i + 3 * j + 12 * k; u = o + 200 + j + 4 * i + 12 * k;
        If (i == 1)
          Transfinite Curve {t} = nx + 1; Transfinite Curve {u} = ny + 1;
        ElseIf (i == 0)
          Transfinite Curve {-t, -u} = layers + 1 Using Progression grow;
        Else
          Transfinite Curve {t, u} = layers + 1 Using Progression grow;
        EndIf
      EndFor
    EndFor
  EndFor
  For j In {0:3}
    For i In {0:3}
      Line(o + 300 + i + 4 * j) = {o + 1 + i + 4 * j, o + 17 + i + 4 * j};
      Transfinite Curve {o + 300 + i + 4 * j} = deep + 1 Using Progression 1.8^Mesh.MeshSizeFactor;
    EndFor
  EndFor
  For k In {0:1}
    For j In {0:2}
      For i In {0:2}
        t = o + 100 + i + 3 * j + 12 * k; u = o + 200 + i + 4 * j + 12 * k;
        Curve Loop(o + 400 + i + 3 * j + 9 * k) = {t, u + 1, -(t + 3), -u};
        Surface(o + 400 + i + 3 * j + 9 * k) = {o + 400 + i + 3 * j + 9 * k};
      EndFor
    EndFor
  EndFor
  For j In {0:3}
    For i In {0:2}
      t = o + 100 + i + 3 * j; u = o + 300 + i + 4 * j;
      Curve Loop(o + 500 + i + 3 * j) = {t, u + 1, -(t + 12), -u};
      Surface(o + 500 + i + 3 * j) = {o + 500 + i + 3 * j};
      t = o + 200 + j + 4 * i; u = o + 300 + j + 4 * i;
      Curve Loop(o + 600 + j + 4 * i) = {t, u + 4, -(t + 12), -u};
      Surface(o + 600 + j + 4 * i) = {o + 600 + j + 4 * i};
    EndFor
  EndFor
  For j In {0:2}
    For i In {0:2}
      v = o + 700 + i + 3 * j; t = o + 400 + i + 3 * j;
      Surface Loop(v) = {t, t + 9, o + 500 + i + 3 * j, o + 503 + i + 3 * j, o + 600 + i + 4 * j,
                         o + 601 + i + 4 * j};
      Volume(v) = {v};
    EndFor
  EndFor
EndFor
Transfinite Surface "*"; Recombine Surface "*"; Transfinite Volume "*";

Physical Volume("rail") = {700:708};
Physical Volume("wheel") = {1700:1708};
Physical Surface("head") = {400:408};
Physical Surface("base") = {409:417};
Physical Surface("tread") = {1400:1408};
Physical Surface("top") = {1409:1417};
Physical Surface("ends") = {600, 604, 608, 603, 607, 611, 1600, 1604, 1608, 1603, 1607, 1611};  // x = const
Physical Surface("sides") = {500:502, 509:511, 1500:1502, 1509:1511};  // y = const
