#include <gnomon/scene/registry.hpp>
#include <map>

namespace gnomon {

std::shared_ptr<void>& registered_of_type(const char* type) {
  // Function-local, because it is filled during static initialisation; never destroyed, because a
  // value may be of a plug-in whose code is gone at the end of the process.
  static auto& kept = *new std::map<std::string, std::shared_ptr<void>>;
  return kept[type];
}

}  // namespace gnomon
