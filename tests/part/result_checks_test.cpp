// What a run says about a result that it cannot vouch for, on parts with a wrong number in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>
#include <gnomon/checks/checks.hpp>

#include "part/cyclic_flat.hpp"
#include "part/stepped_part.hpp"

namespace gnomon {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Examination balanced() {
  Examination facts;
  facts.forces = {{"loads", {0, -20, 0}}, {"contact", {0, 20, 0}}};
  facts.deformation = 0.01;
  return facts;
}

TEST(Doubts, ABalancedResultHasNone) {
  EXPECT_THAT(doubts(balanced()), ElementsAre());
}

TEST(Doubts, EachFactHasItsSentenceWithTheFigure) {
  Examination facts = balanced();
  facts.forces[1].force[1] = 19;
  EXPECT_THAT(doubts(facts), ElementsAre(HasSubstr("out of balance by 1, 0.05 of the largest")));
  facts = balanced();
  facts.idle_load = 1;
  EXPECT_THAT(doubts(facts), ElementsAre(HasSubstr("100 % of the loads act on nodes")));
  facts = balanced();
  facts.intrusion = BoundaryPoint{{1, 2, 0}, 0.14};
  EXPECT_THAT(doubts(facts), ElementsAre(HasSubstr("lies 0.14 mm inside the counter-body")));
  facts = balanced();
  facts.drag = ElasticDrag{.stroke = 2, .drag = 0.5};
  EXPECT_THAT(doubts(facts),
              ElementsAre(HasSubstr("drags the contact by 0.5 mm of a stroke of 2")));
  facts = balanced();
  facts.wedging = 96.4;
  EXPECT_THAT(doubts(facts), ElementsAre(HasSubstr("add up to 96.4 times the force")));
  facts = balanced();
  facts.touches = false;
  EXPECT_THAT(doubts(facts), ElementsAre(HasSubstr("do not touch anywhere")));
}

TEST(Doubts, AContactOfFewNodesIsToldOfAtTheEnd) {
  Examination end = balanced();
  end.few_nodes = 1;
  EXPECT_THAT(doubts(end), ElementsAre());
  EXPECT_THAT(doubts(balanced(), end), ElementsAre(HasSubstr("contact at the end is 1 node:")));
}

TEST(Doubts, AContactOfFewNodesUnderAnApproachIsToldOfAtTheStart) {
  Examination start = balanced();
  start.few_nodes = 1;
  EXPECT_EQ(doubt_about_few_nodes(start), "");  // an estimate by the force has told it
  start.pressed = 0.5;
  EXPECT_THAT(doubt_about_few_nodes(start), HasSubstr("contact at the start is 1 node: pressures"));
}

class BodyTurns : public PartScenes {};

// The springs below carry the force at a distance e from their middle: angle = P e / (k L^3 / 12).
TEST_F(BodyTurns, WithSmallStrainsItIsToldOf) {
  folder_.write("block.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-5, 0, 0, 10, 4}; Mesh.MeshSizeMax = 1;
Physical Surface("block") = {1}; b() = Boundary { Surface{1}; };
Physical Curve("bottom") = {b(0)}; Physical Curve("face") = {b(2)};
)");
  const std::string scene = R"(
problem = "worn_body"
mesh.file = "block.geo"
model.plane = "strain"
body = { young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }
support = [ { on = "bottom", directions = ["x"] },
            { on = "bottom", directions = ["y"], stiffness = 10.0 } ]
counter_body = { shape = "cylinder", radius = 1.0, center = [2.0, 5.0], press = { direction = [0, -1], force = 10.0 } }
wear = { on = ["face"], coefficient = 1e-8, velocity = 1.0 }
time.end = 1.0
)";
  const auto examined = [&](const std::string& force) {
    Counters counters;
    const auto block = model(scene, {"counter_body.press.force=" + force});
    return block->examine(block->start(counters));
  };
  const Examination little = examined("1.0");
  EXPECT_NEAR(little.body_turn.value().angle, 1 * 2 / (10 * std::pow(10, 3) / 12), 1e-4);
  EXPECT_THAT(doubts(little), ElementsAre());
  EXPECT_THAT(doubts(examined("10.0")), ElementsAre(HasSubstr("the body turns by 0.02")));
}

