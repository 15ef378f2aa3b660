#include <algorithm>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/closings.hpp>
#include <utility>

namespace gnomon {

bool Closings::closes(const ActiveSet& end) const {
  bool none = true;
  for (std::size_t j = 0; j < end.size(); ++j) none = none && (active_[j] || !end[j]);
  return !on_all_processes(none);
}

void Closings::accept(ActiveSet end, bool settled) {
  const int before = settled ? steps_ : std::min(since_ + 1, steps_);
  since_ = closes(end) ? 0 : before;
  active_ = std::move(end);
}

}  // namespace gnomon
