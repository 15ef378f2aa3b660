// A surface that wears by the mean along its track: what it loses, on either side of a pair, in the
// plane and in space.

#include <cmath>
#include <gnomon/checks/checks.hpp>
#include <gnomon/model/gap_motion.hpp>

#include "support/problem_run.hpp"
#include "support/rough_state.hpp"
#include "support/two_bodies.hpp"

namespace gnomon::track_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;

/// The surface wears by the mean along a path, with the sliding along x.
template <int dim>
AssemblyParts<dim> with_track(AssemblyParts<dim> parts, const std::string& name, double path) {
  for (Surface<dim>& surface : parts.interface.surfaces) {
    if (surface.name != name) continue;
    surface.track = Track<dim>{{Vector<dim>::Unit(0)}, path};
    for (const auto& facet : surface.facets)
      for (const int node : facet) parts.shape.held(node, 0) = 1;
  }
  return parts;
}

/// A round pin, smaller than the flat block below, whose surface is the track; stiff, so that
/// forces are those on the undeformed bodies to six digits.
TwoBodies pin_on_track(bool track_is_slave) {
  TwoBodies pair{.upper = {.along = 8, .high = 4, .from = 0.5, .to = 1.5, .young_modulus = 1e6},
                 .lower = {.along = 12, .high = 4, .young_modulus = 1e6},
                 .force = 20,
                 .friction = 0.2,
                 .lower_is_slave = track_is_slave};
  pair.upper.surface = [](double x) { return 0.01 * (x - 1) * (x - 1); };
  pair.upper.wear = 1e-6, pair.lower.wear = 4e-6;
  return pair;
}

/// The least and the largest depth on a side of the pair.
template <int dim>
std::pair<double, double> depths(const WearModel<dim>& model, const State& state, bool slave) {
  const ContactSurface surface = model.contact(state).value();
  double low = 1e9, high = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c)
    if (bool(model.assembly().carries[c]) == slave)
      low = std::min(low, surface.wear_depth[c]), high = std::max(high, surface.wear_depth[c]);
  return {low, high};
}

TEST(Track, JacobianEqualsCentralDifferences) {
  for (const bool track_is_slave : {false, true})
    for (const NormalRule normal : {NormalRule::averaged, NormalRule::conservative}) {
      SCOPED_TRACE(::testing::Message() << track_is_slave << int(normal));
      TwoBodies pair{.upper = {.along = 4, .high = 2, .wear = 1e-3},
                     .lower = {.along = 5, .high = 2, .wear = 2e-3},
                     .friction = 0.3,
                     .normal = normal,
                     .lower_is_slave = track_is_slave};
      const WearModel<2> model(
          std::make_shared<const Assembly<2>>(with_track(two_bodies<2>(pair), "lower top", 5)));
      check_jacobian(model.system(), 0, rough_state(model, {.every = 3}), 0.2, nullptr, 1e-6);
    }
}

TEST(Track, JacobianEqualsCentralDifferencesInSpace) {
  for (const bool track_is_slave : {false, true}) {
    SCOPED_TRACE(track_is_slave);
    TwoBodies pair{.upper = {.along = 2, .high = 1, .across = 2, .wear = 1e-3},
                   .lower = {.along = 3, .high = 1, .across = 1, .from = 0.1, .wear = 2e-3},
                   .friction = 0.3,
                   .lower_is_slave = track_is_slave};
    const WearModel<3> model(
        std::make_shared<const Assembly<3>>(with_track(two_bodies<3>(pair), "lower top", 5)));
    check_jacobian(model.system(), 0, rough_state(model, {.every = 3}), 0.2, nullptr, 1e-6);
  }
}

