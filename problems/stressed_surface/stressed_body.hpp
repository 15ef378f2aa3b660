// All constants of a body whose free surface moves by its energy, and its meshes.
#pragma once

#include <functional>
#include <gnomon/fields/field.hpp>
#include <gnomon/laws/elastic_law.hpp>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/system/composed_system.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "surface_law.hpp"

namespace gnomon::stressed {

/// Where a point of the surface is on the wave that it carries.
struct OnWave {
  double phase;   ///< 0 at the first node, pi times a whole number at the last
  double height;  ///< over the flat surface, or distance from the centre [length]
};

struct StressedBody {
  Mesh<2> mesh;
  std::vector<ContactPatch<2>> surface;  ///< nodes of the free surface, along it
  NodalFlags<2> displacement_fixed;      ///< 1 where u is held
  NodalFlags<2> shape_fixed;             ///< 1 where d is held at zero
  NodalProjectors<2> shape_along;        ///< for MeshMotion: none
  /// Where u is held at other values than zero. They do not change, so no load does work.
  std::vector<PrescribedValues::Entry> pulled;
  std::optional<ElasticModuli> elastic;        ///< none: the surface moves by its curvature alone
  Vector<2> mesh_weights = Vector<2>::Ones();  ///< of the mesh motion, harmonic_mesh.hpp
  double stress = 0;                           ///< of the flat surface, along it
  SurfaceLaw law;
  double size = 1;      ///< of the body [length]
  double change = 1;    ///< typical d [length]
  double duration = 1;  ///< of the run [time]
  std::function<OnWave(const Vector<2>& X)> wave;
  /// Of a circle without lobes: R(t) / R0, while there is one.
  std::function<std::optional<double>(double t)> ratio;
};

/// The keys of the problem.
std::vector<Key> stressed_body_keys();

/// The body of a scene. Throws InputError.
std::shared_ptr<const StressedBody> read_stressed_body(const Scene& scene);

}  // namespace gnomon::stressed
