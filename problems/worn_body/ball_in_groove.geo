// The end of a ball of 5 mm radius for an elliptical contact, long along y. Lengths in mm.
radius = 5;
elements = 12;
patch_x = 0.15; patch_y = 0.4;
width = 2.5; height = 2.5;
Include "ball_cap.geo";
