// What a wear law does in time by itself.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <gnomon/wear_laws/law_in_time.hpp>

namespace gnomon::law_in_time_test {
namespace {

constexpr double end = 1e4;
const WearRange range{
    .pressure = 2, .speed = 100, .depth = 0.02, .duration = end, .nominal_speed = 100};

WearLaw law_of(const std::string& rate) {
  ExpressionNames names;
  names.variables = wear_law_variables();
  return expression_wear_law(Expression(rate, names), end, 100);
}

std::vector<double> stops(const std::string& rate, double tolerance = 1e-3) {
  const WearLaw law = law_of(rate);
  return LawInTime(law, range).stops(tolerance).value();
}

TEST(LawInTime, ChangesWhereTheRateReadsTimeOrDistance) {
  for (const auto& [rate, changes] :
       {std::pair("p*v*(1+h)", false), std::pair("p*v*exp(-t)", true),
        std::pair("p*v*exp(-s)", true), std::pair("p*v*if(t<10,1,2)", false)}) {
    const WearLaw law = law_of(rate);
    EXPECT_EQ(LawInTime(law, range).changes(), changes) << rate;
  }
  EXPECT_FALSE(LawInTime(archard(1e-3), range).changes());
}

// Steps end on both sides of a pulse and in it, wherever it is, whether it comes in t or in s, and
// also on a slope.
TEST(LawInTime, StopsAtAPulseAndNotElsewhere) {
  for (const double at : {5000.0, 1234.5, 300.0, 9800.0})
    for (const double width : {5.0, 50.0})
      for (const char* base : {"1", "(1+t/3000)", "(1+s/3e5)"}) {
        const auto found =
            stops(fmt::format("p*v*({} + {}*exp(-((t-{})/{})^2))", base, 5000 / width, at, width));
        SCOPED_TRACE(fmt::format("{} {} {}: {} stops", base, at, width, found.size()));
        EXPECT_GE(found.size(), 3u);
        EXPECT_LE(found.size(), 40u);
        int inside = 0;
        for (const double t : found) {
          EXPECT_LT(std::abs(t - at), 20 * width + end / 1000);
          inside += std::abs(t - at) < 2 * width;
        }
        EXPECT_GE(inside, 2);
      }
}

// As narrow as the resolution that it promises.
TEST(LawInTime, FindsWhatLastsAsLongAsItPromises) {
  const double width = end / 2000;
  for (int k = 0; k < 200; ++k) {
    const double at = 3000 + width * k / 100;
    const auto found = stops(fmt::format("p*v*(1 + 1e3*exp(-((t-{})/{})^2*2.77))", at, width));
    EXPECT_GE(found.size(), 3u) << at;
  }
}

TEST(LawInTime, LeavesSlowChangesToErrorControl) {
  EXPECT_TRUE(stops("p*v*(1 + t/1000)").empty());
  EXPECT_TRUE(stops("p*v*exp(-t/5000)").empty());
  EXPECT_LE(stops("p*v*(1 + 3*exp(-s/1e5))").size(), 6u);
  EXPECT_TRUE(stops("p*v*if(t<5,1000,1)").empty());  // a breakpoint
  // A pulse that wears less than the tolerance does not matter.
  EXPECT_TRUE(stops("p*v*(1 + exp(-((t-4321)/5)^2))", 1e-2).empty());
}

// sin^2 of a period of 1 s, 10,000 times, or of one at whose ends and quarters all samples are.
TEST(LawInTime, KnowsThatStepsCannotFollow) {
  const WearLaw fast = law_of("p*v*2*sin(2*pi*t/2)^2"),
                hidden = law_of("p*v*(1 + 2*sin(2*pi*8*t/5)^2)"),
                ripple = law_of("p*v*(1 + 0.01*sin(2*pi*t))"),
                slow = law_of("p*v*2*sin(2*pi*t/1000)^2");
  EXPECT_FALSE(LawInTime(fast, range).stops(1e-4));
  EXPECT_NEAR(LawInTime(fast, range).fast_part(), 2 / M_PI, 0.2);  // mean of |cos|
  EXPECT_NEAR(LawInTime(hidden, range).unseen_part(), 0.5, 0.05);  // samples are at its zeros
  EXPECT_LT(LawInTime(ripple, range).fast_part() + LawInTime(ripple, range).unseen_part(), 0.02);
  EXPECT_LT(LawInTime(slow, range).unseen_part(), 1e-3);
  EXPECT_TRUE(LawInTime(slow, range).stops(1e-4));
}

TEST(LawInTime, TellsWhatItDoesWithinACycle) {
  const WearLaw wave = law_of("p*v*(1 + sin(2*pi*t/500))");
  EXPECT_NEAR(LawInTime(wave, range).change_within(500), 2 / M_PI, 0.02);
  EXPECT_LT(LawInTime(wave, range).change_within(5), 0.03);
}

TEST(LawInTime, TellsWhatFixedStepsMiss) {
  const WearLaw pulse = law_of("p*v*(1 + 1000*exp(-((t-5100)/5)^2))");
  const double of_pulse = 1000 * 5 * std::sqrt(M_PI), whole = end + of_pulse;
  const LawInTime in_time(pulse, range);
  EXPECT_NEAR(in_time.missed_by_steps(500), of_pulse / whole, 0.01);
  EXPECT_LT(in_time.missed_by_steps(3), 0.02);
  EXPECT_GT(in_time.missed_by_steps(3), 0);
  EXPECT_EQ(LawInTime(archard(1), range).missed_by_steps(500), 0);
  // Ends and middles of steps of a period see the mean, stages between do not.
  const WearLaw wave = law_of("p*v*(1 + sin(2*pi*t/500))");
  EXPECT_NEAR(LawInTime(wave, range).missed_by_steps(500), 2 / M_PI, 0.01);
}

TEST(IdleLaw, IsRemarkedOn) {
  using ::testing::HasSubstr;
  WearRange own = range;
  EXPECT_EQ(remark_on_idle_law(law_of("p*v"), own), "");
  EXPECT_THAT(remark_on_idle_law(law_of("q"), own), HasSubstr("friction.coefficient is 0"));
  own.friction = 0.3;
  EXPECT_EQ(remark_on_idle_law(law_of("q"), own), "");
  EXPECT_THAT(remark_on_idle_law(law_of("v*max(p-50,0)"), own),
              HasSubstr("0 at pressures up to 20 MPa, 10 times the mean of about 2 MPa"));
  EXPECT_THAT(remark_on_idle_law(law_of("v*max(p-5,0)"), own),
              HasSubstr("0 at pressures up to 2 MPa, the mean"));
}

}  // namespace
}  // namespace gnomon::law_in_time_test
