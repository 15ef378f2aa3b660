// Wear as a gap, and the stiffness condensed to the contact nodes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gnomon/model/controlled_settings.hpp>
#include <gnomon/run/run.hpp>

#include "part/part_scene.hpp"
#include "run/guards.hpp"

namespace gnomon {
namespace gap_test {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const Overrides free = {"shape.motion=gap", "body.material=linear"},
                gap = {"shape.motion=gap", "body.material=linear", "body.element=plain",
                       "solver.reduce=false"};

Overrides with(Overrides overrides, const Overrides& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}
Overrides condensed(Overrides overrides) {
  std::erase(overrides, "solver.reduce=false");
  return with(overrides, {"solver.reduce=true"});
}

/// In the plane, in a bore with a free shaft, of revolution, over a cycle, in space with friction;
/// pairs over a cycle of strokes, of turns, along a track, of revolution, that stick.
struct Case {
  std::string scene;
  double end;
  Overrides more = {};
  std::vector<std::string> bodies = {};  ///< of pairs

  Overrides linear() const {
    Overrides result;
    for (const std::string& body : bodies) {
      result.push_back("body." + body + ".material=linear");
      result.push_back("body." + body + ".element=plain");
    }
    return result.empty() ? Overrides{"body.material=linear", "body.element=plain"} : result;
  }
};
const std::vector<Case> cases = {
    {"worn_body/block_on_ring.toml", 1600, {"mesh.factor=2"}},
    {"worn_body/journal.toml", 200, {"mesh.factor=2"}},
    {"worn_body/pin_on_disc_axisymmetric.toml", 100},
    {"worn_body/cylinder_on_flat.toml", 2000, {"cycle.phases=4"}},
    {"ball_on_flat/small_deformation.toml",
     100,
     {"mesh.elements=[4,3,2]", "wear.normal=conservative"}},
    {"worn_body/cylinder_and_flat.toml",
     2000,
     {"mesh.factor=4", "cycle.phases=3"},
     {"cylinder", "flat"}},
    {"worn_body/gear_teeth.toml", 1000, {"mesh.factor=3", "cycle.phases=6"}, {"driver", "driven"}},
    {"worn_body/pin_on_track.toml", 100, {"mesh.factor=2"}, {"pin", "disc"}},
    {"worn_body/sphere_on_disc.toml", 100, {"mesh.factor=2"}, {"pin", "disc"}},
    {"worn_body/fretting_pair.toml",
     2000,
     {"mesh.factor=4", "cycle.phases=4"},
     {"cylinder", "flat"}},
};

std::unique_ptr<Model> gap_model(const Case& of) {
  return model_of(of.scene,
                  with(with({"shape.motion=gap", "solver.reduce=false"}, of.linear()), of.more));
}
std::unique_ptr<Model> condensed_model(const Case& of) {
  return model_of(of.scene,
                  with(with({"shape.motion=gap", "solver.reduce=true"}, of.linear()), of.more));
}

TEST(Gap, IsCondensedWhereThatPays) {
  const auto size = [](const std::string& scene, const Overrides& overrides) {
    return model_of(scene, overrides)->system().structure().size;
  };
  const std::string ring = "worn_body/block_on_ring.toml",
                    ball = "ball_on_flat/small_deformation.toml";
  EXPECT_EQ(size(ring, free), size(ring, condensed(free)));
  EXPECT_LT(size(ring, free), size(ring, gap) / 2);
  EXPECT_EQ(size(ring, {"shape.motion=gap", "body.material=neo-hookean"}), size(ring, gap));
  // Most of its nodes may touch.
  const Overrides flat = {"mesh.elements=[8,2,1]", "wear.normal=conservative"};
  EXPECT_EQ(size(ball, with(free, flat)), size(ball, with(gap, flat)));
}

class RoundPin : public PartScenes {};

ModelRun run_of(const Model& model, const Case& of) {
  return run_model(model, "backward-euler", of.end / 4, 1e-3, of.end);
}

/// The rate at which the shape of a state loses volume.
double rate_of_loss(const Model& model, State state, double h) {
  const std::vector<double> y = state.y;
  const auto worn = [&](double by) {
    for (std::size_t i = 0; i < y.size(); ++i) state.y[i] = y[i] + by * state.ydot[i];
    return observed(model, state, "worn_volume");
  };
  return (worn(h) - worn(-h)) / (2 * h);
}

TEST(GapMotion, LosesTheVolumeThatWears) {
  for (const Case& of : cases) {
    SCOPED_TRACE(of.scene);
    const auto model = gap_model(of);
    const ModelRun run = run_of(*model, of);
    const double flux = observed(*model, run.last(), "wear_flux");
    ASSERT_GT(flux, 0);
    EXPECT_NEAR(rate_of_loss(*model, run.last(), 1e-2 * of.end) / flux, 1, 1e-6);
  }
}

TEST(GapMotion, LeavesTheMesh) {
  const auto model = gap_model(cases.front());
  const ModelRun run = run_of(*model, cases.front());
  EXPECT_GT(observed(*model, run.last(), "wear_depth"), 0.01);
  EXPECT_EQ(observed(*model, run.last(), "element_volume"), 1);
  EXPECT_EQ(observed(*model, run.last(), "element_quality"),
            observed(*model, run.states.front(), "element_quality"));
}

// Where the worn slope is small, the moving mesh changes the depth by its square at most
// (a slope of 0.066 at the end of the run).
TEST(GapMotion, AgreesWithAMovingMesh) {
  const Case& of = cases.front();
  const auto moving =
      model_of(of.scene, with(of.more, {"body.material=linear", "body.element=plain"}));
  const auto fixed = gap_model(of);
  const auto depth = [&](const Model& model) {
    return observed(model, run_model(model, "esdirk-4", 0, 1e-6, of.end).last(), "wear_depth");
  };
  EXPECT_NEAR(depth(*fixed) / depth(*moving), 1, 1e-4);
}

// Behind its rim are the sides of the pin, along which the normal runs.
TEST_F(RoundPin, IsAsThickAtItsRimAsElsewhere) {
  folder_.write("pin.geo", R"(SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 4, 3, Pi}; Mesh.MeshSizeMax = 2.4;
Physical Volume("pin") = {1}; Physical Surface("tip") = {3}; Physical Surface("holder") = {2};
Physical Surface("middle") = {4};
)");
  const auto pin = model(R"(
problem = "worn_body"
mesh.file = "pin.geo"
body = { young_modulus = 1000.0, poisson_ratio = 0.3, material = "linear" }
support = [ { on = "holder" }, { on = "middle", directions = ["y"] } ]
shape.motion = "gap"
wear = { on = ["tip"], coefficient = 1e-6 }
time.end = 1000.0
[counter_body]
shape = "plane"
normal = [0.0, 0.0, 1.0]
center = [0.0, 0.0, 0.0]
motion = { velocity = [100.0, 0.0, 0.0] }
press = { direction = [0.0, 0.0, 1.0], force = 28.2743 }
)");
  const State end = run_model(*pin, "backward-euler", 250, 1e-3, 1000).last();
  EXPECT_NEAR(1 - observed(*pin, end, "wear_depth") / 4, observed(*pin, end, "thickness_left"),
              1e-6);
}

/// Flanks that a moving mesh carries along stay where they are, and take the load.
TEST_F(RoundPin, ForceOnBoundaryThatDoesNotWearIsTold) {
  folder_.write("foot.geo", R"(
Point(1) = {-3, 0, 0, 0.2}; Point(2) = {3, 0, 0, 0.2}; Point(3) = {8, 6, 0, 2}; Point(4) = {-8, 6, 0, 2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1}; Recombine Surface {1};
Physical Curve("foot") = {1}; Physical Curve("top") = {3}; Physical Surface("block") = {1};
)");
  const std::string text = R"(
problem = "worn_body"
mesh.file = "foot.geo"
body = { young_modulus = 2000.0, poisson_ratio = 0.3, material = "linear" }
support = [ { on = "top" } ]
wear = { on = ["foot"], coefficient = 3e-8 }
time.end = 4000.0
[counter_body]
shape = "plane"
normal = [0.0, 1.0]
center = [0.0, 0.0]
motion = { velocity = [300.0, 0.0] }
press = { direction = [0.0, 1.0], force = 60.0 }
)";
  const double k_F_v_t = 3e-8 * 60 * 300 * 4000;
  for (const std::string motion : {"gap", "mesh"}) {
    const auto block = model(text, {"shape.motion=" + motion});
    const RunOutcome outcome = run(*block, Integrators::find("esdirk-3", "integrator"),
                                   controlled_settings(*block, 1e-3, 4000), {}, nullptr, {});
    const Model& last = outcome.successor ? *outcome.successor : *block;
    const double worn = observed(last, *outcome.state, "worn_volume") / k_F_v_t;
    const auto told = Contains(HasSubstr("of the contact force is on boundary that does not wear"));
    if (motion == "gap") {
      EXPECT_LT(worn, 0.9);
      EXPECT_THAT(outcome.warnings, told);
    } else {
      EXPECT_NEAR(worn, 1, 1e-3);
      EXPECT_THAT(outcome.warnings, Not(told));
    }
  }
}

// A moving mesh would end with elements that are worn away.
TEST(GapMotion, EndsWhereABodyIsWornThrough) {
  const Case& of = cases.front();
  const auto model = gap_model(of);
  const ModelRun run = run_of(*model, of);
  const double depth = observed(*model, run.last(), "wear_depth"),
               left = observed(*model, run.last(), "thickness_left");
  EXPECT_NEAR(depth / (1 - left), 4, 1e-6);  // the height of the block
  EXPECT_NO_THROW(require_sound_mesh(model->observe(run.last())));
  EXPECT_THROW(require_sound_mesh({{"thickness_left", "", -1e-3}}), SolutionError);
  EXPECT_THAT(mesh_warnings({{"thickness_left", "", 0.05}}, 1),
              ::testing::ElementsAre(::testing::Field(
                  &MeshWarning::text, ::testing::HasSubstr("worn down to 0.05 of its thickness"))));
}

// Nodes of a side that the wear has passed lie in the counter-body, and are no boundary any more.
TEST(GapMotion, DoesNotMissWhatIsWornAway) {
  const auto model =
      model_of("worn_body/disc_clutch_axisymmetric.toml", with(gap, {"mesh.factor=0.25"}));
  const ModelRun run = run_model(*model, "backward-euler", 5000, 1e-3, 20000);
  EXPECT_GT(observed(*model, run.last(), "wear_depth"), 0.1);
  EXPECT_FALSE(model->examine(run.last()).intrusion);
}

TEST(GapMotion, IsProposedWhereItDoes) {
  const Overrides linear = {"body.material=linear"};
  EXPECT_THAT(model_of("worn_body/block_on_ring.toml", linear)->proposals,
              Contains(HasSubstr("wear as a gap would do")));
  EXPECT_TRUE(model_of("worn_body/block_on_ring.toml")->proposals.empty());  // finite strains
  const Overrides deep = with(linear, {"wear.coefficient=2e-6"});
  EXPECT_TRUE(model_of("worn_body/block_on_ring.toml", deep)->proposals.empty());
  EXPECT_THAT(model_of("worn_body/block_on_ring.toml", with(deep, {"shape.motion=gap"}))->remarks,
              Contains(HasSubstr("use shape.motion = \"mesh\"")));
}

// The estimate is that of a model whose mesh moves, brought to the same shape; it grows with the
// slope and vanishes where nothing has worn.
TEST(GapMotion, TellsWhatAMovingMeshWouldChange) {
  const auto model = condensed_model(cases.front());
  const ModelRun run = run_of(*model, cases.front());
  const auto change = [&](const State& state) {
    const auto error = model->examine(state).gap_error;
    EXPECT_TRUE(error && error->failure.empty());
    return error ? error->pressure : 0;
  };
  State early = run.states[1];
  EXPECT_GT(change(early), 0);
  EXPECT_GT(change(run.last()), change(early));
  EXPECT_LT(change(run.last()), 0.02);
}

/// Largest difference of two lists, by the largest of the second.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0, size = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    most = std::max(most, std::abs(a[k] - b[k]));
    size = std::max(size, std::abs(b[k]));
  }
  return size > 0 ? most / size : most;
}

