// Laws of materials by name. A file in `src/terms/materials/` defines one static
// Registration of a MaterialLaw; nothing else has to change to add a law:
//
//   template <int dim, class Scalar = double>
//   class OgdenPoint { ... };  // an ElasticPoint, laws/elastic_law.hpp
//
//   const Registration<MaterialLaw> registration{
//       {.name = "ogden", .help = "...", .kernels = &law_kernels<OgdenPoint>}};
#pragma once

#include <functional>
#include <gnomon/scene/registry.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/terms/material.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// A hyperelastic law under its name.
struct MaterialLaw {
  std::string name;                     ///< "neo-hookean"
  std::string help;                     ///< one line
  const LawKernels* kernels = nullptr;  ///< &law_kernels<Law>, solid_kernels.hpp
  /// Keys of the law's ratios, named without their table: "mooney_ratio". They must be optional;
  /// scenes may give them only if they choose this law.
  std::vector<Key> keys{};
  /// ElasticModuli::ratios of the keys `table` + name ("body." + name); lambda and mu are given.
  /// Throws InputError (using Scene::where). None: all zero.
  std::function<std::array<double, 2>(const Scene&, const std::string& table, const ElasticModuli&)>
      ratios = nullptr;
  /// Approximate factor by which the forces of nearly collapsed elements exceed those of eq. (38);
  /// rounding errors grow with them.
  double collapse_force = 1;

  std::string missing() const { return kernels ? "" : "kernels"; }  ///< for Registry
};

using MaterialLaws = Registry<MaterialLaw>;

/// The material that the key `choice` ("body.material") names, from the keys of the same table:
/// "body.young_modulus", "body.poisson_ratio" and those of the law. Throws InputError like the law,
/// and if there are keys of another law.
Material read_material(const Scene& scene, const std::string& choice);

/// Completes the key `choice` ("body.material") of a key table, if the table has it: the registered
/// laws join its choices, and their keys are inserted after it.
void add_material_keys(std::vector<Key>& table, const std::string& choice);

}  // namespace gnomon
