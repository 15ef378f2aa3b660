// Counter-bodies that are free in several directions, guided, or turn under a moment.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/checks/checks.hpp>
#include <span>

#include "part/part_scene.hpp"

namespace gnomon::free_partner_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

class FreePartner : public PartScenes {
protected:
  /// A shaft in a full ring with these presses.
  std::string text(const std::string& press, const std::string& more = "") const {
    std::string text = text_of(shipped("journal.toml")) + more;
    const std::size_t from = text.find("[[counter_body.press]]"), to = text.find("[wear]");
    text.replace(from, to - from, press);
    folder_.write("journal.geo", "n = 20;\n" + text_of(shipped("journal.geo")));
    return text;
  }
  std::unique_ptr<Model> journal(const std::string& press, const Overrides& overrides = {},
                                 const std::string& more = "") const {
    return model(text(press, more), overrides);
  }
  std::string refusal(const std::string& press, const Overrides& overrides = {}) const {
    return PartScenes::refusal(text(press), overrides);
  }
};

std::string entry(const std::string& keys) {
  return "[[counter_body.press]]\n" + keys + "\n";
}
const std::string down = entry("direction = [0.0, -1.0]\nforce = 100.0"),
                  aside = entry("direction = [1.0, 0.0]\nforce = 0.0");

State start_of(const Model& model) {
  Counters counters;
  return model.start(counters);
}

/// The angle of the middle of pressures from the bottom of the bore, to the right.
double middle(const ContactSurface& surface, std::span<const double> pressure) {
  double x = 0, y = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c)
    x += pressure[c] * surface.initial[c][0], y += pressure[c] * surface.initial[c][1];
  return std::atan2(x, -y);
}

double middle(const Model& model, const State& state) {
  const ContactSurface surface = model.contact(state).value();
  return middle(surface, surface.pressure);
}

// A guide carries the friction without a word; free, the shaft rolls against its surface until
// pressure and friction carry the load together, at the angle of friction.
TEST_F(FreePartner, AShaftRollsUpItsBore) {
  const double angle = std::atan(0.3);
  const auto guided = journal("[counter_body.press]\ndirection = [0.0, -1.0]\nforce = 100.0\n");
  const State held = start_of(*guided);
  const double carried = observed(*guided, held, "guide_x");
  EXPECT_NEAR(carried, 30, 1);
  EXPECT_NEAR(observed(*guided, held, "guide_y"), 0, 1e-6);
  EXPECT_LT(std::abs(middle(*guided, held)), 0.03);
  const auto free = journal(down + aside);
  const State rolled = start_of(*free);
  EXPECT_NEAR(observed(*free, rolled, "guide_x"), 0, 1e-6);
  EXPECT_NEAR(observed(*free, rolled, "guide_y"), 0, 1e-6);
  EXPECT_NEAR(std::abs(middle(*free, rolled)), angle, 0.01);
  EXPECT_GT(observed(*free, rolled, "contact_force"), 100 * std::cos(angle));  // of an arc
  // The other way round where it turns the other way; and wherever it begins.
  const auto backwards = journal(aside + down, {"counter_body.motion.rotation=-100.0"});
  EXPECT_NEAR(middle(*backwards, start_of(*backwards)), -middle(*free, rolled), 1e-5);
  const auto off = journal(down + aside, {"counter_body.center=[0.02, 0.01]"});
  const State same = start_of(*off);
  EXPECT_NEAR(middle(*off, same), middle(*free, rolled), 1e-5);
  EXPECT_NEAR(observed(*off, same, "approach_2"), observed(*free, rolled, "approach_2") - 0.02,
              1e-7);
}

TEST_F(FreePartner, AShaftRollsUpItsBoreBesideAGivenApproach) {
  const std::string moved = entry("direction = [0.0, -1.0]\napproach = 0.06");
  for (const std::string& presses : {moved + aside, aside + moved}) {
    const auto shaft = journal(presses);
    const State rolled = start_of(*shaft);
    EXPECT_NEAR(observed(*shaft, rolled, "guide_x"), 0, 1e-6);
    EXPECT_LT(observed(*shaft, rolled, "guide_y"), -1);
    EXPECT_NEAR(std::abs(middle(*shaft, rolled)), std::atan(0.3), 0.01);
  }
}

