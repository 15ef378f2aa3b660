// The patch test: on a distorted mesh whose boundary is displaced linearly, the nodes inside
// follow.

#include <gnomon/mesh/distortion.hpp>
#include <gnomon/terms/cell_assembly.hpp>
#include <gnomon/terms/material_law.hpp>

#include "support/derivatives.hpp"
#include "support/structured_hexahedra.hpp"

namespace gnomon::patch_test {
namespace {

using namespace testing;

template <int dim>
Mesh<dim> distorted_mesh() {
  Mesh<dim> mesh;
  if constexpr (dim == 2)
    mesh = structured_quadrilaterals(5, 4, [](double s, double t) { return Vector<2>(s, t); });
  else
    mesh = structured_hexahedra(4, 3, 3,
                                [](double r, double s, double t) { return Vector<3>(r, s, t); });
  distort(mesh, 0.2);
  return mesh;
}

/// Largest distance of the nodes inside, in equilibrium, from the linear field of the boundary.
template <int dim>
double patch_error(const std::string& law, const Element& element) {
  const Mesh<dim> mesh = distorted_mesh<dim>();
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  const Tensor<dim> H = noise<Tensor<dim>>(0.03, 3);
  NodalField<dim> linear(nodes, dim);
  for (Eigen::Index node = 0; node < nodes; ++node)
    linear.row(node) = (H * mesh.nodes[node]).transpose();
  NodalField<dim> u = linear;
  NodalNumbers<dim> numbers = NodalNumbers<dim>::Zero(nodes, dim);
  for (const auto& [name, part] : mesh.boundary)
    for (int node : mesh.boundary_nodes(name)) numbers.row(node).setConstant(-1);
  int size = 0;
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    if (numbers.data()[k] < 0) continue;
    numbers.data()[k] = size++;
    u.data()[k] = 0;  // unknown
  }

  const Material material = make_material(law, ElasticModuli::from_young_poisson(7, 0.3));
  CellAssembly<dim> cells(mesh, {{.material = material, .element = element}}, numbers, numbers);
  PatternBuilder builder(size);
  cells.add_to_pattern(builder);
  const SparsePattern pattern = builder.build();
  cells.map_to(pattern);
  for (int iteration = 0; iteration < 8; ++iteration) {
    std::vector<double> F(size), values(pattern.nonzeros());
    cells.add_residual(nullptr, u, F);
    cells.add_jacobian(nullptr, u, values);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(size, size);
    for (int j = 0; j < size; ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        J(pattern.row_index[k], j) = values[k];
    const Eigen::VectorXd step =
        J.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(F.data(), size));
    for (Eigen::Index k = 0; k < u.size(); ++k)
      if (numbers.data()[k] >= 0) u.data()[k] -= step[numbers.data()[k]];
  }
  return (u - linear).cwiseAbs().maxCoeff();
}

TEST(Patch, ALinearFieldIsReproducedOnDistortedMeshes) {
  for (const std::string& law : MaterialLaws::names())
    for (const Kinematics kinematics : {Kinematics::finite, Kinematics::small}) {
      SCOPED_TRACE(law);
      for (const auto technology : {ElementTechnology::plain, ElementTechnology::f_bar}) {
        EXPECT_LT(patch_error<2>(law, {technology, kinematics}), 1e-13);
        EXPECT_LT(patch_error<3>(law, {technology, kinematics}), 1e-13);
      }
      EXPECT_LT(patch_error<2>(law, {ElementTechnology::f_bar_variational, kinematics}), 1e-13);
    }
}

// The gradient at the centroid of a distorted hexahedron is not the mean gradient.
TEST(Patch, VariationalFBarHexahedraFail) {
  for (const Kinematics kinematics : {Kinematics::finite, Kinematics::small})
    EXPECT_GT(patch_error<3>("neo-hookean", {ElementTechnology::f_bar_variational, kinematics}),
              1e-5);
}

}  // namespace
}  // namespace gnomon::patch_test
