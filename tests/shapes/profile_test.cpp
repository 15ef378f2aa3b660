#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <gnomon/shapes/profile.hpp>

#include "shapes/counter_body_text.hpp"

namespace gnomon::profile_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

TEST(ProfilePoints, AreReadFromTwoColumns) {
  const auto points = parse_points(
      "\xEF\xBB\xBFr [mm]; z [mm]\r\n# comment\n1, 2\n\n 3;4 # here\n+5\t-6e-1", "a.csv");
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[1], Vector<2>(3, 4));
  EXPECT_EQ(points[2], Vector<2>(5, -0.6));
  const auto refused = [](const std::string& text) {
    try {
      parse_points(text, "a.csv");
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused("x,y\n1,2\n3,nan\n"),
              HasSubstr("a.csv:3: expected two finite numbers, got `3,nan`"));
  EXPECT_THAT(refused("1,2\n3\n"), HasSubstr("a.csv:2"));
  EXPECT_THAT(refused("1,2,3\n"), HasSubstr("a.csv:1"));
  EXPECT_THAT(refused("x,y\nr,z\n1,2"), HasSubstr("a.csv:2"));
  EXPECT_THAT(refused("1,2\n\x01\x02\n"), HasSubstr("`??`"));
  EXPECT_THAT(refused("1,2\n1e400,2\n"), HasSubstr("a.csv:2"));
  // A header has no numbers.
  EXPECT_THAT(refused("abc,1\n1,2\n"), HasSubstr("a.csv:1: expected two finite numbers, got `abc"));
  EXPECT_THAT(refused("1e400,2\n1,2\n"), HasSubstr("a.csv:1"));
  EXPECT_THAT(refused("1.5mm,y\n1,2\n"), HasSubstr("a.csv:1"));
  EXPECT_THAT(refused("nan,-.5\n1,2\n"), HasSubstr("a.csv:1"));
  EXPECT_THAT(refused("x,y\n"), HasSubstr("no line with numbers"));
  EXPECT_THAT(refused(""), HasSubstr("no line with numbers"));
  EXPECT_THAT(refused("1," + std::string(1000, '2') + "x"), HasSubstr("...`"));
}

TEST(ProfilePoints, AFileIsBesideTheSceneAndMovesIntoIt) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "gnomon_profile_points";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "cam.csv") << "x,y\n1,0\n0,1\n-1,0\n0,-1\n";
  const Scene scene =
      scene_of("[counter_body]\nshape = \"profile\"\npoints = \"cam.csv\"\nside = \"inside\"\n",
               (folder / "scene.toml").string());
  EXPECT_DOUBLE_EQ(read_counter_body<2>(scene).shape.at({0, 3}).gap, 2);
  std::filesystem::remove_all(folder);
  EXPECT_THROW(read_counter_body<2>(scene), InputError);
}

TEST(ProfilePoints, AResultNeedsNoFile) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "gnomon_profile_embedded";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "cam.csv") << "1 0\n0 1\n-1 0\n0 -1\n";
  const Scene scene = with_profile_points(
      scene_of("[counter_body]\nshape = \"profile\"\npoints = \"cam.csv\"\nside = \"inside\"\n",
               (folder / "scene.toml").string()));
  std::filesystem::remove_all(folder);
  EXPECT_EQ(scene.reals("counter_body.points").size(), 8u);
  EXPECT_DOUBLE_EQ(read_counter_body<2>(scene).shape.at({0, 3}).gap, 2);
}

// Inside the curve where two of its parts are equally near, and at a centre of curvature.
TEST(Profile, HasNoNormalOnItsMedialAxis) {
  std::vector<Vector<2>> points;
  for (int k = 0; k < 24; ++k)
    points.emplace_back(2 * std::cos(M_PI * k / 12), std::sin(M_PI * k / 12));
  const CounterShape<2> inside = profile(SplineCurve(points, true));
  EXPECT_LT(inside.at({0.5, 0.3}).gap, 0);
  EXPECT_THROW(inside.at({0.5, 0}), RecoverableError);
  // Outside of the body, in the cavity, the gap is known and the normal is one of two.
  const SignedDistance<2> middle = complement(inside).at({0.5, 0});
  EXPECT_FALSE(middle.unique);
  EXPECT_GT(middle.gap, 0.9);
  const SignedDistance<2> tip = complement(inside).at({1.9, 0});
  EXPECT_TRUE(tip.unique);
  EXPECT_NEAR(tip.gap, 0.1, 1e-12);
}

TEST(Profile, IsABoreThatAShaftMeetsFromWithin) {
  std::vector<Vector<2>> points;
  for (int k = 0; k < 72; ++k)
    points.emplace_back(10 * std::cos(M_PI * k / 36), 10 * std::sin(M_PI * k / 36));
  const CounterShape<2> bore = profile(SplineCurve(points, true).reversed());
  EXPECT_NEAR(bore.travel_to({0, -9.95}, {0, 1}), 0.05, 1e-5);
  EXPECT_NEAR(bore.travel_to({3, 0}, {-1, 0}), 7, 1e-5);
}

}  // namespace
}  // namespace gnomon::profile_test