/// What both bodies of a pair have lost, with the whole of the track of the lower one, by k F v t.
template <int dim>
void expect_volumes(const WearModel<dim>& model, const State& end, const TwoBodies& pair,
                    double tolerance) {
  const Observation observed = model.observe(end);
  const double slid = pair.force * pair.speed * pair.duration;
  EXPECT_NEAR(*value_of(observed, "worn_volume_upper") / (pair.upper.wear * slid), 1, tolerance);
  EXPECT_NEAR(*value_of(observed, "worn_volume_lower") / (pair.lower.wear * slid), 1, tolerance);
  EXPECT_NEAR(*value_of(observed, "worn_volume_lower") / pair.lower.wear /
                  (*value_of(observed, "worn_volume_upper") / pair.upper.wear),
              1, 2e-6);
  EXPECT_NEAR(*value_of(observed, "wear_flux_lower") * pair.duration / (pair.lower.wear * slid), 1,
              tolerance);
  EXPECT_NEAR(*value_of(observed, "worn_volume") / (*value_of(observed, "worn_volume_upper") +
                                                    *value_of(observed, "worn_volume_lower")),
              1, 1e-12);
}

TEST(Track, RecedesUniformlyByTheMean) {
  constexpr double path = 20;
  for (const bool track_is_slave : {false, true}) {
    SCOPED_TRACE(track_is_slave);
    const TwoBodies pair = pin_on_track(track_is_slave);
    const WearModel<2> model(
        std::make_shared<const Assembly<2>>(with_track(two_bodies<2>(pair), "lower top", path)));
    const State end = run_model(model, "esdirk-4", 0, 1e-6, pair.duration).last();
    expect_volumes(model, end, pair, 2e-6);
    const auto [low, high] = depths(model, end, track_is_slave);
    EXPECT_NEAR(high / low, 1, 1e-12);
    const double worn = pair.lower.wear * pair.force * pair.speed * pair.duration;
    EXPECT_NEAR(high * path / worn, 1, 2e-6);
  }
}

// As of two discs that slide on each other: both stay flat.
TEST(Track, MayBeOnBothBodies) {
  TwoBodies pair = pin_on_track(false);
  pair.upper.surface = [](double) { return 0.0; };
  const WearModel<2> model(std::make_shared<const Assembly<2>>(
      with_track(with_track(two_bodies<2>(pair), "lower top", 20), "bottom", 6)));
  const State end = run_model(model, "esdirk-3", 0, 1e-6, pair.duration).last();
  expect_volumes(model, end, pair, 2e-6);
  const double slid = pair.force * pair.speed * pair.duration;
  EXPECT_NEAR(depths(model, end, true).second / (pair.upper.wear * slid / 6), 1, 2e-6);
  EXPECT_NEAR(depths(model, end, false).second / (pair.lower.wear * slid / 20), 1, 2e-6);
}

/// The end of the pin is also round across the track.
AssemblyParts<3> round_pin_on_track(const TwoBodies& pair, double path) {
  AssemblyParts<3> parts = two_bodies<3>(pair);
  for (const int node : parts.mesh.boundary_nodes("bottom")) {
    const double y = parts.mesh.nodes[static_cast<std::size_t>(node)][1];
    parts.mesh.nodes[static_cast<std::size_t>(node)][2] += 0.002 * y * y;
  }
  return with_track(std::move(parts), "lower top", path);
}

/// -1: there is no node.
double depth_at(const WearModel<3>& model, const State& state, const Vector<3>& place) {
  const std::vector<Vector<3>>& nodes = model.assembly().mesh.nodes;
  const auto at = std::ranges::find_if(
      nodes, [&](const Vector<3>& node) { return (node - place).norm() < 1e-9; });
  if (at == nodes.end()) return -1;
  return model.system()
      .values(state.t, state.y)
      .vector(model.equations().fields().d)
      .row(at - nodes.begin())
      .norm();
}

