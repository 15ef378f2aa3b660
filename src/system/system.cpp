#include <gnomon/fields/block.hpp>
#include <gnomon/system/system.hpp>

namespace gnomon {

const Block& Structure::block_of(std::size_t unknown) const {
  return (*blocks)[block[unknown]];
}

ActiveSet active_set(const System& system, const Point& at) {
  std::vector<double> values(system.structure().switch_node.size());
  system.switching(at, values);
  ActiveSet active(values.size());
  for (std::size_t j = 0; j < values.size(); ++j) active[j] = values[j] <= 0;
  return active;
}

ActiveSet active_set(const System& system, double t, std::span<const double> y) {
  return active_set(system, {.t = t, .y = y});
}

}  // namespace gnomon
