// Wear laws of rolling that read q_mean, the mean of the power of friction over the contact.
#include <functional>
#include <gnomon/fields/block.hpp>

#include "stick/rolling_scenes.hpp"

namespace gnomon::rolling_mean_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

constexpr const char* coarse = "mesh.file=coarse.geo";

std::string rate(const std::string& law) {
  return fmt::format("wear.rate=\"{}\"", law);
}

/// The creepage at which the whole contact slips.
std::string full_slip() {
  return fmt::format("creepage = [{}, 0.0]", 20 * Carter::f * Carter::a() / Carter::R);
}

std::vector<int> means(const Model& model) {
  const Structure& structure = model.system().structure();
  std::vector<int> unknowns;
  for (int i = 0; i < structure.size; ++i)
    if (structure.block_of(i).name == "mean_friction_power") unknowns.push_back(i);
  return unknowns;
}

double mean_power(const Model& model, const State& state) {
  return observed(model, state, "friction_power") / observed(model, state, "contact_area");
}

/// Whatever sticks, each closed node wears k times the mean, and the whole k times the power.
TEST_F(RollingScenes, TheMeanWearsAsMuchAsThePower) {
  for (const std::string& rolling : {std::string(), full_slip()}) {
    const auto model = this->model(cylinder(rolling), {coarse, rate("k * q_mean")});
    Counters counters;
    const State start = model->start(counters);
    ASSERT_EQ(means(*model).size(), 1u);
    const double power = observed(*model, start, "friction_power");
    EXPECT_GT(power, 0);
    EXPECT_NEAR(start.y[means(*model).front()] / mean_power(*model, start), 1, 1e-8);
    EXPECT_NEAR(observed(*model, start, "wear_flux") / (Carter::k * power), 1, 1e-8);
    EXPECT_EQ(observed(*model, start, "stick_area") > 0, rolling.empty());
  }
}

TEST_F(RollingScenes, AllIntegratorsFollowTheMean) {
  for (const char* method : {"esdirk-3", "erk-2", "bdf"}) {
    const auto model = this->model(cylinder(), {coarse, rate("k * q_mean")});
    const ModelRun run = run_model(*model, method, 0, 1e-4, 1000);
    const double area = Carter::k * observed(*model, run.last(), "friction_power") * 1000;
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / area, 1, 1e-5) << method;
    EXPECT_NEAR(observed(*model, run.last(), "wear_depth") * Carter::path / area, 1, 1e-5);
  }
}

/// A law that bends with T gamma / A = q_mean / V, by hand.
TEST_F(RollingScenes, ALawBendsWithTheMean) {
  Counters counters;
  const auto plain = this->model(cylinder(full_slip()), {coarse, rate("k * q")});
  const State start = plain->start(counters);
  const double flux = observed(*plain, start, "wear_flux"), mean = mean_power(*plain, start);
  const auto factor = [&](const std::string& law) {
    const auto model = this->model(cylinder(full_slip()), {coarse, rate("k * q * " + law)});
    return observed(*model, model->start(counters), "wear_flux") / flux;
  };
  EXPECT_NEAR(factor(fmt::format("if(q_mean < {}, 1, 3)", 1.01 * mean)), 1, 1e-8);
  EXPECT_NEAR(factor(fmt::format("if(q_mean < {}, 1, 3)", 0.99 * mean)), 3, 1e-8);
  EXPECT_NEAR(factor(fmt::format("(q_mean / {})^1.5", 4 * mean)), 0.125, 1e-8);
}

/// As the surface recedes by the depth h, it wears three times as fast until q_mean (1 - h / h0)
/// has fallen to half the mean: at h0 / 2.
TEST_F(RollingScenes, ARunPassesTheKinkOfAMean) {
  Counters counters;
  const auto plain = this->model(cylinder(), {coarse, rate("k * q")});
  const State start = plain->start(counters);
  const double mean = mean_power(*plain, start), time = 1000,
               speed = observed(*plain, start, "wear_flux") / Carter::path, h0 = 2 * speed * time;
  const auto model = this->model(
      cylinder(),
      {coarse, rate(fmt::format("k * q * if(q_mean * (1 - h / {}) < {}, 1, 3)", h0, 0.5 * mean))});
  const double expected = h0 / 2 + speed * (time - h0 / 2 / (3 * speed));
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-5, time, true);
  EXPECT_NEAR(observed(*model, run.last(), "wear_depth") / expected, 1, 1e-4);
}

