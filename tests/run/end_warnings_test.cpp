// Warnings at the end of a run about its numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/guards.hpp"

namespace gnomon::end_warnings_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Integrator& integrator(const std::string& name) {
  return Integrators::find(name, "integrator");
}

Observation worn(double volume, double integral) {
  return {common("worn_volume", volume), common("wear_integral", integral)};
}

TEST(EndWarnings, TellOfNodesThatAnExplicitMethodMakesLeaveContact) {
  EXPECT_THAT(end_warnings({}, 0, 3, integrator("forward-euler"), {}),
              ElementsAre(HasSubstr("3 contact nodes left contact twice or more")));
  EXPECT_THAT(end_warnings({}, 0, 0, integrator("forward-euler"), {}), IsEmpty());
  for (const char* name : {"backward-euler", "esdirk-4", "bdf"})
    EXPECT_THAT(end_warnings({}, 0, 3, integrator(name), {}), IsEmpty()) << name;
}

TEST(EndWarnings, TellOfWearThatTheShapeHasNotLost) {
  EXPECT_THAT(end_warnings(worn(1.7, 2), 0, 0, integrator("bdf"), {}),
              ElementsAre(HasSubstr("the worn volume is 1.7, the wear integral is 2:")));
  EXPECT_THAT(end_warnings(worn(1.9, 2), 0, 0, integrator("bdf"), {}), IsEmpty());
  EXPECT_THAT(end_warnings(worn(2.3, 2), 0, 0, integrator("bdf"), {}),
              ElementsAre(HasSubstr("2.3, the wear integral is 2: the elements beside an end")));
}

TEST(EndWarnings, TellOfAToleranceForDeeperWear) {
  const auto of_depth = [](double depth, double rtol_by_scale) {
    return end_warnings({common("wear_depth", depth)}, 0, 0, integrator("bdf"),
                        {.rtol = 1e-3, .atol = rtol_by_scale * 1e-3, .scale = 0.5});
  };
  EXPECT_THAT(of_depth(0.01, 0.5), ElementsAre(HasSubstr("integrator.atol = 1e-05 allows")));
  EXPECT_THAT(of_depth(0.2, 0.5), IsEmpty());
  EXPECT_THAT(of_depth(0.01, 0.01), IsEmpty());  // given
  EXPECT_THAT(of_depth(0, 0.5), IsEmpty());
}

TEST(EndWarnings, TellOfAVolumeThatIsRounding) {
  const auto of = [](double volume, double integral, double depth) {
    Observation last = worn(volume, integral);
    last.push_back(common("wear_depth", depth));
    return end_warnings(last, 1e-14, 0, integrator("bdf"), {.scale = 1e-16});
  };
  EXPECT_THAT(of(6.7e-16, 5e-16, 1e-16), ElementsAre(HasSubstr("of 6.7e-16 is lost in the")));
  EXPECT_THAT(of(6.7e-16, 5e-16, 1e-100), IsEmpty());  // nothing wears
  EXPECT_THAT(of(1.04, 1, 1e-16), IsEmpty());
  EXPECT_THAT(of(0, 0, 0), IsEmpty());
}

TEST(LostWear, IsMoreThanATenthOfTheIntegral) {
  EXPECT_FALSE(has_lost_wear(worn(1.81, 2), 0));
  EXPECT_TRUE(has_lost_wear(worn(1.79, 2), 0));
  EXPECT_FALSE(has_lost_wear(worn(2.19, 2), 0));
  EXPECT_TRUE(has_lost_wear(worn(2.21, 2), 0));
  EXPECT_TRUE(has_lost_wear(worn(NAN, 2), 0));
}

TEST(LostWear, CanBeAllOfIt) {
  EXPECT_TRUE(has_lost_wear(worn(0, 2), 1e-14));
  EXPECT_TRUE(has_lost_wear(worn(0, 1e-30), 0));
}

TEST(LostWear, CannotBeSeenWhereNothingIsWornOrKnown) {
  EXPECT_FALSE(has_lost_wear({}, 0));
  EXPECT_FALSE(has_lost_wear(worn(0, 0), 0));
  EXPECT_FALSE(has_lost_wear(worn(0, 1e-30), 1e-20));
  EXPECT_FALSE(has_lost_wear(worn(-1e-21, 1e-30), 1e-20));
}

// Rounding errors of double numbers are 1e-16 of volumes; those of sums are larger.
TEST(InvisibleVolume, IsAPartOfTheBodysVolume) {
  const Grid plane{Grid::Cell::quadrilateral, {{1, 5, 0}, {3, 10, 0}}, {}},
      space{Grid::Cell::hexahedron, {{1, 5, 0}, {3, 10, 7}}, {}};
  const double area = 10, volume = 70, revolved = 2 * M_PI * 3 * area;
  const auto expect_part_of = [](double expected, double invisible) {
    EXPECT_GT(invisible, 1e-16 * expected);
    EXPECT_LT(invisible, 1e-12 * expected);
  };
  expect_part_of(area, invisible_volume(plane, 2));
  expect_part_of(volume, invisible_volume(space, 3));
  expect_part_of(revolved, invisible_volume(plane, 3));
  EXPECT_EQ(invisible_volume(std::nullopt, 2), 0);
}

}  // namespace
}  // namespace gnomon::end_warnings_test
