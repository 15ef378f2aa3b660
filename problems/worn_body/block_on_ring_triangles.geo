// The block of block_on_ring.geo with a mesh of triangles, made by the script itself (Mesh 2). Each triangle becomes
// three quadrilaterals of half its size, so that the facets of the contact are as long. Lengths in mm.
If (!Exists(scale)) scale = 1; EndIf  // of all sizes
fine = 0.08 * scale; coarse = 1.2 * scale;
half = 1.6;  // of the surface that may touch
width = 4; depth = 4;

Point(1) = {-width, -depth, 0, coarse};
Point(2) = { width, -depth, 0, coarse};
Point(3) = { width, 0, 0, coarse};
Point(4) = { half, 0, 0, fine};
Point(5) = {-half, 0, 0, fine};
Point(6) = {-width, 0, 0, coarse};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};

Physical Curve("bottom") = {1};
Physical Curve("surface") = {4};
Physical Surface("block") = {1};
Mesh 2;