// An acceleration presses with the mass of the unworn block: of what is worn, h of a height of 4,
// the weight still acts.
TEST_F(BodyTurns, TheWeightOfWhatHasWornOffIsToldOf) {
  folder_.write("block.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-5, 0, 0, 10, 4}; Mesh.MeshSizeMax = 1;
Physical Surface("block") = {1}; b() = Boundary { Surface{1}; };
Physical Curve("face") = {b(0)}; Physical Curve("left") = {b(3)}; Physical Curve("right") = {b(1)};
)");
  const auto block = model(R"(
problem = "worn_body"
mesh.file = "block.geo"
model.plane = "strain"
body = { young_modulus = 1e6, poisson_ratio = 0.0, density = 1e-3 }
support = [ { on = "left", directions = ["x"] }, { on = "right", directions = ["x"] } ]
load = [ { acceleration = [0.0, -1e4] } ]
counter_body = { shape = "plane", normal = [0.0, 1.0], motion.velocity = [0.0, 0.0, 100.0] }
wear = { on = ["face"], coefficient = 1e-7 }
time.end = 1000.0
)");
  Counters counters;
  EXPECT_EQ(block->examine(block->start(counters)).stale_weight, 0);
  const Examination facts = block->examine(run_model(*block, "esdirk-3", 0, 1e-4, 1000).last());
  const double h = 1e-7 * 40 * 100 * 1000;  // k p v t
  EXPECT_NEAR(facts.stale_weight, h / 4, 1e-3 * h / 4);
  EXPECT_THAT(doubts(facts), ElementsAre(HasSubstr("what has worn off is 10 % of the contact")));
}

TEST(Doubts, BodiesThatWouldStickAreRefused) {
  Examination facts = balanced();
  facts.drag = ElasticDrag{.stroke = 2, .drag = 1.9};
  EXPECT_NO_THROW(require_model(facts));
  facts.drag->drag = 2.1;
  EXPECT_THROW(require_model(facts), InputError);
}

class ResultChecks : public Cycles {
protected:
  static Examination start_of(const Model& model) {
    Counters counters;
    return model.examine(model.start(counters));
  }
  /// The flat with another support, and a load in the place of the press.
  std::string loaded(const std::string& support, const std::string& load) const {
    const std::string held = "support = [ { on = \"bottom\" } ]";
    std::string scene = text("motion.velocity = [10.0, 0.0]", "");
    return scene.replace(scene.find(held), held.size(),
                         "support = [ { " + support + " } ]\nload = [ { " + load + " } ]");
  }
  static std::array<double, 3> force(const Examination& facts, const std::string& name) {
    for (const ResultantForce& each : facts.forces)
      if (each.name == name) return each.force;
    ADD_FAILURE() << name;
    return {};
  }
};

constexpr const char* stroke =
    "[cycle]\nperiod = 1.0\nphases = 4\nx = \"0.2*sin(2*pi*tau)\"\n[friction]\ncoefficient = 0.3";

// The force of the press goes through the contact into the supports, friction beside it.
TEST_F(ResultChecks, ForcesBalance) {
  const auto model =
      this->model(text("motion.velocity = [10.0, 0.0]\n[friction]\ncoefficient = 0.3"));
  const Examination facts = start_of(*model);
  EXPECT_THAT(doubts(facts), ElementsAre());
  EXPECT_NEAR(force(facts, "contact")[1] + force(facts, "friction")[1], -18.5, 1e-6);
  EXPECT_NEAR(force(facts, "supports")[1], 18.5, 1e-6);
  EXPECT_NEAR(force(facts, "supports")[0],
              -force(facts, "friction")[0] - force(facts, "contact")[0], 1e-6);
  EXPECT_GT(std::abs(force(facts, "friction")[0]), 0.29 * 18.5);
}

TEST_F(ResultChecks, ALoadOnAHeldFaceIsNamed) {
  std::string loaded = text("motion.velocity = [10.0, 0.0]");
  loaded += "\n[[load]]\non = \"bottom\"\npressure = 2.0\n";
  const Examination facts = start_of(*model(loaded));
  EXPECT_NEAR(facts.idle_load, 1, 1e-12);
  EXPECT_NEAR(force(facts, "loads")[1], 2 * 0.8, 1e-9);
}

