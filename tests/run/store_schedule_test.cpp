// Which states are stored, and where steps have to end.
#include "run/store_schedule.hpp"

#include <gtest/gtest.h>

namespace gnomon::store_schedule_test {
namespace {

TEST(StoreSchedule, StoresEveryNthStep) {
  StoreSchedule schedule({.every = 3, .times = {}}, 10);
  EXPECT_FALSE(schedule.wants(1, 1));
  EXPECT_FALSE(schedule.wants(2, 2));
  EXPECT_TRUE(schedule.wants(3, 3));
  EXPECT_FALSE(schedule.wants(4, 4));
  EXPECT_EQ(schedule.stop(), 10);
}

TEST(StoreSchedule, StopsOnItsTimesAndStoresThemOnce) {
  StoreSchedule schedule({.every = 0, .times = {2, 5}}, 10);
  EXPECT_EQ(schedule.stop(), 2);
  EXPECT_FALSE(schedule.wants(1.5, 1));
  EXPECT_TRUE(schedule.wants(2, 2));
  EXPECT_EQ(schedule.stop(), 5);
  EXPECT_FALSE(schedule.wants(4, 3));
  EXPECT_TRUE(schedule.wants(5, 4));
  EXPECT_EQ(schedule.stop(), 10);
}

TEST(StoreSchedule, StoresTheLastState) {
  StoreSchedule schedule({.every = 0, .times = {}}, 10);
  EXPECT_FALSE(schedule.wants(9.99, 7));
  EXPECT_TRUE(schedule.wants(10, 8));
}

// A resumed run asks for its present time and ignores the answer.
TEST(StoreSchedule, GoesOnBehindTimesThatHaveGoneBy) {
  StoreSchedule schedule({.every = 0, .times = {2, 5, 7}}, 10);
  EXPECT_TRUE(schedule.wants(6, 12));
  EXPECT_EQ(schedule.stop(), 7);
}

}  // namespace
}  // namespace gnomon::store_schedule_test
