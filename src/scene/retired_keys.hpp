// Keys that scenes no longer have: those that have another name now are read as before, and so are
// values that changed nothing. Earlier scenes and results stay readable.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

#include "scene/scene_file.hpp"

namespace gnomon {

/// The values with retired keys renamed, or left out where they change nothing. Those that have to
/// be written in another way stay: the table does not have them.
std::vector<GivenValue> without_retired_keys(std::vector<GivenValue> given,
                                             const std::vector<Key>& table);

/// What to write in the place of a retired key, "expected ..."; empty for other keys.
std::string instead_of_retired(const std::string& name);

}  // namespace gnomon
