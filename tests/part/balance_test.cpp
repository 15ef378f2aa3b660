// What holds and presses a part, by name, and how far its contact reaches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>
#include <gnomon/checks/checks.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/summary.hpp>

#include "model/resultants.hpp"
#include "part/cyclic_flat.hpp"

namespace gnomon {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Balance : public Cycles {
protected:
  static State start_of(const Model& model) {
    Counters counters;
    return model.start(counters);
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }
};

const std::string sliding = "motion.velocity = [10.0, 0.0]\n[friction]\ncoefficient = 0.3";

// The forces along the normals of a cylinder go through its centre.
TEST_F(Balance, TorquesBalanceAndAreInTheHistory) {
  const auto model = this->model(replaced(text(sliding), "[0.0, 6.0]", "[0.2, 6.0]"));
  const State start = start_of(*model);
  const Examination facts = model->examine(start);
  double sum = 0;
  for (const ResultantForce& each : facts.forces) sum += each.torque[2];
  EXPECT_NEAR(sum, 0, 1e-6);
  const auto now = [&](const char* name) { return observed(*model, start, name); };
  EXPECT_NEAR(now("torque_contact_z"),
              0.2 * now("force_contact_y") - (6 - now("approach")) * now("force_contact_x"), 1e-9);
  EXPECT_NEAR(now("torque_support_1_z"), -now("torque_contact_z") - now("torque_friction_z"), 1e-6);
  EXPECT_GT(now("torque_support_1_z"), 0.1 * 18.5);
  Examination turned = facts;
  turned.forces.front().torque[2] = 2;
  EXPECT_THAT(doubts(turned), ElementsAre(HasSubstr("torques of loads, supports, springs and")));
}

// One support holds along y, springs along x: each carries its own part.
TEST_F(Balance, ReactionsAreToldBySupport) {
  const auto model = this->model(
      replaced(text(sliding), "support = [ { on = \"bottom\" } ]",
               "support = [ { on = \"bottom\", directions = [\"y\"] }, { on = \"bottom\", "
               "directions = [\"x\"], stiffness = 1e4 } ]"));
  const State start = start_of(*model);
  const double rubbed = observed(*model, start, "force_friction_x");
  EXPECT_GT(std::abs(rubbed), 0.29 * 18.5);
  EXPECT_NEAR(observed(*model, start, "force_support_1_x"), 0, 1e-12);
  EXPECT_NEAR(observed(*model, start, "force_support_1_y"), 18.5, 1e-6);
  EXPECT_NEAR(observed(*model, start, "force_support_2_x"),
              -rubbed - observed(*model, start, "force_contact_x"), 1e-6);
  EXPECT_NEAR(observed(*model, start, "force_support_2_y"), 0, 1e-12);
  const std::string told = balance_text(model->examine(start), 2);
  EXPECT_THAT(told, HasSubstr("\nreactions: support_1 (0, 18.5), support_2 ("));
  EXPECT_THAT(told, HasSubstr("\ntorques about the origin: "));
}

// Of a cylinder: as wide as Hertz' contact, but for the facets (0.8 mm / 24) at its ends.
TEST_F(Balance, TheWidthOfContactIsKnownButForTheElementsAtItsEnds) {
  const auto model = this->model(text("motion.velocity = [10.0, 0.0]"));
  const State start = start_of(*model);
  const double h = 0.8 / 24, width = observed(*model, start, "contact_area");
  EXPECT_NEAR(observed(*model, start, "contact_area_error"), h, 1e-9);
  EXPECT_NEAR(width, 2 * observed(*model, start, "contact_half_width"), h);
  EXPECT_GT(width, 4 * h);
}

// A slope of 45 degrees, 1 mm high: its contact is sqrt(2) mm wide, its projection 1 mm.
TEST_F(Balance, TheWidthOfContactIsAlongTheSurface) {
  folder_.write("flat.geo", R"(Point(1) = {0, -1, 0}; Point(2) = {2, -1, 0}; Point(3) = {2, 1, 0};
Point(4) = {1, 1, 0}; Point(5) = {0, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {4, 5}; Line(4) = {5, 1}; Line(5) = {3, 4};
Curve Loop(1) = {1, 2, 5, 3, 4};
Plane Surface(1) = {1};
Mesh.MeshSizeMax = 0.3;
Physical Curve("bottom") = {1, 2};
Physical Curve("surface") = {3};
Physical Surface("flat") = {1};
)");
  const std::string plane =
      replaced(replaced(text("motion.velocity = [10.0, 10.0]", "approach = 1e-3"),
                        "\"cylinder\"\nradius = 6.0", "\"plane\""),
               "center = [0.0, 6.0]", "normal = [1.0, -1.0]");
  const auto model = this->model(plane);
  const State start = start_of(*model);
  // The sides at its ends are in reach, too: half of their first facets may be in contact.
  EXPECT_NEAR(
      observed(*model, start, "contact_area") - observed(*model, start, "contact_area_error"),
      std::sqrt(2), 1e-6);
  EXPECT_LT(observed(*model, start, "contact_half_width"), 0.65);
}

TEST_F(Balance, ACounterBodyFarInsideIsNamed) {
  const std::string given = text("motion.velocity = [10.0, 0.0]", "approach = 1e-3");
  const auto far = model(replaced(given, "[0.0, 6.0]", "[0.0, 5.99]"));
  EXPECT_THAT(doubts(far->examine(start_of(*far))),
              Contains(::testing::AllOf(
                  HasSubstr("lies 0.01 mm inside the unloaded bodies and cannot give way"),
                  HasSubstr("they are pressed by 0.011 mm"))));
  const auto near = model(given);
  EXPECT_THAT(doubts(near->examine(start_of(*near))), ElementsAre());
  const auto apart = model(replaced(given, "[0.0, 6.0]", "[0.0, 6.2]"));
  EXPECT_THAT(doubts(apart->examine(start_of(*apart))),
              ElementsAre(HasSubstr("touch anywhere, they are 0.199 mm apart: nothing wears")));
}

// In the middle between two nodes, 0.8 mm / 24 apart: one comes 0.005 mm deep before they touch,
// one passes between them.
TEST_F(Balance, ACylinderBetweenTwoNodesIsFound) {
  const std::string thin =
      replaced(replaced(text("motion.velocity = [10.0, 0.0]", "approach = 4e-3"), "radius = 6.0",
                        "radius = 0.03"),
               "[0.0, 6.0]", "[0.0166667, 0.03]");
  const auto given = model(thin);
  EXPECT_THAT(doubts(given->examine(start_of(*given))),
              Contains(HasSubstr("lies 0.004 mm inside the counter-body, at (0.01667, 0, 0)")));
  EXPECT_THAT(refusal(replaced(thin, "radius = 0.03", "radius = 0.012")),
              HasSubstr("meets the surfaces of wear.on between their nodes alone"));
}

TEST_F(Balance, ALoadThatPullsOffIsNotTooLarge) {
  folder_.write("flat.geo", flat_geometry(6) + "Physical Curve(\"sides\") = {2, 4};\n");
  std::string pulled = replaced(text("motion.velocity = [10.0, 0.0]", ""), "on = \"bottom\"",
                                "on = \"sides\", directions = [\"x\"]");
  pulled += "\n[[load]]\non = \"bottom\"\npressure = -2.0\n";
  EXPECT_THAT(refusal(pulled), HasSubstr("expected loads that press the bodies"));
}

TEST_F(Balance, ElementsThatLockAreNamed) {
  const std::string sound = replaced(text("motion.velocity = [10.0, 0.0]"), "poisson_ratio = 0.3",
                                     "poisson_ratio = 0.4999");
  const auto locks = Contains(HasSubstr("locks at Poisson's ratio 0.4999"));
  EXPECT_THAT(model(sound)->remarks, Not(locks));
  EXPECT_THAT(model(sound, {"body.element=plain"})->remarks, locks);
  EXPECT_THAT(model(text("motion.velocity = [10.0, 0.0]"), {"body.element=plain"})->remarks,
              Not(locks));
}

TEST_F(Balance, TheLastClosedNodeWithTheLargestPressureIsFound) {
  const auto flat = model(text("motion.velocity = [10.0, 0.0]"));
  const auto& wear = dynamic_cast<const WearModel<2>&>(*flat);
  const Assembly<2>& body = wear.assembly();
  const State start = start_of(*flat);
  const Point at{.t = start.t, .y = start.y};
  const FieldValues<2> values = wear.system().values(start.t, start.y);
  std::vector<PhaseContact<2>> phases = {
      {1, wear.equations().contact_nodes(wear.system(), values, at)}};
  std::vector<ContactNode<2>>& nodes = phases.front().nodes;
  for (ContactNode<2>& node : nodes) node.traction = 0;
  for (int c = 8; c <= 12; ++c) nodes[c].traction = -1;
  nodes[12].traction = -3;
  const auto edge = edge_pressure(body, phases);
  ASSERT_TRUE(edge);
  EXPECT_EQ(edge->pressure, 3);
  EXPECT_EQ(edge->inside, 1);
  EXPECT_EQ(edge->position[0], body.mesh.nodes[body.contact_nodes[12].node][0]);
  nodes[10].traction = -4;
  EXPECT_FALSE(edge_pressure(body, phases));
}

TEST(EdgePressures, AreToldWithTheFigure) {
  Examination facts{.forces = {{"contact", {0, 20, 0}}, {"supports", {0, -20, 0}}}};
  facts.size = 1;
  facts.edge = EdgePressure{.position = {1, 2, 0}, .pressure = 10.4, .inside = 10};
  EXPECT_THAT(doubts(facts), ElementsAre());
  facts.edge->pressure = 12.4;
  EXPECT_THAT(doubts(facts), ElementsAre(HasSubstr("largest pressure, 12.4 MPa, is that of the "
                                                   "last node in contact, at (1, 2, 0), and")));
}

}  // namespace
}  // namespace gnomon