/// The worn volumes by both solvers, of a law that reads the mean.
void expect_agreement(const std::function<std::unique_ptr<Model>(const Overrides&)>& model_of) {
  std::vector<double> worn;
  for (const char* solver : {"block", "direct"}) {
    const auto model =
        model_of({rate("k * q * (1 + q_mean / 2000)^2"), fmt::format("solver.method={}", solver)});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, 1000);
    worn.push_back(observed(*model, run.last(), "worn_volume"));
    EXPECT_LE(double(run.counters.krylov_iterations), 4.0 * double(run.counters.linear_solves));
  }
  EXPECT_GT(worn[0], 0);
  EXPECT_NEAR(worn[0] / worn[1], 1, 1e-5);
}

TEST_F(RollingScenes, SolversAgreeOnTheMean) {
  expect_agreement([this](Overrides overrides) {
    overrides.push_back(coarse);
    return model(cylinder(), overrides);
  });
}

TEST_F(PairRolling, SolversAgreeOnTheMean) {
  folder_.write("coarse.geo", rail(two_half_planes(8, 5, 2.4)));
  expect_agreement([this](Overrides overrides) {
    overrides.push_back(coarse);
    return model(rolling_cap(1005), overrides);
  });
}

/// Beside that the derivatives by the mean, and of the mean, are not zero.
void expect_jacobian_with_mean(const Model& model, const std::vector<double>& y, double relative) {
  const ActiveSet branch = active_set(model.system(), 0, y);
  check_jacobian(model.system(), 0, y, 0.2, &branch, relative);
  const Structure& structure = model.system().structure();
  std::vector<double> values(structure.pattern.nonzeros()), ydot(y.size());
  model.system().jacobian({0, y, ydot, &branch}, 0.2, values);
  const Eigen::MatrixXd J = dense(structure.pattern, values);
  const int mean = means(model).front();
  int by_mean = 0, of_mean = 0;
  for (int i = 0; i < structure.size; ++i) {
    by_mean += structure.differential[i] && J(i, mean) != 0;
    of_mean += i != mean && J(mean, i) != 0;
  }
  EXPECT_GT(by_mean, 0);
  EXPECT_GT(of_mean, 10);
}

TEST_F(RollingScenes, JacobianWithAMeanEqualsFiniteDifferences) {
  for (const char* material : {"linear", "neo-hookean"}) {
    const auto model = this->model(
        cylinder("", 0.3), {coarse, "wear.coefficient=1e-6", rate("k * (q + q_mean * (1 + h))"),
                            fmt::format("body.material={}", material)});
    Counters counters;
    std::vector<double> y = model->start(counters).y;
    const Structure& structure = model->system().structure();
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] += 0.05 * structure.unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
    expect_jacobian_with_mean(*model, y, 1e-4);
  }
}

TEST_F(RollingScenes, OnlyALawThatReadsAMeanHasTheUnknown) {
  const auto size = [&](const std::string& law) {
    return this->model(cylinder(), {coarse, rate(law)})->system().structure().size;
  };
  EXPECT_EQ(size("k * q"), size("k * p * v"));
  EXPECT_EQ(size("k * q_mean"), size("k * q") + 1);
}

TEST_F(RollingScenes, AMeanIsOfRollingAlone) {
  const char* message =
      "wear.rate: expected no q_mean, the mean of q over the contact, without steady rolling";
  expect_refused(Fretting::cylinder(), {rate("k * q_mean")}, message);
  for (const char* scene : {"worn_body/pin.toml", "winkler/pin.toml"})
    EXPECT_THAT(testing::refusal(scene, {rate("k * p * v * (1 + q_mean)")}), HasSubstr(message))
        << scene;
  expect_refused(cylinder(), {"friction.factor=\"1 + q_mean\""}, "got q_mean");
  EXPECT_EQ(refusal(cylinder(), {rate("k * q * if(q_mean < 100, 1, 3)")}), "");
  expect_refused(cylinder(), {rate("k * (q_mean + 1)")}, "expected no wear without pressure");
}

