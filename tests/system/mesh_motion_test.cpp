// The auxiliary problem alone, on columns whose solution is known; and beside a deep step of the
// surface.

#include <gnomon/mesh/grid_lines.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/terms/material_law.hpp>
#include <gnomon/terms/mesh_motion.hpp>

#include "support/derivatives.hpp"
#include "support/problem_run.hpp"
#include "support/structured_hexahedra.hpp"

namespace gnomon::mesh_motion_test {
namespace {

using namespace testing;

const ElasticModuli moduli = ElasticModuli::from_young_poisson(2, 0.3);

/// A column of n cells that grow with the height t.
template <int dim>
Mesh<dim> column_mesh(int n) {
  const std::vector<double> heights = graded_grid_lines(0.05, 0, 1, n);
  const auto height = [&](double t) { return heights[std::lround(t * n)]; };
  if constexpr (dim == 2)
    return structured_quadrilaterals(1, n,
                                     [&](double s, double t) { return Vector<2>(s, height(t)); });
  else
    return structured_hexahedra(
        1, 1, n, [&](double r, double s, double t) { return Vector<3>(r, s, height(t)); });
}

/// Its shape is held laterally and at the top; it wears at the bottom.
template <int dim>
AssemblyParts<dim> column(int n) {
  const Mesh<dim> mesh = column_mesh<dim>(n);
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  NodalFlags<dim> shape_held = NodalFlags<dim>::Ones(nodes, dim);
  shape_held.col(dim - 1).setZero();
  for (int node : mesh.boundary_nodes("top")) shape_held.row(node).setOnes();
  const Material material = make_material("neo-hookean", moduli);
  return {.mesh = mesh,
          .bodies = {{.material = material}},
          .supports = {.held = NodalFlags<dim>::Ones(nodes, dim)},
          .interface = {.surfaces = {{"bottom", mesh.boundary.at("bottom"), {}}}},
          .shape = {.held = shape_held, .law = {material}}};
}

/// The shape with which the height of each cell becomes `stretch(its height)` times its own.
template <int dim>
NodalField<dim> stretched(const Mesh<dim>& mesh, const std::function<double(double)>& stretch) {
  NodalField<dim> d = NodalField<dim>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), dim);
  for (std::size_t c = mesh.cells.size(); c-- > 0;) {  // from the top down
    const auto& cell = mesh.cells[c];
    const int lower = cell[0], upper = cell[3];
    const double bottom = mesh.nodes[lower][dim - 1];
    const double height = mesh.nodes[upper][dim - 1] - bottom;
    for (int node : cell)
      if (mesh.nodes[node][dim - 1] == bottom)
        d(node, dim - 1) = d(upper, dim - 1) + height * (1 - stretch(height));
  }
  return d;
}

template <int dim>
Eigen::VectorXd residual(const AssemblyParts<dim>& body, const NodalField<dim>& d) {
  const WornBodyEquations<dim> equations(std::make_shared<const Assembly<dim>>(body));
  const auto& composition = *equations.composition();
  const FieldId shape = equations.fields().d;
  const Numbering numbering(composition.fields, composition.stages.front());
  FieldValues<dim> values(*composition.fields);
  values.vector(shape) = d;
  std::vector<double> F(numbering.size(), 0.0);
  MeshMotion<dim>(body.mesh, nullptr, body.shape.along, body.shape.law, numbering, shape)
      .add_residual({.values = values, .ydot = {}}, F);
  return Eigen::Map<const Eigen::VectorXd>(F.data(), numbering.size());
}

template <class Dimension>
class MeshMotionOf : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(MeshMotionOf, Dimensions);

// All cells have the same stress, with every energy.
TYPED_TEST(MeshMotionOf, AColumnShrinksUniformly) {
  constexpr int dim = TypeParam::value;
  AssemblyParts<dim> body = column<dim>(5);
  for (const MaterialLaw& law : MaterialLaws::all()) {
    SCOPED_TRACE(law.name);
    body.shape.law.material = make_material(law.name, moduli);
    const auto uniform = stretched<dim>(body.mesh, [](double) { return 0.2; });
    EXPECT_LT(residual<dim>(body, uniform).norm(), 1e-12);
    const auto other = stretched<dim>(body.mesh, [](double h) { return 0.2 + 0.1 * h; });
    EXPECT_GT(residual<dim>(body, other).norm(), 1e-3);
  }
}

// With the modulus proportional to V^-c strains are proportional to V^c, as long as they are small.
TYPED_TEST(MeshMotionOf, StiffenedCellsShrinkByThePowerOfTheirVolume) {
  constexpr int dim = TypeParam::value;
  AssemblyParts<dim> body = column<dim>(5);
  for (const double exponent : {0.5, 1.0}) {
    body.shape.law.stiffening = exponent;
    const auto shape = [&](double power) {
      return stretched<dim>(body.mesh, [=](double h) { return 1 - 1e-6 * std::pow(h, power); });
    };
    const double scale = residual<dim>(body, shape(0)).norm();
    EXPECT_GT(scale, 1e-8);
    EXPECT_LT(residual<dim>(body, shape(exponent)).norm(), 1e-5 * scale);
  }
}

// Beside a punch that has worn three rows of elements away, which the energy does not change.
TEST(MeshMotion, BlatzKoKeepsElementsAtAStepFromFolding) {
  struct End {
    double quality, volume;
  };
  const auto end = [](const std::string& energy) {
    const auto model =
        model_of("flat_punch/small_block.toml",
                 {"mesh.punch_elements=10", "mesh.grading=1.2", "wear.coefficient=5e-5",
                  "shape.poisson_ratio=0.4", "shape.energy=" + energy});
    const ModelRun run = run_model(*model, "bdf", 0, 1e-4, 12);
    return End{observed(*model, run.last(), "element_quality"),
               observed(*model, run.last(), "worn_volume")};
  };
  const End by_paper = end("neo-hookean"), blatz_ko = end("blatz-ko");
  EXPECT_GT(blatz_ko.quality, 1.3 * by_paper.quality);
  EXPECT_NEAR(blatz_ko.volume, by_paper.volume, 1e-6);
}

}  // namespace
}  // namespace gnomon::mesh_motion_test
