// Patch tests under equal pressure on all sides: interfaces that are inclined or curved carry it.

#include <cmath>

#include "support/problem_run.hpp"
#include "support/two_bodies.hpp"

namespace gnomon::pair_patch_test {
namespace {

using namespace testing;

constexpr double pressure = 10;

/// Nothing but three points of the lower body and what contact leaves free of the upper one is
/// held, all at the left end of the interface, about which both bodies shrink.
template <int dim>
AssemblyParts<dim> under_pressure(TwoBodies pair) {
  pair.kinematics = Kinematics::small;
  AssemblyParts<dim> parts = two_bodies<dim>(pair);
  NodalFlags<dim>& held = parts.supports.held;
  held.setZero();
  const auto hold = [&](double x, double y, bool upper, std::initializer_list<int> directions) {
    const std::size_t nodes = block_of<dim>(pair, true).nodes.size();
    for (std::size_t node = upper ? 0 : nodes; node < (upper ? nodes : parts.mesh.nodes.size());
         ++node) {
      const Vector<dim>& at = parts.mesh.nodes[node];
      if (std::abs(at[0] - x) > 1e-9 || std::abs(at[dim - 1] - y) > 1e-9) continue;
      if (dim == 3) held(static_cast<Eigen::Index>(node), 1) = at[1] == 0;
      for (const int i : directions) held(static_cast<Eigen::Index>(node), i) = 1;
    }
  };
  const double left = pair.upper.surface(0);
  hold(0, left, false, {0, dim - 1});
  hold(0, -pair.lower.size, false, {0});
  hold(0, left, true, {0});
  hold(0, pair.upper.size, true, {});
  parts.pairs.front().along.clear();
  parts.loads.clear();
  for (const auto& [name, facets] : parts.mesh.boundary)
    if (name != "bottom" && name != "lower top")
      parts.loads.push_back({.facets = facets, .pressure = pressure});
  return parts;
}

/// The largest deviation of a pressure of the slave. Loads act on the deformed area, pressures are
/// by the undeformed one.
template <int dim>
double deviation(const TwoBodies& pair) {
  const WearModel<dim> model(under_pressure<dim>(pair));
  Counters counters;
  const ContactSurface surface = model.contact(model.start(counters)).value();
  const double compressibility = (1 - 2 * pair.upper.poisson_ratio) *
                                 (dim == 2 ? 1 + pair.upper.poisson_ratio : 1) /
                                 pair.upper.young_modulus;
  double expected = pressure;
  for (int k = 0; k < 20; ++k)
    expected = pressure * std::pow(1 - compressibility * expected, dim - 1);
  double most = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c)
    if (model.assembly().carries[c])
      most = std::max(most, std::abs(surface.pressure[c] / expected - 1));
  return most;
}

TwoBodies blocks(int above, int below, const std::function<double(double)>& surface) {
  return {.upper = {.along = above, .high = above, .across = above, .surface = surface},
          .lower = {.along = below, .high = below, .across = below, .surface = surface}};
}

TEST(PairPatch, UniformPressurePassesInclinedInterfaces) {
  const auto inclined = [](double x) { return 0.3 * x; };
  for (const auto& [above, below] : {std::pair{4, 4}, {2, 6}, {6, 2}, {4, 6}, {5, 7}}) {
    SCOPED_TRACE(::testing::Message() << above << ":" << below);
    EXPECT_LT(deviation<2>(blocks(above, below, inclined)), 1e-10);
  }
  for (const auto& [above, below] : {std::pair{2, 2}, {2, 3}, {3, 2}, {1, 3}, {3, 1}}) {
    SCOPED_TRACE(::testing::Message() << above << ":" << below << " in space");
    EXPECT_LT(deviation<3>(blocks(above, below, inclined)), 1e-10);
  }
}

// Facets of unlike meshes leave gaps of the curvature times h^2, over which elements of h lie.
TEST(PairPatch, CurvedInterfacesAreOfSecondOrderWithEqualMeshesAndOfFirstWithOthers) {
  const auto curved = [](double x) { return 0.1 * x * x; };
  const auto ratio = [&](int above, int below) {
    const double coarse = deviation<2>(blocks(above, below, curved));
    EXPECT_GT(coarse, 1e-4);
    EXPECT_LT(coarse, 1e-2);
    return coarse / deviation<2>(blocks(2 * above, 2 * below, curved));
  };
  EXPECT_GT(ratio(8, 8), 3.4);
  EXPECT_GT(ratio(8, 12), 1.9);
}

}  // namespace
}  // namespace gnomon::pair_patch_test