// A groove, uniform along its lines, and deepest under the middle of the pin.
TEST(Track, HasAProfileAcrossInSpace) {
  for (const bool track_is_slave : {false, true}) {
    SCOPED_TRACE(track_is_slave);
    TwoBodies pair = pin_on_track(track_is_slave);
    pair.upper.along = 3, pair.upper.high = 2, pair.upper.across = 4;
    pair.lower.along = 5, pair.lower.high = 2, pair.lower.across = 3;
    pair.upper.young_modulus = pair.lower.young_modulus = 5e4;
    pair.lower.wear = 2e-5;
    const WearModel<3> model(std::make_shared<const Assembly<3>>(round_pin_on_track(pair, 20)));
    const State end = run_model(model, "sdirk-2", 20, 0, pair.duration).last();
    expect_volumes(model, end, pair, 5e-5);
    double before = 1;
    for (const double y : {0.0, 1.0 / 3, 2.0 / 3, 1.0}) {
      const double depth = depth_at(model, end, {0, y, 0});
      for (const double x : {0.4, 0.8, 1.2, 1.6, 2.0})
        EXPECT_NEAR(depth_at(model, end, {x, y, 0}), depth, 1e-12 * depth);
      EXPECT_LT(depth, before);
      before = depth;
    }
    EXPECT_GT(before, 0);
  }
}

/// The pair bent about the z axis: the shape moves along that alone.
AssemblyParts<3> ring_of(const TwoBodies& pair, double path) {
  constexpr double radius = 2, angle = 0.3;
  AssemblyParts<3> parts = two_bodies<3>(pair);
  for (Vector<3>& x : parts.mesh.nodes) {
    const double r = radius + x[1], turn = angle * (x[0] - 1);
    x = Vector<3>(r * std::sin(turn), r * std::cos(turn), x[2]);
  }
  parts.shape.held.leftCols<2>().setOnes();
  const double rate = pair.lower_is_slave ? 1 : -1;  // of the master; the lower one turns along x
  parts.pairs.front().motion =
      rigid_motion<3>(Vector<3>::Zero(), spin_about(Vector<3>::UnitZ(), rate), Vector<3>::Zero());
  parts.interface.surfaces.back().track = Track<3>{{Vector<3>::UnitZ(), Vector<3>::Zero()}, path};
  return parts;
}

// Each circle has a path of its own, in proportion to its radius.
TEST(Track, MayBeRound) {
  constexpr double part = 0.05;  // of the circles in the mesh, 0.6 rad
  for (const bool track_is_slave : {false, true}) {
    SCOPED_TRACE(track_is_slave);
    TwoBodies pair{.upper = {.along = 2, .high = 1, .across = 3, .from = 0.5, .to = 1.5},
                   .lower = {.along = 3, .high = 2, .across = 2},
                   .friction = 0.2,
                   .lower_is_slave = track_is_slave};
    pair.upper.wear = 1e-5, pair.lower.wear = 8e-5;
    const WearModel<3> model(std::make_shared<const Assembly<3>>(ring_of(pair, 0.6 * 2.5 / part)));
    check_jacobian(model.system(), 0, rough_state(model, {.every = 3}), 0.2, nullptr, 1e-6);
    const State end = run_model(model, "sdirk-2", 20, 0, pair.duration).last();
    const Observation observed = model.observe(end);
    EXPECT_NEAR(*value_of(observed, "worn_volume_lower") / *value_of(observed, "worn_volume_upper"),
                8, 1e-6);
    for (const double r : {2.0, 2.5, 3.0}) {
      const double depth = depth_at(model, end, {-r * std::sin(0.3), r * std::cos(0.3), 0});
      EXPECT_NEAR(depth_at(model, end, {r * std::sin(0.3), r * std::cos(0.3), 0}), depth,
                  1e-12 * depth);
      EXPECT_GT(depth, 0);
    }
  }
}

