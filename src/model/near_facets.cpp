#include "model/near_facets.hpp"

#include <algorithm>
#include <gnomon/model/worn_body_equations.hpp>
#include <utility>

namespace gnomon {

template <int dim>
std::vector<Vector<dim>> deformed(const Mesh<dim>& mesh, const NodalField<dim>& d,
                                  const NodalField<dim>& u) {
  std::vector<Vector<dim>> x = mesh.nodes;
  for (std::size_t node = 0; node < x.size(); ++node)
    x[node] += (d.row(Eigen::Index(node)) + u.row(Eigen::Index(node))).transpose();
  return x;
}

template <int dim>
bool have_strayed(const Assembly<dim>& body, const Phase<dim>& phase,
                  const std::vector<Vector<dim>>& x, double part) {
  const std::vector<Vector<dim>>& near = body.near[nearest_instant(body, phase.position)];
  const auto before = in_space(body.pairs, phase.places, near),
             now = in_space(body.pairs, phase.places, x);
  return !std::ranges::all_of(body.pairs, [&](const MortarPair<dim>& pair) {
    return is_within_margin(pair, before, now, part);
  });
}

template <int dim>
std::shared_ptr<const Assembly<dim>> with_facets_near(const Assembly<dim>& body,
                                                      const Phase<dim>& phase,
                                                      std::vector<Vector<dim>> x) {
  AssemblyParts<dim> parts = body;
  parts.near[nearest_instant(body, phase.position)] = std::move(x);
  return std::make_shared<const Assembly<dim>>(std::move(parts));
}

template std::vector<Vector<2>> deformed(const Mesh<2>&, const NodalField<2>&,
                                         const NodalField<2>&);
template std::vector<Vector<3>> deformed(const Mesh<3>&, const NodalField<3>&,
                                         const NodalField<3>&);
template bool have_strayed(const Assembly<2>&, const Phase<2>&, const std::vector<Vector<2>>&,
                           double);
template bool have_strayed(const Assembly<3>&, const Phase<3>&, const std::vector<Vector<3>>&,
                           double);
template std::shared_ptr<const Assembly<2>> with_facets_near(const Assembly<2>&, const Phase<2>&,
                                                             std::vector<Vector<2>>);
template std::shared_ptr<const Assembly<3>> with_facets_near(const Assembly<3>&, const Phase<3>&,
                                                             std::vector<Vector<3>>);

}  // namespace gnomon
