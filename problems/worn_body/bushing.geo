// Makes bushing.step (gmsh -0 bushing.geo): the lower part of a bushing with an oil hole beside its middle. Lengths in mm.
SetFactory("OpenCASCADE");
bore = 10; outside = 13; length = 12;

Cylinder(1) = {0, -length / 2, 0, 0, length, 0, outside};
Cylinder(2) = {0, -length / 2, 0, 0, length, 0, bore};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
// The lower part, up to 5 mm below the axis.
Box(4) = {-20, -20, -20, 40, 40, 15};
BooleanIntersection(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
// The oil hole.
Cylinder(6) = {3, 2.5, -20, 0, 0, 20, 1};
BooleanDifference(7) = { Volume{5}; Delete; }{ Volume{6}; Delete; };
Save "bushing.step";