/// A pair as concentric arcs; the lower one turns, and its rim wears by the mean along it, each
/// node along its radius.
template <int dim>
AssemblyParts<dim> arcs_of(const TwoBodies& pair, double path) {
  constexpr double radius = 2, angle = 0.3;
  AssemblyParts<dim> parts = two_bodies<dim>(pair);
  for (Vector<dim>& x : parts.mesh.nodes) {
    const double r = radius + x[dim - 1], turn = angle * (x[0] - 1);
    x[0] = r * std::sin(turn), x[dim - 1] = r * std::cos(turn);
  }
  const double rate = pair.lower_is_slave ? -1 : 1;  // of the master
  Tensor<dim> spin = Tensor<dim>::Zero();
  spin(0, dim - 1) = rate, spin(dim - 1, 0) = -rate;
  parts.pairs.front().motion = rigid_motion<dim>(Vector<dim>::Zero(), spin, Vector<dim>::Zero());
  const Vector<dim> axis = (dim - 2) * Vector<dim>::Unit(1);
  Surface<dim>& rim = parts.interface.surfaces.back();
  rim.track = Track<dim>{{axis, Vector<dim>::Zero()}, path};
  NodalFlags<dim> held = NodalFlags<dim>::Ones(parts.shape.held.rows(), dim);
  for (const int node : parts.mesh.boundary_nodes("bottom"))
    held.row(node) = parts.shape.held.row(node);
  parts.shape.held = std::move(held);
  for (const auto& facet : rim.facets)
    for (const int node : facet) {
      const Vector<dim> along = rim.track->along.across(parts.mesh.nodes[node]).col(0);
      parts.shape.held.row(node).setZero();
      if (dim == 3) parts.shape.held(node, 1) = 1;
      parts.shape.along[node] = along * along.transpose();
    }
  return parts;
}

/// Nodes of the rim move by different vectors, but along a circle by one depth.
template <int dim>
void expect_round_rim(const WearModel<dim>& model, const State& end) {
  const Surface<dim>& rim = model.assembly().interface.surfaces.back();
  const NodalField<dim> d =
      model.system().values(end.t, end.y).vector(model.equations().fields().d);
  const auto& nodes = model.assembly().mesh.nodes;
  for (const auto& line :
       lines_of_surface(model.assembly().mesh, rim.facets, rim.track->along).nodes) {
    const double first = d.row(line.front()).norm();
    EXPECT_GT(first, 0);
    for (const int node : line) {
      const Vector<dim> out = rim.track->along.across(nodes[node]).col(0);
      EXPECT_LE((d.row(node).transpose() + first * out).norm(), 1e-12 * first);
    }
  }
}

template <int dim>
void expect_rim_wears(bool track_is_slave, bool gap) {
  SCOPED_TRACE(::testing::Message() << dim << track_is_slave << gap);
  TwoBodies pair{.upper = {.along = 3, .high = 2, .across = 2, .from = 0.5, .to = 1.5},
                 .lower = {.along = 3, .high = 2, .across = 1},
                 .friction = 0.2,
                 .lower_is_slave = track_is_slave};
  pair.upper.wear = 1e-5, pair.lower.wear = 8e-5;
  AssemblyParts<dim> parts = arcs_of<dim>(pair, 12);  // ten times the rim of the mesh
  if (gap) parts.shape = gap_motion(parts);
  const WearModel<dim> model(std::make_shared<const Assembly<dim>>(std::move(parts)));
  check_jacobian(model.system(), 0, rough_state(model, {.every = 3}), 0.2, nullptr, 1e-6);
  const State end = run_model(model, "sdirk-2", 20, 0, pair.duration).last();
  const Observation observed = model.observe(end);
  EXPECT_NEAR(*value_of(observed, "worn_volume_lower") / *value_of(observed, "worn_volume_upper"),
              8, 3e-5);
  expect_round_rim(model, end);
}

TEST(Track, OfARimHasDerivativesWithAveragedNormals) {
  TwoBodies pair{.upper = {.along = 3, .high = 2, .from = 0.5, .to = 1.5, .wear = 1e-3},
                 .lower = {.along = 3, .high = 2, .wear = 2e-3},
                 .friction = 0.2,
                 .normal = NormalRule::averaged};
  AssemblyParts<2> parts = arcs_of<2>(pair, 12);
  // The mesh follows, too.
  for (Eigen::Index node = 0; node < parts.shape.held.rows(); ++node)
    if (!parts.shape.along.contains(static_cast<int>(node))) parts.shape.held.row(node).setZero();
  const WearModel<2> model(std::make_shared<const Assembly<2>>(std::move(parts)));
  check_jacobian(model.system(), 0, rough_state(model, {.every = 3}), 0.2, nullptr, 1e-6);
}

