// Mistakes of TOML in the words of scenes.
#pragma once

#include <string>

namespace gnomon {

/// What to write instead, for mistakes that scenes often have, where the parser refuses line `line`
/// (from 1) of `text`; empty for others.
std::string usual_toml_mistake(const std::string& text, int line);

}  // namespace gnomon
