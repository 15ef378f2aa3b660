// A quarter of a conical seat about the axis z, tip of the cone at the origin, around the circle where a ball of
// `radius` touches it. Structured hexahedra: a section, revolved. Lengths in mm.
radius = 5;
half_angle = 45 * Pi / 180;
core = Ceil(10 / Mesh.MeshSizeFactor - 1e-9);  // elements along half of the patch of equal ones
turn = core;  // elements along the quarter
patch = 0.11;  // half of its length
width = 1.5;   // half of the length of the seat
depth = 1.5;
around = Ceil(core * 0.8);  // elements from the patch outwards, and in depth

Macro Ratio  // of n elements that begin with `first` and are `length` long together: by bisection
  low = 1; high = 10;
  For k In {1:60}
    ratio = (low + high) / 2;
    If (first * (ratio^n - 1) / (ratio - 1) > length)
      high = ratio;
    Else
      low = ratio;
    EndIf
  EndFor
Return

first = patch / core; n = around; length = width - patch;
Call Ratio;
outwards = ratio;
n = around; length = depth;
Call Ratio;
downwards = ratio;

// s along the seat from where the ball touches, d into it.
touch = radius / Tan(half_angle);  // from the tip
s[] = {-width, -patch, patch, width};
For i In {0:3}
  For j In {0:1}
    l = touch + s[i]; d = j * depth;
    Point(1 + i + 10 * j) = {l * Sin(half_angle) + d * Cos(half_angle), 0,
                             l * Cos(half_angle) - d * Sin(half_angle)};
  EndFor
  Line(21 + i) = {1 + i, 11 + i};
EndFor
For j In {0:1}
  For i In {0:2}
    Line(1 + i + 10 * j) = {1 + i + 10 * j, 2 + i + 10 * j};
  EndFor
EndFor
For i In {0:2}
  Curve Loop(1 + i) = {1 + i, 22 + i, -(11 + i), -(21 + i)};
  Plane Surface(1 + i) = {1 + i};
EndFor
Transfinite Curve {2, 12} = 2 * core + 1;
Transfinite Curve {-1, -11, 3, 13} = around + 1 Using Progression outwards;
Transfinite Curve {21:24} = around + 1 Using Progression downwards;
Transfinite Surface {1:3};
Recombine Surface {1:3};

For i In {1:3}
  part[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Surface{i}; Layers{turn}; Recombine; };
  ends[] += part[0];
  volumes[] += part[1];
  inner[] += part[2];
  base[] += part[4];
  If (i == 1)
    base[] += part[5];
  EndIf
  If (i == 3)
    base[] += part[3];
  EndIf
EndFor

Physical Surface("seat") = {inner[]};
Physical Surface("base") = {base[]};
Physical Surface("across_y") = {1:3};
Physical Surface("across_x") = {ends[]};
Physical Volume("block") = {volumes[]};