/// Both surfaces wear by the mean of their contact, and lose the same.
TEST_F(PairRolling, BothSurfacesWearByTheMean) {
  folder_.write("both.geo", rail_and_tread(two_half_planes(8, 5, 2.4)));
  const std::string text = rolling_cap(1020) + "[wear.surfaces.tread]\npath = 50.0\n";
  const auto of_law = [&](const std::string& law) {
    return this->model(text, {"mesh.file=both.geo", "wear.on=[\"face\", \"tread\"]", rate(law)});
  };
  const auto plain = of_law("k * q"), model = of_law("k * q * (1 + q_mean / 2000)^2");
  ASSERT_EQ(means(*plain).size(), 0u);
  ASSERT_EQ(means(*model).size(), 1u);
  Counters counters;
  const double flux = observed(*plain, plain->start(counters), "wear_flux");
  const State start = model->start(counters);
  const double mean = start.y[means(*model).front()], worn = flux * std::pow(1 + mean / 2000, 2);
  // A node at the edge, with less than a tenth of the typical pressure, counts by its share.
  EXPECT_NEAR(mean * observed(*model, start, "contact_area") * 2e-9 / flux, 1, 1e-3);
  EXPECT_NEAR(observed(*model, start, "wear_flux") / worn, 1, 1e-8);
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1000);
  for (const char* body : {"cap", "flat"})
    EXPECT_NEAR(observed(*model, run.last(), fmt::format("worn_volume_{}", body)) / (worn * 500), 1,
                0.02);
}

/// By a law that does not vanish with the pressure, too, however little some nodes are touched.
template <class ModelOf>
void expect_the_same_wear_by_the_mean(const ModelOf& model_of,
                                      const std::vector<std::string>& bodies) {
  Counters counters;
  const auto by_power = model_of(rate("k * q")), by_mean = model_of(rate("k * q_mean"));
  const State of_power = by_power->start(counters), of_mean = by_mean->start(counters);
  const double lost = observed(*by_power, of_power, "wear_flux_" + bodies.front());
  EXPECT_GT(lost, 0);
  for (const std::string& body : bodies)
    EXPECT_NEAR(observed(*by_mean, of_mean, "wear_flux_" + body) / lost, 1, 1e-6) << body;
}

TEST_F(PairRolling, BothBodiesLoseTheSameByTheMean) {
  folder_.write("both.geo", rail_and_tread(two_half_planes(8, 5, 2.4)));
  for (const double velocity : {1000.5, 1020.0})
    expect_the_same_wear_by_the_mean(
        [&](const std::string& law) {
          return model(rolling_cap(velocity) + "[wear.surfaces.tread]\npath = 50.0\n",
                       {"mesh.file=both.geo", "wear.on=[\"face\", \"tread\"]", law});
        },
        {"cap", "flat"});
}

TEST_F(PairRolling, BothBodiesLoseTheSameByTheMeanInSpace) {
  expect_the_same_wear_by_the_mean(
      [](const std::string& law) {
        return make_model(
            load_scene(shipped("wheel_on_rail.toml"), {"mesh.factor=2.5", law}, key_table));
      },
      {"wheel", "rail"});
}

TEST_F(PairRolling, JacobianWithAMeanEqualsFiniteDifferences) {
  folder_.write("coarse.geo", rail_and_tread(two_half_planes(4, 3, 4)));
  const auto model =
      this->model(rolling_cap(1000) + "[wear.surfaces.tread]\npath = 50.0\n",
                  {"mesh.file=coarse.geo", "wear.on=[\"face\", \"tread\"]", "motion.1.force=2.5",
                   "wear.coefficient=1e-7", rate("k * (q + q_mean * (1 + h))")});
  Counters counters;
  std::vector<double> y = model->start(counters).y;
  const Structure& structure = model->system().structure();
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += 0.02 * structure.unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
  expect_jacobian_with_mean(*model, y, 1e-4);
}

}  // namespace
}  // namespace gnomon::rolling_mean_test