/// All that is observed of two models after the same fixed steps: shape, pressures, displacements
/// and stresses of the whole body, forces of supports.
void expect_same_runs(const Model& reduced, const Model& whole, const Case& of) {
  const ModelRun a = run_of(reduced, of), b = run_of(whole, of);
  const ContactSurface mine = reduced.contact(a.last()).value(),
                       others = whole.contact(b.last()).value();
  ASSERT_GT(*std::ranges::max_element(others.wear_depth), 0);
  EXPECT_LT(difference(mine.wear_depth, others.wear_depth), 1e-8);
  EXPECT_LT(difference(mine.pressure, others.pressure), 1e-7);
  const auto fields = reduced.fields(a.last()), expected = whole.fields(b.last());
  ASSERT_EQ(fields.size(), expected.size());
  for (std::size_t k = 0; k < fields.size(); ++k)
    EXPECT_LT(difference(fields[k].values, expected[k].values), 1e-7) << fields[k].name;
  const Observation scalars = reduced.observe(a.last()), wanted = whole.observe(b.last());
  ASSERT_EQ(scalars.size(), wanted.size());
  const double force = observed(whole, b.last(), "contact_force");
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    EXPECT_EQ(scalars[k].name, wanted[k].name);
    if (scalars[k].name.starts_with("torque_")) continue;
    const bool is_force =
        scalars[k].name.starts_with("force_") || scalars[k].name.starts_with("guide_");
    const double size = is_force ? force : std::abs(wanted[k].value);
    EXPECT_NEAR(scalars[k].value, wanted[k].value, 1e-6 * size + 1e-12) << scalars[k].name;
  }
}

