// A user's wear law in C++, in one file and without other changes: a scene chooses it by wear.law,
// with a key that the registration adds.

#include <gmock/gmock.h>

#include <gnomon/wear_laws/wear_law_kind.hpp>

#include "support/pin.hpp"

namespace gnomon::own_wear_law_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

/// Sarkar: k p v sqrt(1 + 3 f^2), from the pressure and the frictional traction q / v together.
WearLaw sarkar(double coefficient, double amplification) {
  return WearLaw({.rate = [=](const WearInput& at, std::span<const char>) {
    const double shear = at.speed > 0 ? at.friction_power / at.speed : 0;  // f p
    const double both = std::sqrt(at.pressure * at.pressure + amplification * shear * shear);
    if (both == 0) return WearRate{};
    const double kv = coefficient * at.speed;
    return WearRate{.value = kv * both,
                    .by_pressure = kv * at.pressure / both,
                    .by_speed = coefficient * (both - amplification * shear * shear / both),
                    .by_friction_power = coefficient * amplification * shear / both};
  }});
}

const Registration<WearLawKind> registration(
    {.name = "sarkar",
     .help = "Archard's law amplified by friction",
     .keys = {{.name = "wear.amplification",
               .default_value = 3.0,
               .range = {.min = 0, .max = positive_quantity.max},
               .help = "factor of f^2 in the law sarkar"}},
     .make = [](const Scene& scene) {
       return sarkar(scene.real("wear.coefficient"), scene.real("wear.amplification"));
     }});

double worn(const Overrides& more) {
  Overrides overrides = {elements(8), "friction.coefficient=0.4"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const PinRun run = run_pin("esdirk-3", 0, 1e-4, 100, overrides);
  return run.observed("worn_volume");
}

// With gross sliding f p is proportional to p, so the law is Archard's with another coefficient.
TEST(OwnWearLaw, IsChosenByTheSceneWithItsKey) {
  const double amplified = std::sqrt(1 + 3 * 0.4 * 0.4);
  const std::string coefficient =
      "wear.coefficient=" + std::to_string(1e-7 * amplified * 1e7) + "e-7";
  EXPECT_NEAR(worn({"wear.law=sarkar"}) / worn({coefficient}), 1, 1e-5);
  EXPECT_NEAR(worn({"wear.law=sarkar", "wear.amplification=0"}) / worn({}), 1, 1e-9);
  EXPECT_GT(worn({"wear.law=sarkar"}) / worn({}), 1.15);
}

TEST(OwnWearLaw, KeepsTheJacobianExact) {
  const auto model = pin_model({elements(3), "friction.coefficient=0.4", "wear.law=sarkar"});
  std::vector<double> y(model->system().structure().size);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = 0.01 * std::sin(double(i));
  check_jacobian(model->system(), 0, y, 0.2);
}

// So that a result can be read without laws that are known, but that it did not choose.
TEST(OwnWearLaw, ItsKeysAreStoredWithTheScenesThatChooseIt) {
  const auto stored = [](const Overrides& overrides) {
    const Scene scene = pin_scene(overrides);
    const std::string text = scene.resolved();
    EXPECT_TRUE(parse_scene(text, "resolved", {}, key_table) == scene);
    return text.find("amplification") != std::string::npos;
  };
  EXPECT_FALSE(stored({}));
  EXPECT_TRUE(stored({"wear.law=sarkar"}));
  EXPECT_TRUE(stored({"wear.amplification=2"}));  // given, in vain
}

// Otherwise each would silently get the default of the first.
TEST(OwnWearLaw, SharesAKeyOnlyWithTheSameDefault) {
  const auto law = [](const std::string& name, double value) {
    return WearLawKind{.name = name,
                       .help = "",
                       .keys = {{.name = "wear.shared", .default_value = value, .help = ""}},
                       .make = [](const Scene&) { return WearLaw(); }};
  };
  Registry<WearLawKind>::put(law("first", 1));
  Registry<WearLawKind>::put(law("second", 2));
  EXPECT_THROW(key_table("winkler"), RegistrationError);
  Registry<WearLawKind>::put(law("second", 1));
  EXPECT_NO_THROW(key_table("winkler"));
  for (const char* name : {"first", "second"})
    EXPECT_THAT(pin_scene({std::string("wear.law=") + name}).resolved(), HasSubstr("shared = 1"));
  EXPECT_THAT(pin_scene({}).resolved(), Not(HasSubstr("shared")));
}

// It would pass everything that tells of errors, and end the program.
TEST(OwnWearLaw, MayThrowWhatIsNoException) {
  const WearLaw law({.rate = [](auto&&...) -> WearRate { throw 42; },
                     .kinks = 1,
                     .switching = [](auto&&...) { throw "text"; }});
  const auto told = ThrowsMessage<Error>(HasSubstr("the wear law threw something"));
  for (const double pressure : {1.0, -1.0}) {
    double value = 0;
    EXPECT_THAT([&] { law.rate({.pressure = pressure}); }, told);
    EXPECT_THAT([&] { law.switching({.pressure = pressure}, {&value, 1}); }, told);
  }
}

// It would end in a call of nothing, in the middle of a run.
TEST(OwnWearLaw, IsRefusedWithoutItsFunctions) {
  const auto refused = [](auto&& make, const std::string& reason) {
    EXPECT_THAT(make, ThrowsMessage<RegistrationError>(HasSubstr(reason)));
  };
  refused([] { Registry<WearLawKind>::add({.name = "half", .help = "", .keys = {}, .make = {}}); },
          "\"half\" is registered without `make`");
  refused([] { WearLaw({.rate = {}}); }, "without `rate`");
  refused([] { WearLaw({.rate = [](auto&&...) { return WearRate{}; }, .kinks = 1}); },
          "without `switching`");
  Registry<WearLawKind>::put({.name = "no-rate", .help = "", .keys = {}, .make = [](const Scene&) {
                                return WearLaw({.rate = {}});
                              }});
  refused(
      [] {
        pin_model({elements(3), "wear.law=no-rate"});
      },
      "the wear law \"no-rate\": it is made without `rate`");
}

}  // namespace
}  // namespace gnomon::own_wear_law_test
