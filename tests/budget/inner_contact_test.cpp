// Where pressures are compared: inside of every patch of the contact.

#include "budget/inner_contact.hpp"

#include <gtest/gtest.h>

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

TEST(InnerContact, APlaneOfSymmetryIsItsMiddle) {
  EXPECT_EQ(Line(ones(21), {0}).inner(), range(0, 19));
  EXPECT_EQ(Line(ones(21), {20}).inner(), range(2, 21));
  EXPECT_EQ(Line(ones(21), range(0, 21)).inner(), range(1, 20));  // nothing moves: not one
}

TEST(InnerContact, OfOneNodeIsThatNode) {
  EXPECT_EQ(Line({0, 1, 0}).inner(), range(1, 2));
  EXPECT_TRUE(Line({0, 0, 0}).inner().empty());
  EXPECT_EQ(Line({0, 1, 0, 1, 1, 1, 1, 1}).inner(),
            range(4, 7));  // beside a larger patch: no inside
}

}  // namespace
}  // namespace gnomon::budget
