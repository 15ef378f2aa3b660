// A mesh file for each body, and shafts in their bores.

#include "part/part_scene.hpp"

namespace gnomon::body_meshes_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// A square of 2 mm, with the groups "top", "bottom" and "sides".
std::string square(int elements) {
  std::string text =
      "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 2, 2};\n"
      "Transfinite Curve {1, 2, 3, 4} = " +
      std::to_string(elements + 1) + ";\nTransfinite Surface {1}; Recombine Surface {1};\n";
  return text +
         "Physical Surface(\"square\") = {1}; Physical Curve(\"bottom\") = {1};\n"
         "Physical Curve(\"top\") = {3}; Physical Curve(\"sides\") = {2, 4};\n";
}

class BodyMeshes : public PartScenes {
protected:
  void SetUp() override {
    PartScenes::SetUp();
    folder_.write("upper.geo", square(4));
    folder_.write("lower.geo", square(6));
  }
  /// One square on the other, 0.1 mm apart.
  static std::string text(const std::string& more = "") {
    return R"(
problem = "worn_body"
[time]
end = 10.0
[[body]]
name = "upper"
mesh = "upper.geo"
young_modulus = 1000.0
poisson_ratio = 0.3
[[body]]
name = "lower"
mesh = "lower.geo"
shift = [0.0, -2.1]
young_modulus = 2000.0
poisson_ratio = 0.3
[[pair]]
bodies = ["upper", "lower"]
[[motion]]
body = "lower"
velocity = [10.0, 0.0]
[[support]]
on = "lower.bottom"
[[support]]
on = "lower.sides"
directions = ["x"]
[[support]]
on = "upper.sides"
directions = ["x"]
[[load]]
on = "upper.top"
force = [0.0, -20.0]
[wear]
on = ["upper.bottom", "lower.top"]
coefficient = 1e-6
)" + more;
  }
};

TEST_F(BodyMeshes, AreJoinedMovedAndBroughtTogether) {
  const auto pair = model(text());
  Counters counters;
  const State start = pair->start(counters);
  EXPECT_NEAR(observed(*pair, start, "max_pressure"), 10, 1e-6);
  EXPECT_NEAR(observed(*pair, start, "contact_area"), 2, 1e-6);
  EXPECT_NEAR(observed(*pair, start, "wear_flux_upper"), 1e-6 * 20 * 10, 1e-10);
}

// Two contacts, of which each has its slave.
TEST_F(BodyMeshes, ABodyMayLieBetweenTwoOthers) {
  folder_.write("middle.geo", square(5));
  std::string stack = text();
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = stack.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    stack.replace(at, from.size(), to);
  };
  replace("shift = [0.0, -2.1]", "shift = [0.0, -4.2]");
  replace("[[pair]]\nbodies = [\"upper\", \"lower\"]",
          "[[body]]\nname = \"middle\"\nmesh = \"middle.geo\"\nshift = [0.0, -2.1]\n"
          "young_modulus = 500.0\npoisson_ratio = 0.3\n"
          "[[pair]]\nbodies = [\"upper\", \"middle\"]\n[[pair]]\nbodies = [\"middle\", \"lower\"]");
  replace("[wear]\non = [",
          "[[support]]\non = \"middle.sides\"\ndirections = [\"x\"]\n[wear]\non = "
          "[\"middle.bottom\", ");
  const auto model = this->model(stack);
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(observed(*model, start, "max_pressure"), 10, 1e-6);
  EXPECT_NEAR(observed(*model, start, "contact_force"), 40, 1e-6);
  EXPECT_NEAR(observed(*model, start, "wear_flux_middle"), 1e-6 * 20 * 10, 1e-10);
  EXPECT_NEAR(observed(*model, start, "wear_flux_lower"), 1e-6 * 20 * 10, 1e-10);
  EXPECT_NEAR(observed(*model, start, "wear_flux_upper"), 0, 1e-10);  // it does not slide
}

TEST_F(BodyMeshes, MistakesAreNamed) {
  EXPECT_THAT(refusal(text("[mesh]\nfile = \"upper.geo\"\n")),
              HasSubstr("expected none beside body.#.mesh"));
  EXPECT_THAT(refusal(text(), {"body.2.shift=[1.0]"}), HasSubstr("expected 2 numbers, got 1"));
  EXPECT_THAT(refusal(text(), {"support.1.on=bottom"}), HasSubstr("\"lower.bottom\""));
}

}  // namespace
}  // namespace gnomon::body_meshes_test
