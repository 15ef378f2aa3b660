#include "part/pair_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/terms/sliding.hpp>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "part/boundary_beside.hpp"

namespace gnomon::part {

template <int dim>
void tell_of_edges(AssemblyParts<dim>& parts) {
  std::map<int, std::vector<std::pair<std::string, Vector<dim>>>> met;  // by node
  std::set<std::pair<std::string, std::string>> told;
  for (const Surface<dim>& surface : parts.interface.surfaces) {
    if (!surface.wears) continue;
    for (const auto& facet : surface.facets) {
      const Vector<dim> n = facet_normal<dim>(facet, parts.mesh.nodes);
      for (const int node : facet) {
        for (const auto& [other, normal] : met[node])
          if (other != surface.name && meet_at_edge<dim>(n, normal))
            told.emplace(other, surface.name);
        met[node].emplace_back(surface.name, n);
      }
    }
  }
  for (const auto& [one, other] : told)
    parts.remarks.push_back(
        fmt::format("\"{}\" and \"{}\" wear and meet at an edge, whose nodes have a mean normal: "
                    "pressures and volumes may be wrong by some percent; pair.#.surfaces restricts "
                    "contact to one of them",
                    one, other));
}

template <int dim>
void tell_of_turning(AssemblyParts<dim>& parts) {
  if (dim == 2 || parts.interface.sticks || parts.interface.rolling ||
      std::ranges::none_of(parts.interface.surfaces, &Surface<dim>::wears))
    return;
  for (const MortarPair<dim>& pair : parts.pairs) {
    const auto is_turned_about = [&](const ContactPatch<dim>& patch) {
      return pair.motion.at(patch.initial_position).squaredNorm() <
             velocity_variance<dim>(patch, pair.motion.spin, pair.motion.across_by_x);
    };
    if (std::ranges::any_of(contact_patches<dim>(parts.mesh, pair.slave, {}, parts.section()),
                            is_turned_about))
      parts.remarks.push_back(
          fmt::format("\"{}\" and \"{}\" turn on each other about a point of their surfaces: there "
                      "worn volumes "
                      "are accurate to first order in the size of the facets, compare a finer mesh",
                      pair.bodies[0], pair.bodies[1]));
  }
}

template void tell_of_edges(AssemblyParts<2>&);
template void tell_of_edges(AssemblyParts<3>&);
template void tell_of_turning(AssemblyParts<2>&);
template void tell_of_turning(AssemblyParts<3>&);

}  // namespace gnomon::part
