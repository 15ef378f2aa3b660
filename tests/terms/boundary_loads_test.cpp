// Pressure that follows the surface, and springs under it.

#include <gnomon/system/composed_system.hpp>
#include <gnomon/terms/pressure_load.hpp>
#include <gnomon/terms/solid.hpp>
#include <gnomon/terms/springs.hpp>
#include <random>

#include "support/derivatives.hpp"
#include "support/problem_run.hpp"
#include "support/structured_hexahedra.hpp"

namespace gnomon::boundary_loads_test {
namespace {

using namespace testing;

/// Displacement and shape at all nodes, both unknown and nothing else.
template <int dim>
std::shared_ptr<Composition<dim>> free_nodes(const Mesh<dim>& mesh) {
  auto fields = std::make_shared<FieldSet>();
  fields->nodes = static_cast<int>(mesh.nodes.size());
  std::vector<int> nodes(mesh.nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = static_cast<int>(k);
  for (const char* name : {"displacement", "shape"}) {
    const int block = fields->add(Block{name, name, "all nodes", Role::stiffness});
    Field field(name, nodes, dim);
    field.block.setConstant(block);
    fields->add(field);
  }
  auto composition = std::make_shared<Composition<dim>>();
  composition->fields = fields;
  composition->position.resize(mesh.nodes.size());
  return composition;
}

constexpr FieldId u{0}, d{1};

/// y in every row, so that none of J is empty.
template <int dim>
class Ground : public Term<dim> {
public:
  explicit Ground(const Numbering& numbering) : numbering_(numbering) {}
  void declare(TermStructure& structure) const override {
    for (int row = 0; row < numbering_.size(); ++row) structure.pattern.add({row}, {row});
  }
  void map_to(const SparsePattern& pattern) override {
    for (int row = 0; row < numbering_.size(); ++row) diagonal_.push_back(pattern.find(row, row));
  }
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    std::vector<double> y(F.size());
    numbering_.gather(at.values, y);
    for (std::size_t row = 0; row < y.size(); ++row) F[row] += y[row];
  }
  void add_jacobian(const Evaluation<dim>&, double, std::span<double> values) const override {
    for (int position : diagonal_) values[position] += 1;
  }
  void switching(const Evaluation<dim>&, std::span<double>) const override {}

private:
  const Numbering& numbering_;
  std::vector<int> diagonal_;
};

template <int dim>
void ground(Composition<dim>& composition) {
  composition.terms.push_back(
      [](const Numbering& numbering) { return std::make_unique<Ground<dim>>(numbering); });
}

template <int dim>
Mesh<dim> block() {
  if constexpr (dim == 2)
    return structured_quadrilaterals(
        3, 2, [](double s, double t) { return Vector<2>(2 * s, t + 0.1 * std::sin(3 * s)); });
  else
    return structured_hexahedra(2, 2, 2, [](double r, double s, double t) {
      return Vector<3>(2 * r, s + 0.1 * r * t, t + 0.1 * std::sin(3 * s));
    });
}

/// The section of a ring.
Mesh<2> ring() {
  Mesh<2> mesh = block<2>();
  for (Vector<2>& X : mesh.nodes) X[0] += 0.5;
  return mesh;
}

std::vector<double> rough(long size) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  std::vector<double> y(static_cast<std::size_t>(size));
  for (double& value : y) value = uniform(generator);
  return y;
}

template <int dim>
std::vector<typename Mesh<dim>::Facet> whole_boundary(const Mesh<dim>& mesh) {
  std::vector<typename Mesh<dim>::Facet> facets;
  for (const auto& [name, part] : mesh.boundary)
    facets.insert(facets.end(), part.begin(), part.end());
  return facets;
}

template <int dim>
ComposedSystem<dim> under_pressure(const Mesh<dim>& mesh,
                                   const std::vector<typename Mesh<dim>::Facet>& facets,
                                   LoadHistory history = {}, bool grounded = false,
                                   Section section = Section::plane) {
  auto composition = free_nodes(mesh);
  if (grounded) ground<dim>(*composition);
  composition->terms.push_back([&mesh, facets, history, section](const Numbering& numbering) {
    return std::make_unique<PressureLoad<dim>>(mesh, facets, 3.0, history, numbering, u, d,
                                               section);
  });
  return ComposedSystem<dim>(composition);
}

template <int dim>
double volume(const Mesh<dim>& mesh, const FieldValues<dim>& values, Section section) {
  double sum = 0;
  for (const auto& cell : mesh.cells) {
    CellNodal<dim> x = mesh.positions(cell);
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a)
      x.row(a) += values.vector(u).row(cell[a]) + values.vector(d).row(cell[a]);
    sum += cell_volume<dim>(x, section);
  }
  return sum;
}

// A uniform pressure all around does the work p dV, whatever the deformation.
template <int dim>
void check_work(const Mesh<dim>& mesh, Section section = Section::plane) {
  const ComposedSystem<dim> system =
      under_pressure<dim>(mesh, whole_boundary(mesh), {}, false, section);
  std::vector<double> y = rough(system.structure().size), F(y.size());
  system.residual({.y = y}, F);
  double largest = 0;
  for (std::size_t k = 0; k < y.size(); k += 5) {
    const double step = 1e-5, before = y[k];
    y[k] = before + step;
    const double after = volume(mesh, system.values(0, y), section);
    y[k] = before - step;
    const double change = (after - volume(mesh, system.values(0, y), section)) / (2 * step);
    y[k] = before;
    // Rows of d have no equation here; u and d move the surface alike.
    const bool of_u = system.structure().block[k] == 0;
    if (of_u)
      EXPECT_NEAR(F[k], 3 * change, 1e-8);
    else
      EXPECT_EQ(F[k], 0);
    largest = std::max(largest, std::abs(F[k]));
  }
  EXPECT_GT(largest, 0.1);
}

