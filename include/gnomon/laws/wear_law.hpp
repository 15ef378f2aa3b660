// Wear laws: the wear rate of a contact node as a function of its state.
// wear_laws/wear_law_kind.hpp says how scenes name them.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// The time at which a wear law is evaluated.
struct WearMoment {
  double time = 0;  ///< t
  double slid = 0;  ///< s, sliding distance up to t [length]
  /// The law is taken from the smooth part in time that follows this time (up to the law's next
  /// breakpoint), continued to t.
  double within = 0;
};

/// The variables of a wear law.
struct WearInput {
  double pressure = 0;        ///< p = -lambda_eff, nominal [stress]
  double speed = 0;           ///< v = |v_T| [length / time]
  double depth = 0;           ///< h, of the material worn off, along the initial normal [length]
  double friction_power = 0;  ///< q = mu p v, per nominal area [stress length / time]
  /// q_mean, the mean of q over the contact; of laws that read it, in steady rolling alone.
  double mean_friction_power = 0;
  double contact_share = 1;  ///< s, the share of the node's area that is in contact
  WearMoment moment;
  std::array<double, 3> initial{};  ///< initial position of the node [length]
};

/// Wdot [length / time] and its derivatives. t, s and the initial position of a node are given.
struct WearRate {
  double value = 0;
  double by_pressure = 0, by_speed = 0, by_depth = 0, by_friction_power = 0;
  double by_mean_friction_power = 0, by_contact_share = 0;
};

/// A wear law. A value; copies share what they hold, and may be used by several threads at once.
///
/// It is smooth except for kinks, of which there are two kinds. Those that depend on p, v, h, q,
/// q_mean or the initial position each have a switching function, negative or zero where the kink
/// is *active*; `branches`, one entry per kink, not 0 where it is active, choose a smooth branch,
/// continued beyond its border. Empty branches mean the one that the input lies in. Kinks that
/// depend on t and s alone are breakpoints in time, where steps end. A law is evaluated only for p
/// >= 0. Below p = 0, which a closed node on a continued branch may reach, rate and switching
/// functions f are continued by the point reflection
///
///     f(p, q) = 2 f(0, 0) - f(-p, -q)     at the same v, h, q_mean, t, s
///
/// which has the value and slope of f at p = 0, and derivatives that follow from those of f. So it
/// is below q_mean = 0, which iterates may reach. Of a law that reads q_mean, which need not vanish
/// with the pressure, what it wears without pressure counts by the share in contact alone: the rate
/// is
///
///     f(p, q) - (1 - s) max(f(0, 0), 0)   at the same v, h, q_mean, t, s
class WearLaw {
public:
  struct Definition {
    std::function<WearRate(const WearInput&, std::span<const char> branches)> rate;
    std::size_t kinks = 0;
    /// Writes `kinks` values; not called without kinks.
    std::function<void(const WearInput&, std::span<const char> branches, std::span<double> values)>
        switching{};
    std::vector<double> breakpoints{};  ///< ascending times
    std::vector<char> jumps{};    ///< one per kink: whether the rate may jump there; empty: nowhere
    bool in_time = true;          ///< whether the rate may depend on t or s
    bool reads_mean = false;      ///< whether it reads mean_friction_power
    std::vector<double> stops{};  ///< ascending times, beside breakpoints, at which steps end
  };

  WearLaw();  ///< no wear
  /// Throws RegistrationError without a rate, or with kinks but without switching functions.
  explicit WearLaw(Definition definition);

  /// Throws RecoverableError if the law has no finite value or derivative.
  WearRate rate(const WearInput& at, std::span<const char> branches = {}) const;
  std::size_t kinks() const { return definition_->kinks; }
  void switching(const WearInput& at, std::span<double> values,
                 std::span<const char> branches = {}) const;
  const std::vector<double>& breakpoints() const { return definition_->breakpoints; }
  bool may_jump(std::size_t kink) const {
    return !definition_->jumps.empty() && definition_->jumps[kink] != 0;
  }
  bool in_time() const { return definition_->in_time; }
  bool reads_mean() const { return definition_->reads_mean; }
  const std::vector<double>& stops() const { return definition_->stops; }
  /// The same law with these stops.
  WearLaw with_stops(std::vector<double> stops) const;

private:
  WearRate continued(const WearInput& at, std::span<const char> branches) const;
  WearRate in_contact(const WearInput& at, std::span<const char> branches) const;

  std::shared_ptr<const Definition> definition_;
};

/// Archard: k p v, sec. 4.1. k [1 / stress]
WearLaw archard(double coefficient);

}  // namespace gnomon
