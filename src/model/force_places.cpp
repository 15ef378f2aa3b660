#include "model/force_places.hpp"

#include <array>
#include <cmath>
#include <gnomon/shapes/counter_surface.hpp>
#include <map>
#include <set>

#include "model/connected_parts.hpp"

namespace gnomon {

template <int dim>
std::vector<int> undeformed_parts(const Assembly<dim>& assembly) {
  std::vector<int> part_of = connected_parts(assembly.mesh);
  std::set<int> small;
  for (std::size_t cell = 0; cell < assembly.body_of.size(); ++cell) {
    const Body& body = assembly.bodies[static_cast<std::size_t>(assembly.body_of[cell])];
    if (body.element.kinematics == Kinematics::small)
      small.insert(part_of[static_cast<std::size_t>(assembly.mesh.cells[cell].front())]);
  }
  for (int& part : part_of)
    if (!small.contains(part)) part = -1;
  return part_of;
}

namespace {

/// u, and of nodes of undeformed parts the travel of their part: in each direction the mean of u
/// over the nodes that supports hold in it, else over those that may touch, else over all. Less
/// than a thousandth of the size of the bodies is deformation, which small strains leave out.
template <int dim>
NodalField<dim> travels(NodalField<dim> u, const std::vector<int>& part_of,
                        const Assembly<dim>& assembly) {
  struct Mean {
    int rank = -1;
    double count = 0, sum = 0;
  };
  std::vector<char> touches(part_of.size(), 0);
  for (const auto& patch : assembly.contact_nodes) touches[patch.node] = 1;
  std::map<int, std::array<Mean, dim>> means;  // by part and direction
  const auto each = [&](const auto& visit) {
    for (Eigen::Index node = 0; node < u.rows(); ++node)
      if (const int part = part_of[static_cast<std::size_t>(node)]; part >= 0)
        for (int i = 0; i < dim; ++i) visit(node, i, means[part][static_cast<std::size_t>(i)]);
  };
  each([&](Eigen::Index node, int i, Mean& mean) {
    const int rank = assembly.supports.held(node, i) ? 2 : touches[static_cast<std::size_t>(node)];
    if (rank > mean.rank) mean = {rank};
    if (rank < mean.rank) return;
    mean.count += 1;
    mean.sum += u(node, i);
  });
  const double least = 1e-3 * Box<dim>::around(assembly.mesh.nodes).diagonal();
  each([&](Eigen::Index node, int i, const Mean& mean) {
    const double travel = mean.sum / mean.count;
    u(node, i) = std::abs(travel) > least ? travel : 0;
  });
  return u;
}

}  // namespace

template <int dim>
NodalField<dim> places_of(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
                          const WornBodyFields& fields, const std::vector<int>& undeformed) {
  NodalField<dim> places = equations.shape_of_cells(values) +
                           travels<dim>(values.vector(fields.u), undeformed, equations.assembly());
  for (Eigen::Index node = 0; node < places.rows(); ++node)
    places.row(node) += equations.assembly().mesh.nodes[static_cast<std::size_t>(node)].transpose();
  return places;
}

template std::vector<int> undeformed_parts(const Assembly<2>&);
template std::vector<int> undeformed_parts(const Assembly<3>&);
template NodalField<2> places_of(const WornBodyEquations<2>&, const FieldValues<2>&,
                                 const WornBodyFields&, const std::vector<int>&);
template NodalField<3> places_of(const WornBodyEquations<3>&, const FieldValues<3>&,
                                 const WornBodyFields&, const std::vector<int>&);

}  // namespace gnomon