TEST_F(FreePartner, AShaftLargerThanItsBoreIsNamed) {
  const auto doubts_of = [this](const Overrides& overrides) {
    const auto model = journal(down + aside, overrides);
    return doubts(model->examine(start_of(*model)));
  };
  EXPECT_THAT(doubts_of({}), ::testing::IsEmpty());
  EXPECT_THAT(doubts_of({"counter_body.radius=10.1"}),
              ::testing::ElementsAre(HasSubstr("wedged, or larger")));
}

// Lame: the radial displacement of a ring in a rigid housing is B (1/r - r/b^2).
TEST_F(FreePartner, AnInterferenceFitNeedsNoPress) {
  const auto fit = journal("", {"counter_body.radius=10.07", "friction.coefficient=0.0"});
  const double a = 10.05, b = 13, overlap = 0.02, mu = 3000 / 2.7, lambda = mu * 0.7 / 0.3;
  const double B = overlap / (1 / a - a / (b * b));
  const double pressure = 2 * mu * B / (a * a) + 2 * (lambda + mu) * B / (b * b);
  const double force = observed(*fit, start_of(*fit), "contact_force");
  EXPECT_NEAR(force, 2 * M_PI * a * pressure, 0.01 * force);
}

// A circle about the bore, larger than its clearance: each phase is the state of a shaft that is as
// far off, and each quarter of the bore is the same.
TEST_F(FreePartner, AShaftInOrbitNeedsNoPress) {
  const Overrides smooth = {"friction.coefficient=0.0"};
  const double part = 0.07 * std::sqrt(0.5);
  const auto off = journal("", {smooth[0], fmt::format("counter_body.center=[{0},{0}]", part)});
  const double force = observed(*off, start_of(*off), "contact_force");
  EXPECT_GT(force, 10);
  const std::string orbit =
      "\n[cycle]\nperiod = 1.0\nphases = 4\nx = \"0.07*cos(2*pi*tau+pi/4)\"\n"
      "y = \"0.07*sin(2*pi*tau+pi/4)\"\n";
  for (const std::string& press :
       {std::string(), entry("direction = [1.0, 0.0]\napproach = 0.0")}) {
    const auto moved = journal(press, smooth, orbit);
    EXPECT_NEAR(observed(*moved, start_of(*moved), "contact_force"), force, 1e-5 * force);
  }
}

TEST_F(FreePartner, AnOrbitWithinItsClearanceIsRefused) {
  const std::string text =
      this->text("", "\n[cycle]\nperiod = 1.0\nphases = 4\nx = \"0.04*cos(2*pi*tau)\"\n");
  EXPECT_THAT(PartScenes::refusal(text, {"friction.coefficient=0.0"}),
              HasSubstr("or phases in which bodies overlap"));
}

TEST_F(FreePartner, AWornBoreLosesWhatWearsAndBalances) {
  const auto free = journal(down + aside);
  const ModelRun run = run_model(*free, "esdirk-3", 0, 1e-3, 1000);
  EXPECT_NEAR(observed(*free, run.last(), "guide_x"), 0, 0.05);
  const double worn = observed(*free, run.last(), "worn_volume");
  const double slid = 1e-8 * 1000 * 1000;  // k v t; the arc grows
  EXPECT_GT(worn, slid * 100 * std::cos(std::atan(0.3)));
  EXPECT_LT(worn, 1.01 * slid * observed(*free, run.last(), "contact_force"));
  EXPECT_NEAR(std::abs(middle(*free, run.last())), std::atan(0.3), 0.01);
}

