// The paper's pin (sec. 4.1): a parabola y = x^2/(2R) below, flat above. Lengths in mm.
// n elements across and along the height; every node of the parabola is a point, so that the mesh is that of the
// problem pin_on_flat.
If (!Exists(n)) n = 40; EndIf
R = 5; L = 10; H = 10;

For i In {0:n}
  x = (i / n - 0.5) * L;
  Point(1 + i) = {x, x * x / (2 * R), 0};
EndFor
For i In {1:n}
  Line(i) = {i, i + 1};
  bottom[] += {i};
EndFor
Point(n + 2) = {L / 2, H, 0};
Point(n + 3) = {-L / 2, H, 0};
right = n + 1; top = n + 2; left = n + 3;
Line(right) = {n + 1, n + 2};
Line(top) = {n + 2, n + 3};
Line(left) = {n + 3, 1};

Transfinite Curve {bottom[]} = 2;
Transfinite Curve {right, top, left} = n + 1;
Curve Loop(1) = {bottom[], right, top, left};
Plane Surface(1) = {1};
Transfinite Surface {1} = {1, n + 1, n + 2, n + 3};
Recombine Surface {1};

Physical Curve("surface") = {bottom[]};
Physical Curve("top") = {top};
Physical Curve("sides") = {left, right};
Physical Surface("pin") = {1};
