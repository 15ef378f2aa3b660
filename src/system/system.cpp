#include <gnomon/system/system.hpp>

namespace gnomon {

ActiveSet active_set(const System& system, const Point& at) {
  std::vector<double> values(system.structure().switch_node.size());
  system.switching(at, values);
  ActiveSet active(values.size());
  for (std::size_t j = 0; j < values.size(); ++j) active[j] = values[j] <= 0;
  return active;
}

}  // namespace gnomon
