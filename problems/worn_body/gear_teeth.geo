// A tooth of each of two spur gears in the plane, at the moment when they touch at the pitch point. Lengths in mm.
// The driver turns about (0, 0) and its tooth lies below the flanks, the driven one about (r1 + r2, 0).
module = 4; z1 = 20; z2 = 40;
alpha = 20 * Pi / 180;  // pressure angle
fine = 0.2; coarse = 2;  // size of elements
steps = 24;             // points on a flank

r[] = {module * z1 / 2, module * z2 / 2};
For b In {0:1}
  t = 1000 * (b + 1);
  sign = 1 - 2 * b;  // the second tooth is turned by half a turn
  cx = b * (r[0] + r[1]);
  base = r[b] * Cos(alpha);
  // The involute of the base circle through the pitch point, from near that circle to the tip.
  first = 0.12; last = Sqrt((r[b] + module)^2 / base^2 - 1);
  turn = Tan(alpha) - alpha;
  For k In {0:steps}
    s = first + (last - first) * k / steps;
    x = base * (Cos(s) + s * Sin(s)); y = -base * (Sin(s) - s * Cos(s));
    Point(t + k) = {cx + sign * (x * Cos(turn) - y * Sin(turn)), sign * (x * Sin(turn) + y * Cos(turn)), 0, fine};
  EndFor
  tip = r[b] + module; foot = r[b] - 2 * module; thick = 1.6 * module;
  Point(t + 101) = {cx + sign * tip, -sign * (0.8 * module + thick / 2), 0, coarse / 2};
  Point(t + 102) = {cx + sign * r[b], -sign * 1.2 * thick, 0, coarse};
  Point(t + 103) = {cx + sign * foot, -sign * 1.6 * thick, 0, coarse};
  Point(t + 104) = {cx + sign * foot, sign * 0.3 * thick, 0, coarse};
  Spline(t) = {t : t + steps};
  Line(t + 1) = {t + steps, t + 101};
  Line(t + 2) = {t + 101, t + 102};
  Line(t + 3) = {t + 102, t + 103};
  Line(t + 4) = {t + 103, t + 104};
  Line(t + 5) = {t + 104, t};
  Curve Loop(t) = {t : t + 5};
  Plane Surface(t) = {t};
EndFor

Physical Surface("driver") = {1000};
Physical Surface("driven") = {2000};
Physical Curve("driver_flank") = {1000};
Physical Curve("driven_flank") = {2000};
Physical Curve("driver_foot") = {1004};
Physical Curve("driven_foot") = {2004};