TEST(PressureLoad, WorksOnTheVolume) {
  check_work<2>(block<2>());
  check_work<3>(block<3>());
  check_work<2>(ring(), Section::meridian);
}

TEST(PressureLoad, JacobianEqualsCentralDifferences) {
  const Mesh<2> plane = block<2>();
  const ComposedSystem<2> in_plane = under_pressure<2>(plane, plane.boundary.at("top"), {}, true);
  check_jacobian(in_plane, 0, rough(in_plane.structure().size), 0.2);
  const Mesh<2> section = ring();
  const ComposedSystem<2> revolved =
      under_pressure<2>(section, section.boundary.at("top"), {}, true, Section::meridian);
  check_jacobian(revolved, 0, rough(revolved.structure().size), 0.2);
  const Mesh<3> solid = block<3>();
  const ComposedSystem<3> in_space = under_pressure<3>(solid, solid.boundary.at("top"), {}, true);
  check_jacobian(in_space, 0, rough(in_space.structure().size), 0.2);
}

TEST(PressureLoad, FollowsItsHistory) {
  const Mesh<2> mesh = block<2>();
  const ComposedSystem<2> system =
      under_pressure<2>(mesh, mesh.boundary.at("top"), LoadHistory({0, 10}, {0, 1}));
  const std::vector<double> y = rough(system.structure().size);
  std::vector<double> half(y.size()), full(y.size());
  system.residual({.t = 5, .y = y}, half);
  system.residual({.t = 20, .y = y}, full);
  for (std::size_t k = 0; k < y.size(); ++k) EXPECT_NEAR(2 * half[k], full[k], 1e-14);
  EXPECT_EQ(system.structure().breakpoints, (std::vector<double>{0, 10}));
}

TEST(Springs, CarryByTheirArea) {
  const Mesh<3> mesh = block<3>();
  auto composition = free_nodes(mesh);
  composition->terms.push_back([&mesh](const Numbering& numbering) {
    return std::make_unique<Springs<3>>(mesh, mesh.boundary.at("left"), Vector<3>(0, 7, 0),
                                        numbering, u);
  });
  const ComposedSystem<3> system(composition);
  std::vector<double> y(static_cast<std::size_t>(system.structure().size)), F(y.size());
  for (std::size_t k = 0; k < y.size(); ++k)
    if (system.structure().block[k] == 0) y[k] = 0.1;
  system.residual({.y = y}, F);
  double area = 0, force = 0;
  for (const auto& patch : contact_patches<3>(mesh, mesh.boundary.at("left")))
    area += patch.initial_area;
  for (double f : F) force += f;
  EXPECT_NEAR(force, 7 * 0.1 * area, 1e-13);
  ground<3>(*composition);
  const ComposedSystem<3> grounded(composition);
  check_jacobian(grounded, 0, rough(grounded.structure().size), 0.2);
}

TEST(Springs, CarryByTheAreaOfTheRevolution) {
  const Mesh<2> mesh = ring();
  auto composition = free_nodes(mesh);
  composition->terms.push_back([&mesh](const Numbering& numbering) {
    return std::make_unique<Springs<2>>(mesh, mesh.boundary.at("right"), Vector<2>(0, 7), numbering,
                                        u, Section::meridian);
  });
  const ComposedSystem<2> system(composition);
  std::vector<double> y(static_cast<std::size_t>(system.structure().size)), F(y.size());
  for (std::size_t k = 0; k < y.size(); ++k)
    if (system.structure().block[k] == 0) y[k] = 0.1;
  system.residual({.y = y}, F);
  double force = 0;
  for (double f : F) force += f;
  EXPECT_NEAR(force, 7 * 0.1 * 2 * M_PI * 2.5, 1e-12);  // a cylinder of radius 2.5 and height 1
}

// Held values move with their history, at every evaluation and in the values of all fields.
TEST(PrescribedValues, FollowTheirHistory) {
  const Mesh<2> mesh = block<2>();
  auto composition = free_nodes(mesh);
  auto fields = std::make_shared<FieldSet>(*composition->fields);
  (*fields)[u].block(0, 1) = -1;
  composition->fields = fields;
  composition->prescribed.push_back({u, {{0, 1, 0.5}}, LoadHistory({0, 10}, {0, 1})});
  ComposedSystem<2> system(composition);
  const std::vector<double> y(static_cast<std::size_t>(system.structure().size));
  EXPECT_EQ(system.structure().size, 4 * static_cast<long>(mesh.nodes.size()) - 1);
  EXPECT_DOUBLE_EQ(system.values(4, y).vector(u)(0, 1), 0.2);
  EXPECT_DOUBLE_EQ(system.values(20, y).vector(u)(0, 1), 0.5);
  system.set_load_fraction(0.5);
  EXPECT_DOUBLE_EQ(system.values(20, y).vector(u)(0, 1), 0.25);
  EXPECT_EQ(system.structure().breakpoints, (std::vector<double>{0, 10}));
}

}  // namespace
}  // namespace gnomon::boundary_loads_test
