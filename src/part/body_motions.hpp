// How the material of bodies moves as a whole through a steady state: [[motion]].
#pragma once

#include <array>
#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <string>
#include <vector>

namespace gnomon::part {

std::vector<Key> motion_keys_of_bodies();

/// By name of the body that moves. Throws InputError.
template <int dim>
std::map<std::string, RigidMotion<dim>> read_motions_of_bodies(const Scene& scene, Section section);

/// That of the second body relative to the first; bodies without a motion are at rest.
template <int dim>
RigidMotion<dim> difference_of(const std::map<std::string, RigidMotion<dim>>& motions,
                               const std::array<std::string, 2>& bodies);

}  // namespace gnomon::part
