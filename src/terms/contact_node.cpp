#include <algorithm>
#include <gnomon/error.hpp>
#include <gnomon/terms/contact_node.hpp>
#include <map>
#include <string>

namespace gnomon {

namespace {

/// Position of `node` in the patch, appended when new.
template <int dim>
int place_in_patch(ContactPatch<dim>& patch, int node) {
  const auto found = std::find(patch.nodes.begin(), patch.nodes.end(), node);
  if (found != patch.nodes.end()) return static_cast<int>(found - patch.nodes.begin());
  patch.nodes.push_back(node);
  return static_cast<int>(patch.nodes.size()) - 1;
}

template <int dim>
typename ContactPatch<dim>::Corner make_corner(ContactPatch<dim>& patch,
                                               const typename Mesh<dim>::Facet& facet, int local) {
  typename ContactPatch<dim>::Corner corner{};
  const int count = static_cast<int>(facet.size());
  corner.nodes[0] = place_in_patch(patch, facet[local]);
  corner.nodes[1] = place_in_patch(patch, facet[(local + 1) % count]);
  if constexpr (dim == 3)
    corner.nodes[2] = place_in_patch(patch, facet[(local + count - 1) % count]);
  for (int node : facet) place_in_patch(patch, node);
  corner.sign = local == 0 ? 1 : -1;
  return corner;
}

/// The skew matrix with skew(a) w = a x w.
Tensor<3> skew(const Vector<3>& a) {
  return Tensor<3>{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
}

/// dS/dX of the corner's nodes, in the order of corner.nodes.
template <int dim>
std::array<Tensor<dim>, dim> area_vector_derivative(
    const typename ContactPatch<dim>::Corner& corner, const PatchNodal<dim>& X) {
  if constexpr (dim == 2) {
    const Tensor<2> turn = corner.sign / 2 * Tensor<2>{{0, 1}, {-1, 0}};
    return {Tensor<2>(-turn), turn};
  } else {
    const Vector<3> a = (X.row(corner.nodes[1]) - X.row(corner.nodes[0])).transpose();
    const Vector<3> b = (X.row(corner.nodes[2]) - X.row(corner.nodes[0])).transpose();
    const Tensor<3> by_a = -skew(b) / 4;
    const Tensor<3> by_b = skew(a) / 4;
    return {Tensor<3>(-by_a - by_b), by_a, by_b};
  }
}

/// dA/dX (rows) and dN/dX of every patch node.
template <int dim>
struct SurfaceDerivative {
  std::array<Vector<dim>, max_patch_nodes> area;
  std::array<Tensor<dim>, max_patch_nodes> normal;

  SurfaceDerivative(const ContactPatch<dim>& patch, const PatchNodal<dim>& X, NormalRule rule) {
    const std::size_t count = patch.nodes.size();
    for (std::size_t p = 0; p < count; ++p) area[p].setZero(), normal[p].setZero();
    Vector<dim> mean = Vector<dim>::Zero();
    for (const auto& corner : patch.corners) {
      const Vector<dim> S = corner_area_vector<dim, double>(corner, X);
      const double share = S.norm();
      const Vector<dim> N = S / share;
      const double weight = corner.initial_area / patch.initial_area;
      mean += weight * N;
      const Tensor<dim> tangential = (Tensor<dim>::Identity() - N * N.transpose()) * weight / share;
      const auto dS = area_vector_derivative<dim>(corner, X);
      for (int k = 0; k < dim; ++k) {
        area[corner.nodes[k]] += dS[k].transpose() * N;
        normal[corner.nodes[k]] += tangential * dS[k];
      }
    }
    if (rule == NormalRule::averaged) return;
    const double length = mean.norm();
    const Vector<dim> unit = mean / length;
    const Tensor<dim> project = (Tensor<dim>::Identity() - unit * unit.transpose()) / length;
    for (std::size_t p = 0; p < count; ++p) normal[p] = project * normal[p];
  }
};

}  // namespace

template <int dim>
std::vector<ContactPatch<dim>> contact_patches(
    const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets) {
  std::map<int, ContactPatch<dim>> by_node;
  for (const auto& facet : facets)
    for (std::size_t local = 0; local < facet.size(); ++local) {
      ContactPatch<dim>& patch = by_node[facet[local]];
      patch.node = facet[local];
      patch.corners.push_back(make_corner<dim>(patch, facet, static_cast<int>(local)));
    }
  std::vector<ContactPatch<dim>> patches;
  for (auto& [node, patch] : by_node) {
    if (patch.corners.size() > max_patch_facets || patch.nodes.size() > max_patch_nodes)
      throw Error("contact surface: more than " + std::to_string(max_patch_facets) +
                  " facets meet at node " + std::to_string(node));
    PatchNodal<dim> X(patch.nodes.size(), dim);
    for (std::size_t p = 0; p < patch.nodes.size(); ++p)
      X.row(static_cast<int>(p)) = mesh.nodes[patch.nodes[p]].transpose();
    for (auto& corner : patch.corners) {
      corner.initial_area = corner_area_vector<dim, double>(corner, X).norm();
      patch.initial_area += corner.initial_area;
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

template <int dim>
ContactNodeTangent<dim>::ContactNodeTangent(const ContactParameters<dim>& parameters,
                                            const ContactPatch<dim>& patch,
                                            const PatchNodal<dim>& X, const Vector<dim>& u,
                                            double lambda, Branch branch) {
  const NodalSurface<dim> surface(patch, X, parameters.normal_rule);
  const SurfaceDerivative<dim> derivative(patch, X, parameters.normal_rule);
  const Vector<dim>& n = parameters.counter_body.normal;
  const Vector<dim> x = X.row(0).transpose() + u;
  const UnilateralContact<double> contact(lambda, parameters.counter_body.gap(x), parameters.rho,
                                          branch);
  const double rate = parameters.wear.rate(contact.traction);
  const double rate_by_traction = parameters.wear.rate_by_traction();

  force_by_x = surface.area * contact.traction_by_gap * n * n.transpose();
  force_by_lambda = surface.area * contact.traction_by_lambda * n;
  constraint_by_x = contact.constraint_by_gap * n;
  constraint_by_lambda = contact.constraint_by_lambda;
  velocity_by_x = -rate_by_traction * contact.traction_by_gap * surface.normal * n.transpose();
  velocity_by_lambda = -rate_by_traction * contact.traction_by_lambda * surface.normal;
  for (std::size_t p = 0; p < patch.nodes.size(); ++p) {
    force_by_X[p] = contact.traction * n * derivative.area[p].transpose();
    velocity_by_X[p] = -rate * derivative.normal[p];
  }
}

template struct ContactNodeTangent<2>;
template struct ContactNodeTangent<3>;
template std::vector<ContactPatch<2>> contact_patches<2>(const Mesh<2>&,
                                                         const std::vector<Mesh<2>::Facet>&);
template std::vector<ContactPatch<3>> contact_patches<3>(const Mesh<3>&,
                                                         const std::vector<Mesh<3>::Facet>&);

}  // namespace gnomon
