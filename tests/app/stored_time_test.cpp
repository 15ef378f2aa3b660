// Times as they are printed and as figures show them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>

#include "app/commands.hpp"

namespace gnomon::app {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::vector<double> times = {0, 0.125, 349.6, 350.0000001, 12345.678, 100000};

double found(const std::string& text) {
  return stored_time(times, text, "pin.h5");
}

TEST(StoredTime, IsTheNearestThatRoundsToThePrintedDigits) {
  EXPECT_EQ(found("350"), 350.0000001);
  EXPECT_EQ(found("350 s"), 350.0000001);
  EXPECT_EQ(found("350s"), 350.0000001);
  EXPECT_EQ(found("t = 350 s"), 350.0000001);
  EXPECT_EQ(found("350.0"), 350.0000001);
  EXPECT_EQ(found("349.6"), 349.6);
  EXPECT_EQ(found("0.12"), 0.125);
  EXPECT_EQ(found("0.13"), 0.125);
  EXPECT_EQ(found("0"), 0);
  EXPECT_EQ(found("12345.7"), 12345.678);
  EXPECT_EQ(found("1.235e+04"), 12345.678);
  EXPECT_EQ(found("1e5"), 100000);
  for (double t : times) EXPECT_EQ(found(std::to_string(t)), t);
}

TEST(StoredTime, RefusesOthersWithTheNeighbours) {
  const auto refused = [](const std::string& text, const std::string& with) {
    EXPECT_THAT([&] { found(text); }, ThrowsMessage<InputError>(HasSubstr(with))) << text;
  };
  refused("348", "pin.h5: it has no stored step at t = 348; next to it are t = 0.125 and 349.6");
  refused("349.8", "next to it are t = 349.6 and 350");
  refused("0.14", "next to it are t = 0.125 and 349.6");
  refused("2e5", "next to it are t = 100000");
  refused("-5", "next to it are t = 0");
  for (const char* text : {"", "s", "t", "x", "350 m", "1e", "inf", "nan", "3 5"})
    refused(text, "--time: expected a time in seconds");
  EXPECT_THAT([] { stored_time({}, "1", "pin.h5"); },
              ThrowsMessage<InputError>(HasSubstr("no stored step")));
}

}  // namespace
}  // namespace gnomon::app
