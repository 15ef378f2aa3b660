// Elastic bodies of revolution against closed forms: homogeneous states, thick cylinders, and
// nearly incompressible ones.

#include <fmt/format.h>

#include <gnomon/mesh/distortion.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/terms/material_law.hpp>

#include "support/derivatives.hpp"
#include "support/static_solve.hpp"

namespace gnomon::meridian_test {
namespace {

using namespace testing;

constexpr std::array technologies = {ElementTechnology::plain, ElementTechnology::f_bar,
                                     ElementTechnology::f_bar_variational};

Element revolved(ElementTechnology technology, Kinematics kinematics) {
  return {technology, kinematics, Section::meridian};
}

/// A ring, distorted inside.
Mesh<2> ring(int n, double inner, double outer, double distortion) {
  Mesh<2> mesh = structured_quadrilaterals(
      n, n, [&](double s, double t) { return Vector<2>(inner + (outer - inner) * s, t); });
  distort(mesh, distortion);
  return mesh;
}

/// Largest distance of the nodes inside, in equilibrium, from u = (a r, b + c z) of the boundary.
double patch_error(const std::string& law, const Element& element, double inner) {
  const Mesh<2> mesh = ring(4, inner, inner + 1, 0.2);
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  NodalField<2> linear(nodes, 2);
  for (Eigen::Index k = 0; k < nodes; ++k)
    linear.row(k) << 0.04 * mesh.nodes[k][0], 0.01 - 0.03 * mesh.nodes[k][1];
  NodalField<2> u = NodalField<2>::Zero(nodes, 2);
  NodalFlags<2> held = NodalFlags<2>::Zero(nodes, 2);
  for (const auto& [name, part] : mesh.boundary)
    for (int node : mesh.boundary_nodes(name))
      held.row(node).setOnes(), u.row(node) = linear.row(node);
  solve_statically<2>(mesh, make_material(law, ElasticModuli::from_young_poisson(7, 0.3)), element,
                      held, NodalField<2>::Zero(nodes, 2), u);
  return (u - linear).cwiseAbs().maxCoeff();
}

TEST(MeridianPatch, HomogeneousStatesAreExactOnDistortedMeshes) {
  for (const std::string& law : MaterialLaws::names())
    for (const Kinematics kinematics : {Kinematics::finite, Kinematics::small})
      for (const auto technology : technologies)
        for (const double inner : {0.0, 0.7})
          EXPECT_LT(patch_error(law, revolved(technology, kinematics), inner), 1e-13)
              << law << " " << technology_names[static_cast<std::size_t>(technology)] << " "
              << inner;
}

/// Lame: a cylinder from r = 1 to 2, of constant length, under the pressure 1 from inside, with
/// small strains. Error of u_r (root of the mean square over the nodes) relative to u_r at r = 1.
double lame_error(ElementTechnology technology, double poisson, int n, double distortion) {
  constexpr double a = 1, b = 2, E = 10;
  const Mesh<2> mesh = ring(n, a, b, distortion);
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  NodalField<2> u = NodalField<2>::Zero(nodes, 2);
  NodalFlags<2> held = NodalFlags<2>::Zero(nodes, 2);
  for (const char* end : {"bottom", "top"})
    for (int node : mesh.boundary_nodes(end)) held(node, 1) = 1;
  const double area = 2 * M_PI * a;  // times the length 1
  const NodalField<2> load = uniform_load(mesh, "left", Vector<2>(area, 0), Section::meridian);
  solve_statically<2>(mesh,
                      make_material("neo-hookean", ElasticModuli::from_young_poisson(E, poisson)),
                      revolved(technology, Kinematics::small), held, load, u);
  const auto exact = [&](double r) {
    return (1 + poisson) * a * a / (E * (b * b - a * a)) * ((1 - 2 * poisson) * r + b * b / r);
  };
  double squares = 0;
  for (Eigen::Index k = 0; k < nodes; ++k)
    squares += std::pow(u(k, 0) - exact(mesh.nodes[k][0]), 2);
  return std::sqrt(squares / static_cast<double>(nodes)) / exact(a);
}

TEST(MeridianCylinder, ConvergesToLame) {
  for (const auto technology : technologies)
    for (const double distortion : {0.0, 0.15}) {
      const double coarse = lame_error(technology, 0.3, 8, distortion),
                   fine = lame_error(technology, 0.3, 16, distortion),
                   finest = lame_error(technology, 0.3, 32, distortion);
      SCOPED_TRACE(fmt::format("{} {} {} {} {}",
                               technology_names[static_cast<std::size_t>(technology)], distortion,
                               coarse, fine, finest));
      EXPECT_GT(finest, 1e-6);
      EXPECT_LT(finest, 2e-4);
      EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
      EXPECT_NEAR(std::log2(fine / finest), 2, 0.1);
    }
}

// F-bar with the mean change of volume does not lock; the plain element does.
TEST(MeridianCylinder, FBarDoesNotLock) {
  for (const double distortion : {0.0, 0.15}) {
    EXPECT_GT(lame_error(ElementTechnology::plain, 0.4999, 8, distortion), 0.5);
    for (const auto technology : {ElementTechnology::f_bar, ElementTechnology::f_bar_variational})
      EXPECT_LT(lame_error(technology, 0.4999, 8, distortion), 0.01);
  }
}

// The weight of a ring, and its pressure on the ground, are those of its whole revolution.
TEST(MeridianLoads, AreThoseOfTheWholeRevolution) {
  const Mesh<2> mesh = ring(5, 0.5, 2, 0.2);
  const double volume = M_PI * (4 - 0.25);  // height 1
  const NodalField<2> weight = volume_load<2>(mesh, Vector<2>(0, -3), Section::meridian);
  EXPECT_NEAR(weight.col(1).sum(), -3 * volume, 1e-12);
  EXPECT_NEAR(volume_load<2>(mesh, Vector<2>(0, -3)).col(1).sum(), -3 * 1.5, 1e-12);
  // On a face at constant z, loads of constant traction are those of constant pressure: without
  // other forces they give a homogeneous state.
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  const NodalField<2> load = uniform_load(mesh, "top", Vector<2>(0, -volume), Section::meridian);
  EXPECT_NEAR(load.col(1).sum(), -volume, 1e-13);
  NodalFlags<2> held = NodalFlags<2>::Zero(nodes, 2);
  for (int node : mesh.boundary_nodes("bottom")) held(node, 1) = 1;
  NodalField<2> u = NodalField<2>::Zero(nodes, 2);
  const Element element = revolved(ElementTechnology::f_bar, Kinematics::small);
  solve_statically<2>(mesh, make_material("neo-hookean", ElasticModuli::from_young_poisson(7, 0.3)),
                      element, held, load, u);
  for (Eigen::Index k = 0; k < nodes; ++k) {
    EXPECT_NEAR(u(k, 1), -mesh.nodes[k][1] / 7, 1e-13);
    EXPECT_NEAR(u(k, 0), 0.3 * mesh.nodes[k][0] / 7, 1e-13);
  }
}

}  // namespace
}  // namespace gnomon::meridian_test
