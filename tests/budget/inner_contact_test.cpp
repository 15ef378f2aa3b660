// Where pressures are compared: inside of every patch of the contact.

#include "budget/inner_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace gnomon::budget {
namespace {

/// A line of nodes along x, at distances of 1; each moves by 0.1 along x but those of `held`.
struct Line {
  explicit Line(const std::vector<double>& pressure, const std::vector<std::size_t>& held = {}) {
    surface.pressure = pressure;
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      const double x = static_cast<double>(i);
      const bool moves = std::ranges::find(held, i) == held.end();
      surface.initial.push_back({x, 0, 0});
      surface.current.push_back({x + (moves ? 0.1 : 0), -0.2, 0});
      auto& others = neighbours.emplace_back();
      if (i > 0) others.push_back(i - 1);
      if (i + 1 < pressure.size()) others.push_back(i + 1);
    }
  }
  std::vector<std::size_t> inner() const { return inner_nodes(surface, neighbours); }

  ContactSurface surface;
  std::vector<std::vector<std::size_t>> neighbours;
};

std::vector<std::size_t> range(std::size_t first, std::size_t end) {
  std::vector<std::size_t> nodes;
  for (; first < end; ++first) nodes.push_back(first);
  return nodes;
}

std::vector<double> ones(std::size_t count) {
  return std::vector<double>(count, 1.0);
}

TEST(InnerContact, IsNineTenthsOfItsHalfWidth) {
  EXPECT_EQ(Line(ones(41)).inner(), range(2, 39));  // half width 20
}

TEST(InnerContact, OfSeveralPatchesIsTheInsideOfEach) {
  std::vector<double> pressure = ones(21 + 2 + 41);
  pressure[21] = pressure[22] = 0;
  std::vector<std::size_t> expected = range(1, 20), second = range(25, 62);
  expected.insert(expected.end(), second.begin(), second.end());
  EXPECT_EQ(Line(pressure).inner(), expected);
  Line unknown(pressure);
  unknown.neighbours.clear();  // one patch, with the edges between
  EXPECT_EQ(unknown.inner().front(), 4u);
}

TEST(InnerContact, LeavesOutTheLastTwoNodesWhereOthersRemain) {
  std::vector<double> pressure = ones(11);
  const auto inside = [&] {
    const Line line(pressure);
    return without_edges(line.surface, line.neighbours, line.inner());
  };
  EXPECT_EQ(inside(), range(1, 10));  // no node is without pressure
  pressure[0] = pressure[10] = 0;
  EXPECT_EQ(inside(), range(3, 8));
  pressure[1] = pressure[9] = 0;
  EXPECT_EQ(inside(), range(4, 7));  // of 2 to 8
  pressure[2] = pressure[8] = 0;
  EXPECT_EQ(inside(), range(4, 7));  // of 3 to 7 the last ones alone
}

/// By the nodes within 0.9 of the half width.
double reach_of(const std::function<double(double)>& pressure) {
  std::vector<double> values;
  for (int i = 0; i <= 40; ++i) values.push_back(pressure(i / 20.0 - 1));
  const Line line(values);
  return reaches_edges(line.surface, range(2, 39));
}

TEST(InnerContact, KnowsWherePressureReachesTheEdges) {
  EXPECT_EQ(reach_of([](double) { return 4.0; }), 1);
  EXPECT_EQ(reach_of([](double x) { return std::sqrt(1.0001 - x * x); }), 0);              // Hertz
  EXPECT_EQ(reach_of([](double x) { return std::sqrt(4.0001 - (1 + x) * (1 + x)); }), 0);  // a half
  EXPECT_EQ(reach_of([](double x) { return 1 / std::sqrt(1.0001 - x * x); }), 1);  // a flat punch
  EXPECT_EQ(reaches_edges(Line(ones(3)).surface, {}), 0);
}

TEST(InnerContact, APlaneOfSymmetryIsItsMiddle) {
  EXPECT_EQ(Line(ones(21), {0}).inner(), range(0, 19));
  EXPECT_EQ(Line(ones(21), {20}).inner(), range(2, 21));
  EXPECT_EQ(Line(ones(21), range(0, 21)).inner(), range(1, 20));  // nothing moves: not one
}

TEST(InnerContact, OfARingWithoutEndsIsAllOfIt) {
  constexpr std::size_t count = 24;
  Line ring(ones(count));
  ring.surface.dim = 2;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / count;
    ring.surface.initial[i] = {std::cos(angle), std::sin(angle), 0};
    ring.neighbours[i] = {(i + 1) % count, (i + count - 1) % count};
  }
  EXPECT_EQ(ring.inner().size(), count);
  for (std::size_t i = 0; i < count / 2; ++i) ring.surface.pressure[i] = 0;
  EXPECT_LT(ring.inner().size(), count / 2);  // it has ends
  EXPECT_GT(ring.inner().size(), count / 4);
}

TEST(InnerContact, OfAQuarterOfARingIsAllOfIt) {
  constexpr std::size_t count = 13;
  Line quarter(ones(count));
  quarter.surface.dim = 2;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = M_PI / 2 * static_cast<double>(i) / (count - 1), x = std::cos(angle),
                 y = i + 1 < count ? std::sin(angle) : 1;
    quarter.surface.initial[i] = {i + 1 < count ? x : 0, y, 0};
    quarter.surface.current[i] = {1.01 * quarter.surface.initial[i][0], 1.01 * y, 0};
  }
  EXPECT_EQ(quarter.inner(), range(0, count));
}

TEST(InnerContact, OfOneNodeIsThatNode) {
  EXPECT_EQ(Line({0, 1, 0}).inner(), range(1, 2));
  EXPECT_TRUE(Line({0, 0, 0}).inner().empty());
  EXPECT_EQ(Line({0, 1, 0, 1, 1, 1, 1, 1}).inner(),
            range(4, 7));  // beside a larger patch: no inside
}

}  // namespace
}  // namespace gnomon::budget
