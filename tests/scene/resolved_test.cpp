// The resolved dump is a scene: loading it gives an equal scene.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <gnomon/model/problem.hpp>
#include <random>

#include "scene/example_table.hpp"

namespace gnomon::resolved_test {
namespace {

using test::example_scene;
using test::example_table;

void expect_reloads(const Scene& scene, const KeyTableOf& table_of) {
  const std::string dump = scene.resolved();
  const Scene again = parse_scene(dump, "resolved", {}, table_of);
  EXPECT_TRUE(scene == again) << dump;
  EXPECT_EQ(again.resolved(), dump);
}

TEST(Resolved, FillsInDefaultsWithUnitsAndHelp) {
  const std::string dump =
      example_scene("problem = \"example\"\nbody.young_modulus = 640\n").resolved();
  EXPECT_NE(dump.find("young_modulus = 640.0  # [MPa] stiffness"), std::string::npos) << dump;
  EXPECT_NE(dump.find("elements = [4, 4]  # elements"), std::string::npos) << dump;
  EXPECT_NE(dump.find("# limit = ... "), std::string::npos) << dump;
  EXPECT_NE(dump.find("# [s] limit; absent: none"), std::string::npos) << dump;
}

TEST(Resolved, ReloadsToAnEqualSceneForRandomScenes) {
  std::mt19937 random(20240607);
  const auto whole = [&](long low, long high) {
    return std::uniform_int_distribution<long>(low, high)(random);
  };
  const auto positive = [&] {  // all of the exponents
    return std::ldexp(1 + std::uniform_real_distribution<double>(0, 1)(random),
                      static_cast<int>(whole(-1022, 1023)));
  };
  for (int i = 0; i < 500; ++i) {
    std::string title;
    for (long k = whole(0, 20); k > 0; --k) title += fmt::format("\\u{:04X}", whole(1, 0xd7ff));
    std::string times;
    for (long k = whole(0, 4); k > 0; --k)
      times += fmt::format("{}{}", times.empty() ? "" : ", ", positive());
    std::string text = fmt::format(
        "problem = \"example\"\nbody.young_modulus = {}\nmesh.elements = [{}, {}]\n"
        "mesh.level = {}\n[output]\ntimes = [{}]\nlast = {}\ntitle = \"{}\"\n",
        positive(), whole(1, 1L << 62), whole(1, 9), whole(0, 9), times, whole(0, 1) == 1, title);
    if (whole(0, 1)) text += fmt::format("limit = {}\n", -positive());
    expect_reloads(example_scene(text), example_table);
  }
}

TEST(Resolved, ShippedScenesReload) {
  for (const char* name : {"small_deformation.toml", "finite_deformation.toml"}) {
    const auto file = std::filesystem::path(GNOMON_SOURCE_DIR) / "problems/pin_on_flat" / name;
    expect_reloads(load_scene(file, {}, key_table), key_table);
  }
}

TEST(Equality, SeesEveryValue) {
  const std::string text = "problem = \"example\"\nbody.young_modulus = 640\n";
  EXPECT_TRUE(example_scene(text) == example_scene(text, {"mesh.level=1"}));
  EXPECT_FALSE(example_scene(text) == example_scene(text, {"mesh.level=2"}));
  EXPECT_FALSE(example_scene(text) == example_scene(text, {"output.limit=1"}));
}

}  // namespace
}  // namespace gnomon::resolved_test
