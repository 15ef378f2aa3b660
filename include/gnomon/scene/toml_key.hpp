// Names as parts of keys.
#pragma once

#include <string>

namespace gnomon {

/// A name as TOML writes it in a key: bare where that is possible, else quoted. Scenes name keys
/// so: `wear.surfaces."upper side".rate`.
std::string toml_key(const std::string& name);

}  // namespace gnomon
