#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/catalogue.hpp>

namespace gnomon {

namespace {

std::string described(const WearInput& at) {
  return fmt::format(
      "p = {:.4g}, v = {:.4g}, h = {:.4g}, q = {:.4g}, t = {:.4g}, s = {:.4g} and the initial "
      "position ({:.4g}, {:.4g}, {:.4g})",
      at.pressure, at.speed, at.depth, at.friction_power, at.moment.time, at.moment.slid,
      at.initial[0], at.initial[1], at.initial[2]);
}

}  // namespace

template <int dim>
Vector<dim> read_point(const Scene& scene, const std::string& key) {
  return Eigen::Map<const Vector<dim>>(scene.reals(key).data());
}

template <int dim>
Vector<dim> read_direction(const Scene& scene, const std::string& key) {
  const Vector<dim> direction = read_point<dim>(scene, key);
  if (!(direction.norm() > 0))
    throw InputError(scene.where(key) + ": expected a direction, got a vector of length zero");
  return direction;
}

void check_wear_law(const WearLaw& law, const WearRange& range, const std::string& where) {
  // Rounding lets a depth be negative where nothing wears.
  constexpr double rounding = 1e-9;
  WearInput at;
  const auto rate = [&] {
    try {
      return law.rate(at);
    } catch (const RecoverableError&) {
      throw InputError(
          fmt::format("{}: expected a finite wear rate, with finite derivatives, got "
                      "none at {}",
                      where, described(at)));
    }
  };
  for (const double time : {0.0, 1e-3, 0.1, 0.5, 1.0})
    for (const double speed : {0.01, 0.1, 1.0, 3.0})
      for (const double depth : {-rounding, 0.0, 0.01, 0.3, 1.0, 2.0})
        for (const auto& initial : range.initial) {
          at.moment = {time * range.duration, time * range.duration * range.nominal_speed,
                       time * range.duration};
          at.speed = speed * range.speed;
          at.depth = depth * range.depth;
          at.initial = initial;
          double largest = 0;
          for (const double pressure : {10.0, 3.0, 1.0, 0.3, 0.01, 1e-4, 0.0}) {
            at.pressure = pressure * range.pressure;
            at.friction_power = range.friction * at.pressure * at.speed;
            const double value = rate().value;
            largest = std::max(largest, value);
            if (pressure == 0 && !(std::abs(value) <= rounding * largest))
              throw InputError(
                  fmt::format("{}: expected no wear without pressure, got the rate {:.4g} at {}",
                              where, value, described(at)));
            if (value < 0)
              throw InputError(
                  fmt::format("{}: expected a wear rate of zero or more, got {:.4g} "
                              "at {}",
                              where, value, described(at)));
          }
        }
}

template Vector<2> read_point<2>(const Scene&, const std::string&);
template Vector<3> read_point<3>(const Scene&, const std::string&);
template Vector<2> read_direction<2>(const Scene&, const std::string&);
template Vector<3> read_direction<3>(const Scene&, const std::string&);

}  // namespace gnomon