TEST(Condensation, HasTheSolutionOfAllDisplacements) {
  for (const Case& of : cases) {
    SCOPED_TRACE(of.scene);
    expect_same_runs(*condensed_model(of), *gap_model(of), of);
  }
}

TEST(Condensation, HasFewUnknowns) {
  const Case& of = cases.front();
  const auto model = condensed_model(of);
  const long nodes = static_cast<long>(
      model->contact(model->start(*std::make_unique<Counters>())).value().node.size());
  EXPECT_LE(model->system().structure().size, 5 * nodes + 1);
}

TEST(Condensation, JacobianIsTheDerivative) {
  for (const Case& of : {cases[1], cases[3], cases[6], cases[9]}) {
    SCOPED_TRACE(of.scene);
    const auto model = condensed_model(of);
    const ModelRun run = run_of(*model, of);
    const ActiveSet branch = active_set(model->system(), run.last().t, run.last().y);
    check_jacobian(model->system(), run.last().t, run.last().y, 0.7, &branch);
  }
}

TEST(Condensation, EveryMethodFindsTheSameWear) {
  const Case& of = cases.front();
  const auto model = condensed_model(of);
  const double depth =
      observed(*model, run_model(*model, "esdirk-4", 0, 1e-7, of.end).last(), "wear_depth");
  for (const std::string method : {"bdf", "esdirk-3", "sdirk-2", "erk-3"}) {
    SCOPED_TRACE(method);
    const State end = run_model(*model, method, 0, 1e-5, of.end).last();
    EXPECT_NEAR(observed(*model, end, "wear_depth") / depth, 1, 1e-4);
  }
  const State located = run_model(*model, "esdirk-4", 0, 1e-6, of.end, true).last();
  EXPECT_NEAR(observed(*model, located, "wear_depth") / depth, 1, 1e-5);
}