// Only its load keeps a flat that slides along its sides on the counter-body.
TEST_F(ResultChecks, LoadsThatCeaseToPressAreRefused) {
  folder_.write("flat.geo", flat_geometry(6) + "Physical Curve(\"sides\") = {2, 4};\n");
  const auto pressed = [&](const std::string& history) {
    return loaded("on = \"sides\", directions = [\"x\"]",
                  "on = \"bottom\", force = [0.0, 18.5], " + history);
  };
  EXPECT_NO_THROW(this->model(pressed("times = [0.0, 50.0], factors = [1.0, 0.5]")));
  EXPECT_NO_THROW(this->model(pressed("times = [0.0, 150.0, 200.0], factors = [1.0, 1.0, 0.0]")));
  EXPECT_THAT(refusal(pressed("times = [0.0, 50.0], factors = [1.0, 0.0]")),
              HasSubstr("none presses them at t = 50 s"));
  EXPECT_THAT(refusal(pressed("times = [0.0, 50.0, 50.0], factors = [1.0, -1.0, 1.0]")),
              HasSubstr("they pull them apart at t = 50 s"));
  // It may also turn.
  const auto turns = [&](const std::string& history) {
    return loaded("on = \"bottom\", directions = [\"x\"]",
                  "on = \"bottom\", force = [0.0, 18.5], " + history);
  };
  EXPECT_NO_THROW(this->model(turns("times = [0.0, 50.0], factors = [1.0, 0.5]")));
  EXPECT_THAT(refusal(turns("times = [0.0, 50.0, 100.0], factors = [1.0, -1.0, 1.0]")),
              HasSubstr("they pull them apart at t = 50 s"));
}

// A flat that turns about a corner: its load pulls it off along the approach, and its torque
// presses.
TEST_F(ResultChecks, TheTorqueOfALoadPresses) {
  folder_.write("flat.geo", flat_geometry(6) +
                                "Physical Curve(\"right\") = {2};\n"
                                "Physical Point(\"corner\") = {1};\n");
  const auto pulled = [&](const std::string& force) {
    return loaded("on = \"corner\"", "on = \"right\", force = " + force);
  };
  EXPECT_NO_THROW(this->model(pulled("[-5.0, -0.1]")));
  EXPECT_THAT(refusal(pulled("[5.0, 0.1]")), HasSubstr("they pull them apart at t = 0 s"));
}

// On springs so soft that friction moves the flat by more than the stroke.
TEST_F(ResultChecks, AFlatThatWouldStickIsRefused) {
  std::string soft = text(stroke);
  const std::string rigid = "support = [ { on = \"bottom\" } ]";
  const auto at = soft.find(rigid);
  ASSERT_NE(at, std::string::npos);
  const auto held_by = [&](const char* stiffness) {
    std::string changed = soft;
    return changed.replace(
        at, rigid.size(),
        std::string("support = [ { on = \"bottom\", directions = [\"y\"] }, { on = \"bottom\", "
                    "directions = [\"x\"], stiffness = ") +
            stiffness + " } ]");
  };
  EXPECT_THROW(require_model(start_of(*model(held_by("10.0")))), InputError);
  EXPECT_NO_THROW(require_model(start_of(*model(held_by("1e4")))));
}

// A shelf that wear.on does not name comes into contact as the sole wears, and carries load.
TEST_F(ResultChecks, BoundaryThatDoesNotWearTouchesToo) {
  const SceneFolder folder;
  const auto model = stepped_part(folder);
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 40000);
  const ContactSurface surface = *model->contact(run.last());
  double lowest = 1, carried = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c)
    if (surface.initial[c][0] > 5.01) {
      lowest = std::min(lowest, surface.current[c][1]);
      carried += surface.pressure[c];
      EXPECT_EQ(surface.wear_depth[c], 0);
    }
  EXPECT_GT(carried, 1);
  const Examination facts = model->examine(run.last());
  EXPECT_THAT(doubts(facts), ElementsAre());
  EXPECT_NEAR(force(facts, "contact")[1], 40, 1e-2);
}

}  // namespace
}  // namespace gnomon
