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

/// A shape that scenes may name, in one dimension.
template <int dim>
struct CounterShapeKind {
  std::string name;
  std::string help;  ///< one line
  /// counter_body.*. One name has the same kind, length and range in all shapes of a dimension,
  /// for one table has the keys of all shapes (counter_body_scene.hpp).
  std::vector<Key> keys;
  /// Throws InputError. In 3D the section is not read.
  std::function<CounterShape<dim>(const Scene&, Section)> make;

  std::string missing() const { return make ? "" : "make"; }  ///< for Registry
};

}  // namespace gnomon
