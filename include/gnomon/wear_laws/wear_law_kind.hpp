// Wear laws that scenes may name. A new one is one file in src/wear_laws/catalogue with a
// Registration; nothing else has to change.
#pragma once

#include <array>
#include <functional>
#include <gnomon/expressions/expression.hpp>
#include <gnomon/laws/wear_law.hpp>
#include <gnomon/scene/registry.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// A wear law that scenes may name.
struct WearLawKind {
  std::string name;
  std::string help;  ///< one line
  /// wear.*, in addition to those of every scene with wear. They are optional or have a default,
  /// because they are in the tables of all scenes.
  std::vector<Key> keys;
  std::function<WearLaw(const Scene&)> make;
  bool reads_coefficient = true;  ///< whether `make` needs wear.coefficient

  std::string missing() const { return make ? "" : "make"; }  ///< for Registry
};

/// The variables of a wear law that is an expression: p v h q t s x0 y0 z0 q_mean, as in WearInput.
const std::vector<std::string>& wear_law_variables();

/// The wear rate as an expression of wear_law_variables(), in this order. Its kinks that depend on
/// t and s alone become breakpoints, which are searched in (0, end]; two changes of one condition
/// within a thousandth of `end` may be missed. s = nominal_speed t there.
WearLaw expression_wear_law(const Expression& rate, double end, double nominal_speed);
/// The same of the expression that a key of the scene gives, "wear.rate". Throws InputError.
WearLaw expression_wear_law(const Scene& scene, const std::string& key, double nominal_speed);

/// Largest values of the inputs that may occur in a run, for checks of a law.
struct WearRange {
  double pressure = 1, speed = 1, depth = 1, duration = 1;
  double friction = 0;       ///< q = friction p v
  double nominal_speed = 1;  ///< s = nominal_speed t
  std::vector<std::array<double, 3>> initial = {{}};
};

/// Refuses a law that wears without pressure, adds material, or has no finite rate somewhere on a
/// grid of inputs: throws InputError with one line that begins with `where`, the key that gave the
/// law, and says what was expected at which values.
void check_wear_law(const WearLaw& law, const WearRange& range, const std::string& where);

/// For the user: that nothing may wear, because the law takes the friction power of contact without
/// friction, or needs more than the mean pressure. Empty: neither.
std::string remark_on_idle_law(const WearLaw& law, const WearRange& range);

}  // namespace gnomon
