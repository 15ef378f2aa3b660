// A quarter of the end of a ball that touches z = 0 at the origin: x > 0, y > 0, out to `width` and up to `height`.
// Structured hexahedra: `core` x `core` of one size in the middle, growing outwards and upwards. Lengths in mm.
If (!Exists(radius)) radius = 50; EndIf
If (!Exists(elements)) elements = 14; EndIf  // along the patch of equal ones, by gnomon's mesh.factor
core = Ceil(elements / Mesh.MeshSizeFactor - 1e-9);
If (!Exists(patch_x)) patch_x = 0.6; EndIf  // its length along x and along y
If (!Exists(patch_y)) patch_y = patch_x; EndIf
If (!Exists(width)) width = 4; EndIf
If (!Exists(height)) height = 4; EndIf
If (!Exists(around)) around = Ceil(core * 0.6); EndIf
If (!Exists(up)) up = Ceil(core * 0.9); EndIf

// The ratio of n elements that begin with `first` and are `length` long together: by bisection.
Macro Ratio
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

Macro OnBall  // x, y -> z
  z = radius - Sqrt(radius * radius - x * x - y * y);
Return

size = Sqrt(patch_x * patch_y) / core;
first = size; n = around; length = width - patch_x;
Call Ratio;
outwards_x = ratio;
first = size; n = around; length = width - patch_y;
Call Ratio;
outwards_y = ratio;
first = size; n = up; length = height;
Call Ratio;
upwards = ratio;

diagonal = 0.9;  // corner of the patch
side = width / Sqrt(2);
Point(100) = {0, 0, radius};  // middle of the ball
px[] = {0, patch_x, diagonal * patch_x, 0, width, side, 0};
py[] = {0, 0, diagonal * patch_y, patch_y, 0, side, width};
For i In {0:6}
  x = px[i]; y = py[i];
Call OnBall;
  Point(1 + i) = {x, y, z};
  Point(11 + i) = {x, y, height};
  Line(51 + i) = {1 + i, 11 + i};
EndFor
x = width; y = 0;
Call OnBall;
Point(101) = {0, 0, z};


// Patch: 1-2-3-4, outside: 2-5-6-3 and 4-3-6-7.
Circle(1) = {1, 100, 2}; Circle(2) = {2, 100, 3}; Circle(3) = {4, 100, 3}; Circle(4) = {1, 100, 4};
Circle(5) = {2, 100, 5}; Circle(6) = {3, 100, 6}; Circle(7) = {4, 100, 7};
Circle(8) = {5, 101, 6}; Circle(9) = {7, 101, 6};
from[] = {1, 2, 4, 1, 2, 3, 4}; to[] = {2, 3, 3, 4, 5, 6, 7};
For i In {0:6}
  Line(11 + i) = {10 + from[i], 10 + to[i]};
EndFor
Circle(18) = {15, 11, 16}; Circle(19) = {17, 11, 16};

Curve Loop(1) = {1, 2, -3, -4}; Curve Loop(2) = {5, 8, -6, -2}; Curve Loop(3) = {3, 6, -9, -7};
Curve Loop(11) = {11, 12, -13, -14}; Curve Loop(12) = {15, 18, -16, -12}; Curve Loop(13) = {13, 16, -19, -17};
For i In {1:3}
  Surface(i) = {i} In Sphere {100};
  Plane Surface(10 + i) = {10 + i};
EndFor
a[] = {1, 2, 4, 1, 2, 3, 4, 5, 7}; b[] = {2, 3, 3, 4, 5, 6, 7, 6, 6};
For i In {0:8}
  Curve Loop(21 + i) = {1 + i, 50 + b[i], -(11 + i), -(50 + a[i])};
  Surface(21 + i) = {21 + i};
EndFor
Surface Loop(1) = {1, 11, 21, 22, 23, 24}; Surface Loop(2) = {2, 12, 25, 28, 26, 22};
Surface Loop(3) = {3, 13, 23, 26, 29, 27};
For i In {1:3}
  Volume(i) = {i};
EndFor

Transfinite Curve {1:4, 8, 9, 11:14, 18, 19} = core + 1;
Transfinite Curve {5, 15} = around + 1 Using Progression outwards_x;
Transfinite Curve {7, 17} = around + 1 Using Progression outwards_y;
Transfinite Curve {6, 16} = around + 1 Using Progression Sqrt(outwards_x * outwards_y);
Transfinite Curve {51:57} = up + 1 Using Progression upwards;
Transfinite Surface {1:3, 11:13, 21:29};
Recombine Surface {1:3, 11:13, 21:29};
Transfinite Volume {1:3};

Physical Surface("surface") = {1};
Physical Surface("outside") = {2, 3, 28, 29};
Physical Surface("top") = {11, 12, 13};
Physical Surface("across_y") = {21, 25};
Physical Surface("across_x") = {24, 27};
Physical Volume("ball") = {1:3};