// By blocks and factors of the whole, of one state and of phases in which the shaft rolls to
// either side.
TEST_F(FreePartner, TheSolversAgree) {
  const std::string cycle =
      "\n[cycle]\nperiod = 1.0\nrotation = \"0.5*sin(2*pi*tau)\"\nphases = 4\n";
  for (const std::string& more : {std::string(), cycle}) {
    std::array<double, 2> worn{};
    for (const bool blocks : {true, false}) {
      Overrides overrides = {std::string("solver.method=") + (blocks ? "block" : "direct")};
      if (!more.empty()) overrides.push_back("counter_body.motion.rotation=0.0");
      const auto model = journal(down + aside, overrides, more);
      const ModelRun run = run_model(*model, "backward-euler", 50, 1e-4, 150);
      worn[blocks ? 0 : 1] = observed(*model, run.last(), "worn_volume");
      EXPECT_NEAR(observed(*model, run.last(), "guide_x"), 0, 1e-4);
      if (blocks) {
        EXPECT_LT(run.counters.krylov_iterations, 20 * run.counters.linear_solves);
      }
      if (more.empty()) continue;
      const ContactSurface surface = model->contact(run.last()).value();
      EXPECT_NEAR(middle(surface, surface.pressure), 0, 0.01);
      const std::size_t count = surface.node.size();
      for (std::size_t p = 0; p < surface.phase_weight.size(); ++p)
        EXPECT_NEAR(
            std::abs(middle(surface, std::span(surface.phase_pressure).subspan(p * count, count))),
            std::atan(0.3), 0.02);
    }
    EXPECT_GT(worn[0], 0);
    EXPECT_NEAR(worn[0], worn[1], 1e-7 * worn[0]);
  }
}

// Without friction: pressed obliquely by two forces as by their sum, and by a given shift beside a
// force; the reaction is that of what is not free.
TEST_F(FreePartner, ForcesAddUpAndWhatIsGivenHasAReaction) {
  const Overrides smooth = {"friction.coefficient=0.0"};
  const auto two = journal(down + entry("direction = [1.0, 0.0]\nforce = 100.0"), smooth);
  const auto slanting =
      journal(entry("direction = [1.0, -1.0]\nforce = 141.421356237") + aside, smooth);
  const State state = start_of(*two), other = start_of(*slanting);
  EXPECT_NEAR(middle(*two, state), M_PI / 4, 1e-3);
  EXPECT_NEAR(observed(*two, state, "max_pressure"), observed(*slanting, other, "max_pressure"),
              1e-6);
  EXPECT_NEAR(observed(*two, state, "guide_x"), 0, 1e-6);
  const auto shifted = journal(down + entry("direction = [1.0, 0.0]\napproach = 0.02"), smooth);
  const State at = start_of(*shifted);
  EXPECT_GT(observed(*shifted, at, "guide_x"), 10);
  EXPECT_NEAR(observed(*shifted, at, "guide_y"), 0, 1e-6);
}

// A plane that turns about a pivot under a force and a moment: the pressures have their middle
// where both say.
TEST_F(FreePartner, APivotedPlaneCarriesItsForceAndItsMoment) {
  const std::string geometry =
      "Point(1) = {-2, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 3, 0}; Point(4) = {-2, 3, 0};\n"
      "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
      "Curve Loop(1) = {1:4}; Plane Surface(1) = {1};\n"
      "Transfinite Curve {1, 3} = 17; Transfinite Curve {2, 4} = 9;\n"
      "Transfinite Surface {1}; Recombine Surface {1};\n"
      "Physical Curve(\"sole\") = {1}; Physical Curve(\"top\") = {3};\n"
      "Physical Surface(\"block\") = {1};\n";
  folder_.write("block.geo", geometry);
  const auto model = [&](double moment) {
    const std::string text = fmt::format(
        "problem = \"worn_body\"\nmesh.file = \"block.geo\"\n[body]\nyoung_modulus = 1000.0\n"
        "poisson_ratio = 0.3\n[[support]]\non = \"top\"\n[counter_body]\nshape = \"plane\"\n"
        "motion = {{ velocity = [100.0, 0.0] }}\n[[counter_body.press]]\n"
        "direction = [0.0, 1.0]\nforce = 40.0\n[[counter_body.press]]\nmoment = {}\n"
        "center = [0.3, 0.0]\n[wear]\non = [\"sole\"]\ncoefficient = 1e-8\n"
        "[friction]\ncoefficient = 0.0\n[time]\nend = 1.0\n[integrator]\nname = \"esdirk-3\"\n",
        moment);
    return make_model(load_scene(folder_.write("block.toml", text), {}, key_table));
  };
  for (const double moment : {0.0, 6.0}) {
    const auto block = model(moment);
    const State state = start_of(*block);
    const ContactSurface surface = block->contact(state).value();
    double force = 0, about = 0;
    for (std::size_t c = 0; c < surface.node.size(); ++c) {
      const bool edge = std::abs(std::abs(surface.initial[c][0]) - 2) < 1e-9;
      const double part = surface.pressure[c] * (edge ? 0.125 : 0.25);
      force += part, about += part * (surface.current[c][0] - 0.3);
    }
    EXPECT_NEAR(force, 40, 0.01);
    EXPECT_NEAR(about / force, moment / 40, 1e-3);
    EXPECT_NE(observed(*block, state, "turn_2"), 0);
  }
}

