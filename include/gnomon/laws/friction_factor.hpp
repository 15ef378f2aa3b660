// Friction that changes with place, depth and time, where it may stick (docs/fretting.md).
#pragma once

#include <array>
#include <gnomon/laws/wear_law.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// By what Coulomb's coefficient is multiplied at a contact node: 1, or a function of the depth h,
/// of t and s, and of the initial position.
class FrictionFactor {
public:
  struct Value {
    double value = 1, by_depth = 0;
  };

  FrictionFactor() = default;  ///< 1
  /// `law`: the factor in the place of a wear rate; it reads neither p nor v nor q.
  explicit FrictionFactor(WearLaw law) : law_(std::move(law)) {}

  bool varies() const { return law_.has_value(); }
  /// Throws RecoverableError unless the factor is finite, and zero or more.
  Value at(double depth, const WearMoment& moment, const std::array<double, 3>& initial) const;
  /// Ascending times at which steps end.
  std::vector<double> breakpoints() const {
    return law_ ? law_->breakpoints() : std::vector<double>{};
  }

private:
  std::optional<WearLaw> law_;
};

}  // namespace gnomon
