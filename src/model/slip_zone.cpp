#include "model/slip_zone.hpp"

#include <algorithm>

namespace gnomon {

template <int dim>
std::optional<int> width_of_slip_zone(const Assembly<dim>& assembly,
                                      const std::vector<Hold>& holds) {
  if (std::ranges::find(holds, Hold::sticks) == holds.end()) return {};
  std::vector<std::vector<std::size_t>> beside(holds.size());
  for (const auto& facet : facets_of(assembly.interface.surfaces))
    for (const int a : facet)
      for (const int b : facet)
        beside[static_cast<std::size_t>(assembly.contact_node(a))].push_back(
            static_cast<std::size_t>(assembly.contact_node(b)));
  std::vector<std::size_t> reached;
  std::vector<char> is_reached(holds.size(), 0);
  for (std::size_t c = 0; c < holds.size(); ++c)
    if (holds[c] == Hold::sticks) reached.push_back(c), is_reached[c] = 1;
  const bool slips = std::ranges::find(holds, Hold::slips) != holds.end();
  for (int width = 0;; ++width) {
    std::vector<std::size_t> next;
    for (const std::size_t c : reached)
      for (const std::size_t other : beside[c])
        if (holds[other] == Hold::slips && !is_reached[other])
          next.push_back(other), is_reached[other] = 1;
    if (next.empty()) return width == 0 && slips ? std::nullopt : std::optional(width);
    reached = std::move(next);
  }
}

template std::optional<int> width_of_slip_zone(const Assembly<2>&, const std::vector<Hold>&);
template std::optional<int> width_of_slip_zone(const Assembly<3>&, const std::vector<Hold>&);

}  // namespace gnomon
