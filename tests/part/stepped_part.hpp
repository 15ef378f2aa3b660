// A body with a sole that wears and a shelf 0.1 mm above it that touches a plane later.
#pragma once

#include "part/part_scene.hpp"

namespace gnomon::testing {

inline const std::string steady = "[counter_body.motion]\nvelocity = [100.0, 0.0]\n";

inline std::unique_ptr<Model> stepped_part(const SceneFolder& folder,
                                           const std::string& motion = steady) {
  folder.write("step.geo", R"(Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {4, 1, 0};
Point(4) = {6, 1, 0}; Point(5) = {6, 0.1, 0}; Point(6) = {10, 0.1, 0}; Point(7) = {10, 5, 0};
Point(8) = {0, 5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6};
Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8};
Plane Surface(1) = {1};
Mesh.MeshSizeMax = 0.8;
Physical Curve("sole") = {1};
Physical Curve("back") = {7};
Physical Surface("body") = {1};
)");
  return make_model(load_scene(folder.write("step.toml", R"(problem = "worn_body"
mesh.file = "step.geo"
body = { young_modulus = 1000.0, poisson_ratio = 0.3 }
support = [ { on = "back" } ]
wear = { on = "sole", coefficient = 1e-8 }
time.end = 40000.0
integrator = { name = "esdirk-3", rtol = 1e-3 }
[counter_body]
shape = "plane"
normal = [0.0, 1.0]
press = { direction = [0.0, 1.0], force = 40.0 }
)" + motion),
                               {}, key_table));
}

}  // namespace gnomon::testing
