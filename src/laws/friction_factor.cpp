#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/laws/friction_factor.hpp>

namespace gnomon {

FrictionFactor::Value FrictionFactor::at(double depth, const WearMoment& moment,
                                         const std::array<double, 3>& initial) const {
  if (!law_) return {};
  try {
    const WearRate factor = law_->rate({.depth = depth, .moment = moment, .initial = initial});
    return {factor.value, factor.by_depth};
  } catch (const RecoverableError&) {
    throw RecoverableError(
        fmt::format("the factor of friction is no finite number of zero or more at h = {:.4g}, t = "
                    "{:.4g}, initial position ({:.4g}, {:.4g}, {:.4g})",
                    depth, moment.time, initial[0], initial[1], initial[2]));
  }
}

}  // namespace gnomon
