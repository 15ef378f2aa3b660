// Warnings at the end of a run about its numbers.
#include "run/end_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/wear_integral.hpp"

namespace gnomon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Integrator& integrator(const std::string& name) {
  return Integrators::find(name, "integrator");
}

Observation worn(double volume, double integral) {
  Observation observed;
  observed.worn_volume = volume;
  observed.wear_integral = integral;
  return observed;
}

TEST(EndWarnings, TellOfNodesThatAnExplicitMethodMakesLeaveContact) {
  EXPECT_THAT(end_warnings({}, 3, integrator("forward-euler")),
              ElementsAre(HasSubstr("3 contact nodes left contact twice or more")));
  EXPECT_THAT(end_warnings({}, 0, integrator("forward-euler")), IsEmpty());
  for (const char* name : {"backward-euler", "esdirk-4", "bdf"})
    EXPECT_THAT(end_warnings({}, 3, integrator(name)), IsEmpty()) << name;
}

TEST(EndWarnings, TellOfWearThatTheShapeHasNotLost) {
  EXPECT_THAT(end_warnings(worn(1.7, 2), 0, integrator("bdf")),
              ElementsAre(HasSubstr("the worn volume is 1.7, the wear integral is 2:")));
  EXPECT_THAT(end_warnings(worn(1.9, 2), 0, integrator("bdf")), IsEmpty());
}

TEST(LostWear, IsMoreThanATenthOfTheIntegral) {
  EXPECT_FALSE(has_lost_wear(worn(1.81, 2)));
  EXPECT_TRUE(has_lost_wear(worn(1.79, 2)));
  EXPECT_FALSE(has_lost_wear(worn(2.19, 2)));
  EXPECT_TRUE(has_lost_wear(worn(2.21, 2)));
  EXPECT_TRUE(has_lost_wear(worn(NAN, 2)));
}

TEST(LostWear, CannotBeSeenWhereNothingIsWornOrKnown) {
  EXPECT_FALSE(has_lost_wear({}));
  EXPECT_FALSE(has_lost_wear(worn(0, 1e-30)));
  EXPECT_FALSE(has_lost_wear(worn(0, 0)));
}

}  // namespace
}  // namespace gnomon
