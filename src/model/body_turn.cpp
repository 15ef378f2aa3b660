#include "model/body_turn.hpp"

#include "model/connected_parts.hpp"

namespace gnomon {

namespace {

/// The angle of the rigid motion nearest to displacements u of nodes: J w = sum r x u, where J is
/// their tensor of inertia.
template <int dim>
double angle_of(const std::vector<std::size_t>& nodes, const std::vector<Vector<dim>>& X,
                const NodalField<dim>& u) {
  Vector<dim> middle = Vector<dim>::Zero();
  for (const std::size_t node : nodes) middle += X[node] / static_cast<double>(nodes.size());
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const std::size_t node : nodes) {
    Eigen::Vector3d r = Eigen::Vector3d::Zero(), v = r;
    r.head<dim>() = X[node] - middle;
    v.head<dim>() = u.row(static_cast<Eigen::Index>(node)).transpose();
    moment += r.cross(v);
    inertia += r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose();
  }
  if (dim == 2) return std::abs(moment[2] / inertia(2, 2));
  return inertia.ldlt().solve(moment).norm();
}

}  // namespace

template <int dim>
std::optional<BodyTurn> find_body_turn(const WornBodyEquations<dim>& equations,
                                       const FieldValues<dim>& values) {
  const Assembly<dim>& assembly = equations.assembly();
  const std::vector<int> body_of = body_of_nodes(assembly.mesh, assembly.body_of);
  std::optional<BodyTurn> most;
  for (std::size_t body = 0; body < assembly.bodies.size(); ++body) {
    if (assembly.bodies[body].element.kinematics != Kinematics::small) continue;
    std::vector<std::size_t> nodes;
    for (std::size_t node = 0; node < body_of.size(); ++node)
      if (body_of[node] == static_cast<int>(body)) nodes.push_back(node);
    for (std::size_t p = 0; p < equations.phases().size(); ++p) {
      const double angle =
          angle_of<dim>(nodes, assembly.mesh.nodes, values.vector(equations.fields(p).u));
      if (!most || angle > most->angle) most = BodyTurn{assembly.bodies[body].name, angle};
    }
  }
  return most;
}

template std::optional<BodyTurn> find_body_turn(const WornBodyEquations<2>&, const FieldValues<2>&);
template std::optional<BodyTurn> find_body_turn(const WornBodyEquations<3>&, const FieldValues<3>&);

}  // namespace gnomon
