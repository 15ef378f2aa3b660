// Shapes of counter-bodies that scenes may name. A new one is one file in src/shapes/catalogue with
// a Registration; nothing else has to change.
#pragma once

#include <functional>
#include <gnomon/mesh/section.hpp>
#include <gnomon/scene/registry.hpp>
#include <gnomon/shapes/counter_shape.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Makes the shape that a scene describes. Throws InputError. In 3D the section is not read.
template <int dim>
using CounterShapeMaker = std::function<CounterShape<dim>(const Scene&, Section)>;

/// A shape that scenes may name, in the plane, in space, or in both.
struct CounterShapeKind {
  std::string name;
  std::string help;  ///< one line
  /// counter_body.*, in the plane and in space. One name has the same kind, length and range in all
  /// shapes, for one table has the keys of all shapes (counter_body_scene.hpp).
  std::vector<Key> keys;
  std::vector<Key> keys_in_space{};  ///< further ones
  /// None: there is no such shape.
  CounterShapeMaker<2> in_plane{};
  CounterShapeMaker<3> in_space{};

  std::string missing() const { return in_plane || in_space ? "" : "in_plane"; }  ///< for Registry
};

}  // namespace gnomon
