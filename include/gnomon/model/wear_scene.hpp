// The wear law of a scene.
#pragma once

#include <array>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/wear_law.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// The law that `wear.law` names, made of its keys, for this speed of sliding, by default
/// wear.velocity. `rate_key`: of the expression. Throws InputError where they are no law.
WearLaw read_wear_law(const Scene& scene, std::optional<double> speed = {},
                      const std::string& rate_key = "wear.rate");

/// What a wear law meets in a run, for scales and checks.
struct WearCircumstances {
  double pressure = 1;                                ///< mean contact pressure [stress]
  double friction = 0;                                ///< Coulomb's coefficient
  double speed = 1;                                   ///< nominal one, s = speed t [length / time]
  double duration = 1;                                ///< of the run [time]
  std::vector<std::array<double, 3>> initial = {{}};  ///< positions of the nodes [length]
  // Read by required_law() alone:
  double depth = 1;    ///< mean wear depth at the end [length]
  bool rolls = false;  ///< in a steady state, so that q has a mean
};

/// The mean over the run and the nodes of Wdot / p at a new surface [length / (time stress)]: k v
/// of Archard's law. Of a law that needs more than the mean pressure, at the first multiple of it
/// that wears; zero where none does. Throws RecoverableError where the rate is not finite.
double wear_by_pressure(const WearLaw& law, const WearCircumstances& at);

/// The depth at the end of the run of a law that may read it, where the rate of a new surface would
/// wear `nominal`: at most that [length]. Throws RecoverableError where the rate is not finite.
double depth_by_law(const WearLaw& law, const WearCircumstances& at, double nominal);
/// The same with the speed, duration and friction of the scene. Throw InputError.
double wear_by_pressure(const Scene& scene, const WearLaw& law, double pressure);
double depth_by_law(const Scene& scene, const WearLaw& law, double pressure, double nominal);

/// What is said of a law whose rate is not finite, with the key that gives it.
InputError unsound_law(const Scene& scene, const RecoverableError& error);

/// The law with the stops of what it does in time by itself (law_in_time.hpp), where steps follow
/// the error; adds remarks for the user. Throws InputError, in one line, where check_wear_law()
/// does for the values that the run may meet, or where the law reads a mean that it has not.
WearLaw required_law(const Scene& scene, const WearLaw& law, const WearCircumstances& at,
                     std::vector<std::string>& remarks, const std::string& rate_key = "wear.rate");

/// Throws InputError for a key of a surface that does not wear, which wear.on does not name.
void require_surface_names(const Scene& scene);
/// Throws InputError where a law of the scene reads wear.coefficient, but it is not given.
void require_coefficient(const Scene& scene);
/// Whether the scene asks for wear: a coefficient of 0 is a contact analysis.
bool asks_for_wear(const Scene& scene);

/// Whether a wear rate of the scene may read the name: a law that is no expression reads any.
bool reads_in_rates(const Scene& scene, const std::string& name);

/// The constants and tables of the scene, "wear.constants.a", that wear.rate does not use.
std::vector<std::string> unused_wear_names(const Scene& scene);

}  // namespace gnomon