TEST(Track, MayBeARim) {
  for (const bool track_is_slave : {false, true})
    for (const bool gap : {false, true}) {
      expect_rim_wears<2>(track_is_slave, gap);
      expect_rim_wears<3>(track_is_slave, gap);
    }
}

// Where all of the mesh is in contact, and the path is no longer, the mean is what each node wears.
TEST(Track, OfUniformPressureWearsAsWithoutOne) {
  for (const bool track_is_slave : {false, true}) {
    TwoBodies pair{.upper = {.along = 3, .high = 2, .across = 2, .wear = 1e-5},
                   .lower = {.along = 2, .high = 2, .across = 3, .wear = 2e-5},
                   .lower_is_slave = track_is_slave};
    const WearModel<3> mean(
        std::make_shared<const Assembly<3>>(with_track(two_bodies<3>(pair), "lower top", 2)));
    const WearModel<3> each(two_bodies<3>(pair));
    const State end = run_model(mean, "sdirk-2", 25, 0, pair.duration).last(),
                expected = run_model(each, "sdirk-2", 25, 0, pair.duration).last();
    EXPECT_NEAR(depths(mean, end, track_is_slave).second,
                depths(each, expected, track_is_slave).second, 1e-12);
    EXPECT_NEAR(*value_of(mean.observe(end), "worn_volume_lower"),
                *value_of(each.observe(expected), "worn_volume_lower"), 1e-12);
  }
}

/// Of a flat block above a track, whose left end is at 0.
template <int dim>
std::string touched_end(double from) {
  const TwoBodies pair{.upper = {.along = 2, .high = 1, .across = 1, .from = from, .to = 1.5},
                       .lower = {.along = 5, .high = 1, .across = 2}};
  const WearModel<dim> wear(
      std::make_shared<const Assembly<dim>>(with_track(two_bodies<dim>(pair), "lower top", 20)));
  const Model& model = wear;
  Counters counters;
  return model.examine(model.start(counters)).touched_end;
}

TEST(Track, WhoseEndIsTouchedIsTold) {
  EXPECT_EQ(touched_end<2>(0.5), "");
  EXPECT_EQ(touched_end<2>(0), "lower top");
  EXPECT_EQ(touched_end<3>(0.5), "");
  EXPECT_EQ(touched_end<3>(0), "lower top");
  // Of the first facet a twentieth, from 0.4, or all but that.
  EXPECT_EQ(touched_end<2>(0.38), "");
  EXPECT_EQ(touched_end<3>(0.38), "");
  EXPECT_EQ(touched_end<2>(0.02), "lower top");
  Examination facts{.touched_end = "rim"};
  EXPECT_THAT(doubts(facts), Contains(HasSubstr("contact reaches an end of the mesh of \"rim\"")));
}

constexpr const char* scene = "worn_body/pin_on_track.toml";

TEST(TrackScene, ThePinAndTheDiscLoseWhatTheirLawsSay) {
  const auto model = model_of(scene, {"mesh.factor=3"});
  const State end = run_model(*model, "esdirk-3", 0, 1e-3, 2000).last();
  const double slid = 100.0 * 100 * 2000;
  EXPECT_NEAR(observed(*model, end, "worn_volume_pin") / (1e-8 * slid), 1, 3e-4);
  EXPECT_NEAR(observed(*model, end, "worn_volume_disc") / (1e-7 * slid), 1, 3e-4);
  EXPECT_LT(model->examine(end).lost_wear, 1e-12);
  EXPECT_THAT(model->remarks,
              Contains(HasSubstr("\"track\" wears by the mean along its track of 251.3 mm: its "
                                 "mesh is 8 mm of it, and contact covers about 1")));
}

