// A bush around a shaft of radius 10: bore, wall and number of elements along a quarter.
If (!Exists(n)) n = 40; EndIf
inner = 10.05;
outer = 13;
Point(1) = {0, 0, 0};
For i In {0:3}
  Point(10 + i) = {inner * Cos(i * Pi / 2), inner * Sin(i * Pi / 2), 0};
  Point(20 + i) = {outer * Cos(i * Pi / 2), outer * Sin(i * Pi / 2), 0};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Circle(100 + i) = {10 + i, 1, 10 + j};
  Circle(200 + i) = {20 + i, 1, 20 + j};
  Line(300 + i) = {10 + i, 20 + i};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Curve Loop(i + 1) = {300 + i, 200 + i, -(300 + j), -(100 + i)};
  Plane Surface(i + 1) = {i + 1};
EndFor
Transfinite Curve {100:103, 200:203} = n + 1;
Transfinite Curve {300:303} = Round(n / 6) + 2 Using Progression 1.15;
Transfinite Surface {1:4};
Recombine Surface {1:4};
Physical Curve("bore") = {100:103};
Physical Curve("housing") = {200:203};
Physical Surface("bush") = {1:4};
