// How bodies move as a whole: their material through a steady state, and their places over a cycle:
// [[motion]].
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <string>
#include <vector>

namespace gnomon::part {

std::vector<Key> motion_keys_of_bodies();

/// By name of the body that moves. Throws InputError.
template <int dim>
std::map<std::string, BodyCycle<dim>> read_motions_of_bodies(const Scene& scene, Section section);

}  // namespace gnomon::part