// It lies on both sides of the corner from the start, in no place to which it could roll; each
// force is carried by the side that it presses on.
TEST_F(FreePartner, ACornerIsPressedByTwoForces) {
  folder_.write("corner.geo", R"(
Point(1) = {0, 1, 0}; Point(2) = {1, 0, 0}; Point(3) = {6, 0, 0}; Point(4) = {6, 6, 0};
Point(5) = {0, 6, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1:5}; Plane Surface(1) = {1}; Mesh.MeshSizeMax = 0.6;
Physical Curve("low") = {2}; Physical Curve("left") = {5}; Physical Curve("right") = {3};
Physical Surface("body") = {1};
)");
  for (const double up : {0.1, 1.0, 2.0, 10.0}) {
    const auto body = PartScenes::model(fmt::format(R"toml(
problem = "worn_body"
mesh.file = "corner.geo"
[body]
young_modulus = 1000.0
poisson_ratio = 0.3
[[support]]
on = "right"
[counter_body]
shape = "cone"
center = [0.0, 0.0]
axis = [1.0, 1.0]
half_angle = 45.0
side = "outside"
motion = {{ velocity = [0.0, 0.0, 100.0] }}
[[counter_body.press]]
direction = [0.0, 1.0]
force = {}
[[counter_body.press]]
direction = [1.0, 0.0]
force = 15.0
[wear]
on = ["low", "left"]
coefficient = 1e-6
[time]
end = 1.0
[integrator]
name = "esdirk-3"
)toml",
                                                    up));
    const State state = start_of(*body);
    EXPECT_NEAR(observed(*body, state, "contact_force"), up + 15, 1e-3);
  }
}

TEST_F(FreePartner, RefusesWhatNothingDetermines) {
  const std::string moment = entry("moment = 5.0");
  EXPECT_THAT(refusal(down + moment), HasSubstr("the shape is round about the axis of the moment"));
  EXPECT_THAT(refusal(aside), HasSubstr("a direction with a force above zero"));
  EXPECT_THAT(refusal(moment), HasSubstr("above zero, also beside a moment"));
  EXPECT_THAT(refusal(down + entry("moment = 5.0\ncenter = [10.0, 0.0]")),
              HasSubstr("to turn about the axis of the moment moves it as another entry does"));
  EXPECT_THAT(refusal(down + down), HasSubstr("nothing determines how far it moves"));
  EXPECT_THAT(refusal(entry("force = 1.0")),
              HasSubstr("expected also counter_body.press.1.direction"));
  EXPECT_THAT(refusal(entry("direction = [0.0, -1.0]\nmoment = 1.0")),
              HasSubstr("either a moment"));
  EXPECT_THAT(refusal(entry("direction = [0.0, -1.0, 0.0]\nforce = 1.0")),
              HasSubstr("expected 2 numbers in the plane"));
  EXPECT_THAT(refusal(down, {"counter_body.press.force=3.0"}), HasSubstr("got both"));
}

}  // namespace
}  // namespace gnomon::free_partner_test
