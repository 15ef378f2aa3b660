// The keys of a part of one's own.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <vector>

namespace gnomon::part {

/// All keys but run_keys() and those of the counter-body. One table for parts in the plane and in
/// space, for the mesh tells which it is: arrays that have a number for each direction are of any
/// length here.
std::vector<Key> part_keys();

}  // namespace gnomon::part
