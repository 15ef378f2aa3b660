// A quarter of a block under a ball that touches it at the origin: x > 0, y > 0, z < 0, `width` wide and deep. Structured
// hexahedra: `core` x `core` of one size in the middle, growing outwards and downwards. Lengths in mm.
If (!Exists(elements)) elements = 10; EndIf  // along the patch of equal ones, by gnomon's mesh.factor
core = Ceil(elements / Mesh.MeshSizeFactor - 1e-9);
If (!Exists(patch)) patch = 0.6; EndIf
If (!Exists(width)) width = 4; EndIf
around = Ceil(core * 0.8);

// The ratio of `around` elements that begin with `first` and are `width - patch` long together: by bisection.
first = patch / core;
low = 1; high = 10;
For k In {1:60}
  ratio = (low + high) / 2;
  If (first * (ratio^around - 1) / (ratio - 1) > width - patch)
    high = ratio;
  Else
    low = ratio;
  EndIf
EndFor

Point(1) = {0, 0, 0};
row[] = Extrude {patch, 0, 0} { Point{1}; Layers{core}; };
lengths[] = {}; counts[] = {};
total = 0;
For k In {1:around}
  total += first * ratio^(k - 1);
  lengths[] += {total / (width - patch)}; counts[] += {1};
EndFor
depths[] = {}; ones[] = {};
depth = 0; sum = 0; layers = 2 * core;
For k In {1:layers}
  sum += ratio^(k - 1);
EndFor
For k In {1:layers}
  depth += ratio^(k - 1) / sum;
  depths[] += {depth}; ones[] += {1};
EndFor
outer[] = Extrude {width - patch, 0, 0} { Point{row[0]}; Layers{counts[], lengths[]}; };
strip[] = Extrude {0, patch, 0} { Line{row[1], outer[1]}; Layers{core}; Recombine; };
wide[] = Extrude {0, width - patch, 0} { Line{strip[0], strip[4]}; Layers{counts[], lengths[]}; Recombine; };
face[] = {strip[1], strip[5], wide[1], wide[5]};
volume[] = Extrude {0, 0, -width} { Surface{face[]}; Layers{ones[], depths[]}; Recombine; };

Physical Surface("face") = {face[0]};
Physical Surface("beside") = {face[1], face[2], face[3]};
eps = 1e-6;
Physical Surface("base") = Surface In BoundingBox {-eps, -eps, -width - eps, width + eps, width + eps, -width + eps};
Physical Surface("block_across_x") = Surface In BoundingBox {-eps, -eps, -width - eps, eps, width + eps, eps};
Physical Surface("block_across_y") = Surface In BoundingBox {-eps, -eps, -width - eps, width + eps, eps, eps};
Physical Volume("block") = Volume{:};