// dR = -k F omega dt / (2 pi), because the speed is omega R. The force by the undeformed area of a
// curved surface is larger by 7e-4.
TEST(TrackScene, ARingBelowABlockLosesItsRadius) {
  const double k = 1e-7, force = 10.8333, time = 7200, rate = 25, start = 20;
  const auto model = model_of(
      "worn_body/block_on_elastic_ring.toml",
      {"mesh.factor=4", R"(wear.on=["surface", "track"])", "wear.surfaces.track.path=125.6637",
       "wear.surfaces.track.coefficient=1e-7", "output.times=[]"});
  const State end = run_model(*model, "esdirk-3", 0, 1e-3, time).last();
  const double radius = start - k * force * rate * time / (2 * M_PI);
  EXPECT_NEAR(
      observed(*model, end, "worn_volume_ring") / (M_PI * (start * start - radius * radius)), 1,
      1e-3);
  EXPECT_NEAR(observed(*model, end, "worn_volume_block") / (2e-9 * force * rate * time * start),
              (1 + radius / start) / 2, 1e-3);
  EXPECT_LT(model->examine(end).lost_wear, 1e-12);
  EXPECT_EQ(model->examine(end).touched_end, "");
  const ContactSurface surface = model->contact(end).value();
  const auto top =
      std::ranges::max_element(surface.initial, {}, [](const auto& x) { return x[1]; });
  EXPECT_NEAR(surface.wear_depth[static_cast<std::size_t>(top - surface.initial.begin())] /
                  (start - radius),
              1, 1e-3);
}

/// Overrides of the scene.
std::string mistake(const Overrides& overrides) {
  return refusal(scene, overrides);
}

TEST(TrackScene, MistakesAreNamed) {
  const std::string key = "wear.surfaces.track.path`: expected ";
  EXPECT_THAT(mistake({"wear.surfaces.track.path=7.0"}),
              HasSubstr("at least the length of its mesh along the track, 8 mm, got 7 mm"));
  EXPECT_THAT(mistake({"motion.1.velocity=[100.0, 1.0]"}),
              HasSubstr(key + "a surface whose nodes lie on lines along (1, 0.01)"));
  EXPECT_THAT(mistake({"motion.1.body=pin"}),
              HasSubstr(key + "a [[motion]] with body = \"disc\", which has none"));
  for (const char* motion :
       {"motion.1.velocity=[100.0, 0.0, 1.0]", "motion.1.velocity=[0.0, 0.0, 100.0]"})
    EXPECT_THAT(mistake({motion}), HasSubstr(key + "a [[motion]] of \"disc\" with a velocity in "));
  EXPECT_THAT(refusal("worn_body/shoe_on_drum.toml", {"wear.surfaces.rim.path=450.0"}),
              HasSubstr("the circumference at the mean of its radii, 376.991 mm, got 450 mm"));
  EXPECT_THAT(mistake({"motion.1.rotation=1.0", "motion.1.center=[0.0, -4.0]"}),
              HasSubstr("expected a surface whose nodes lie on a circle about"));
  const std::string cycle = R"(motion.1.cycle.x="0.1*tau")",
                    held = R"(shape.hold=["base", "ends"])";
  EXPECT_THAT(mistake({cycle, "cycle.period=1.0", "cycle.phases=4"}),
              HasSubstr(key + "none beside a cycle"));
  EXPECT_THAT(mistake({"shape.constraint=multiplier"}), HasSubstr(key));
  EXPECT_THAT(mistake({held}), HasSubstr(key + "a surface that recedes as a whole"));
  EXPECT_THAT(mistake({"wear.surfaces.trak.path=300.0"}),
              HasSubstr("expected one of wear.on, \"tip\", \"track\""));
  EXPECT_THAT(mistake({"wear.surfaces.tip.path=300.0"}),
              HasSubstr("wear.surfaces.tip.path: expected a [[motion]] with body = \"pin\""));
}

TEST(TrackScene, IsOneOfAPair) {
  EXPECT_THAT(refusal("worn_body/pin.toml", {"wear.surfaces.surface.path=300.0"}),
              HasSubstr("expected none beside a rigid counter-body"));
}

}  // namespace
}  // namespace gnomon::track_test
