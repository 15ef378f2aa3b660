#include <algorithm>
#include <cctype>
#include <gnomon/scene/toml_key.hpp>

#include "scene/toml_text.hpp"

namespace gnomon {

std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) || c == '_' || c == '-');
  });
  return bare ? key : toml_text(key);
}

}  // namespace gnomon