// Springs whose ends move, a support that moves and two loads with histories.
class CondensedLoads : public PartScenes {};

TEST_F(CondensedLoads, ActAsOnAllDisplacements) {
  folder_.write("block.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 4, 2};
Transfinite Curve {1, 3} = 9; Transfinite Curve {2, 4} = 5; Transfinite Surface {1};
Recombine Surface {1};
Physical Curve("sole") = {1}; Physical Curve("right") = {2}; Physical Curve("back") = {3};
Physical Curve("left") = {4}; Physical Surface("body") = {1};
)");
  const std::string text = R"(problem = "worn_body"
mesh.file = "block.geo"
body = { young_modulus = 1000.0, poisson_ratio = 0.3 }
wear = { on = "sole", coefficient = 1e-7 }
friction.coefficient = 0.1
time.end = 1000.0
integrator = { name = "esdirk-3", rtol = 1e-3 }
[[support]]
on = "left"
directions = ["x"]
value = [0.001]
times = [0.0, 1000.0]
factors = [1.0, 3.0]
[[support]]
on = "right"
stiffness = 20.0
value = [0.002, 0.0]
[[load]]
on = "back"
force = [0.0, -30.0]
times = [0.0, 500.0, 1000.0]
factors = [1.0, 2.0, 1.0]
[[load]]
on = "right"
traction = [0.5, 0.2]
[counter_body]
shape = "cylinder"
radius = 50.0
center = [2.0, -50.0]
motion = { velocity = [100.0, 0.0] }
)";
  const Case of{"", 1000};
  expect_same_runs(*model(text, condensed(gap)), *model(text, gap), of);
}

TEST(GapMotion, RefusesWhatItCannotKeep) {
  const auto refusal = [](const std::string& scene, const Overrides& overrides) -> std::string {
    try {
      model_of(scene, overrides);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string pin = "pin_on_flat/small_deformation.toml";
  EXPECT_THAT(refusal(pin, {"shape.motion=gap"}), HasSubstr("wear.normal: expected"));
  EXPECT_THAT(
      refusal(pin, {"shape.motion=gap", "wear.normal=conservative", "shape.constraint=multiplier"}),
      HasSubstr("shape.constraint: expected"));
  EXPECT_THAT(refusal(pin, {"solver.reduce=true"}), HasSubstr("expected shape.motion"));
  EXPECT_THAT(refusal(pin, {"shape.motion=gap", "wear.normal=conservative", "solver.reduce=true"}),
              HasSubstr("body.material = \"linear\""));
  EXPECT_THAT(refusal("worn_body/lining.toml", {"shape.motion=gap", "solver.reduce=true"}),
              HasSubstr("do not follow the surface"));
}

}  // namespace gap_test
}  // namespace gnomon
