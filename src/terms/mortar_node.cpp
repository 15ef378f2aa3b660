#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/mesh/corner_derivatives.hpp>
#include <gnomon/terms/mortar_node.hpp>
#include <gnomon/terms/surface_derivative.hpp>
#include <unsupported/Eigen/AutoDiff>

namespace gnomon {

template <int dim>
NodeNormal<dim>::NodeNormal(const ContactPatch<dim>& patch, const PatchNodal<dim>& x,
                            const Tensor<dim>& along)
    : by_x(patch.nodes.size(), Tensor<dim>::Zero()) {
  Vector<dim> sum = Vector<dim>::Zero();
  for (const auto& corner : patch.corners) {
    sum += corner_area_vector<dim, double>(corner, x);
    const auto by = area_vector_derivative<dim>(corner, x);
    for (int k = 0; k < dim; ++k)
      by_x[static_cast<std::size_t>(corner.nodes[static_cast<std::size_t>(k)])] += by[k];
  }
  sum = along * sum;
  const double length = sum.norm();
  if (!(length > 0))
    throw RecoverableError(
        fmt::format("contact node {}: the facets around it have no common normal", patch.node));
  value = sum / length;
  const Tensor<dim> project =
      (Tensor<dim>::Identity() - value * value.transpose()) / length * along;
  for (Tensor<dim>& by : by_x) by = project * by;
}

template <int dim>
SlidingTraction<dim>::SlidingTraction(const ContactPatch<dim>& patch, const Vector<dim>& n,
                                      const Vector<dim>& x, const RigidMotion<dim>& motion,
                                      double friction) {
  using Number = Eigen::AutoDiffScalar<Eigen::Matrix<double, 2 * dim, 1>>;
  Vector<dim, Number> normal, place;
  for (int i = 0; i < dim; ++i) {
    normal[i] = Number(
        -n[i], Eigen::Matrix<double, 2 * dim, 1>(-Eigen::Matrix<double, 2 * dim, 1>::Unit(i)));
    place[i] = Number(x[i], 2 * dim, dim + i);
  }
  const Vector<dim, Number> relative = -motion.at(place);
  const Sliding<dim, Number> sliding(
      relative, normal, motion.across_at(place),
      velocity_variance<dim>(patch, motion.spin, motion.across_by_x));
  const auto derivatives = [](const Number& of) -> Eigen::Matrix<double, 1, 2 * dim> {
    return of.derivatives().transpose();
  };
  for (int i = 0; i < dim; ++i) {
    Number component = normal[i];
    if (friction != 0 && sliding.speed.value() > 0)
      component -= Number(friction) * sliding.direction[i];
    direction[i] = component.value();
    direction_by.row(i) = derivatives(component);
  }
  speed = sliding.speed.value();
  speed_by.setZero();
  if (speed > 0) speed_by = derivatives(sliding.speed);
}

template <int dim>
WearDirection<dim>::WearDirection(const ContactPatch<dim>& patch, const PatchNodal<dim>& X,
                                  NormalRule rule)
    : by_X(patch.nodes.size()) {
  const NodalSurface<dim> surface(patch, X, rule);
  const SurfaceDerivative<dim> derivative(patch, X, rule);
  const Tensor<dim> free = patch.shape_free / surface.area;
  value = free * surface.normal;
  for (std::size_t p = 0; p < by_X.size(); ++p)
    by_X[p] = free * derivative.normal[p] - value / surface.area * derivative.area[p].transpose();
}

template struct NodeNormal<2>;
template struct NodeNormal<3>;
template struct SlidingTraction<2>;
template struct SlidingTraction<3>;
template struct WearDirection<2>;
template struct WearDirection<3>;

}  // namespace gnomon
