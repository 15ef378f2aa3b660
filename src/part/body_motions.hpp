// How bodies move as a whole: their material through a steady state, and their places over a cycle:
// [[motion]].
#pragma once

#include <array>
#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::part {

std::vector<Key> motion_keys_of_bodies();

/// By name of the body that moves; what is bonded to it moves with it. Throws InputError.
template <int dim>
std::map<std::string, BodyCycle<dim>> read_motions_of_bodies(const Scene& scene,
                                                             const AssemblyParts<dim>& parts);

/// A body in steady rolling: its material where it touches.
template <int dim>
struct RollingBody {
  Vector<dim> velocity = Vector<dim>::Zero();  ///< [length / time]
  Tensor<dim> spin = Tensor<dim>::Zero();      ///< about `centre` [1 / time]
  Vector<dim> centre = Vector<dim>::Zero();
  bool on_axle = false;  ///< the spin is that about the axle, in the place of a velocity
  /// On the body along its velocity and across it; given: it determines the velocity [force].
  std::array<std::optional<double>, 2> force = {};
  /// In space: the same about an axis through `centre`, whose spin is `turn` [force length].
  std::optional<double> moment = {};
  Tensor<dim> turn = Tensor<dim>::Zero();
  std::string table = {};  ///< of the scene; empty: it is at rest
};

/// By its name. Throws InputError.
template <int dim>
RollingBody<dim> read_rolling_body(const Scene& scene, const AssemblyParts<dim>& parts,
                                   const std::string& body);

}  // namespace gnomon::part
