#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/catalogue.hpp>
#include <utility>

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

namespace {

/// Times of the run at which a law is checked, including one in each part between its breakpoints.
std::vector<double> moments(const WearLaw& law, double duration) {
  constexpr std::size_t most_parts = 100;
  std::vector<double> times;
  for (const double part : {0.0, 1e-3, 0.1, 0.5, 1.0}) times.push_back(part * duration);
  std::vector<double> ends = law.breakpoints();
  ends.resize(std::min(ends.size(), most_parts));
  double before = 0;
  for (const double end : ends) times.push_back((before + std::exchange(before, end)) / 2);
  return times;
}

}  // namespace

void check_wear_law(const WearLaw& law, const WearRange& range, const std::string& where) {
  constexpr double rounding = 1e-9;  // of the rate at the mean pressure
  WearInput at;
  const auto rate = [&] {
    try {
      return law.rate(at).value;
    } catch (const RecoverableError& error) {
      throw InputError(fmt::format(
          "{}: expected a finite wear rate of zero or more, with finite derivatives: {}", where,
          error.what()));
    }
  };
  for (const double time : moments(law, range.duration))
    for (const double speed : {0.5, 1.0, 2.0})
      for (const double depth : {0.0, 0.01, 0.3, 1.0, 2.0})
        for (const auto& initial : range.initial) {
          at.moment = {time, time * range.nominal_speed, time};
          at.speed = speed * range.speed;
          at.depth = depth * range.depth;
          at.initial = initial;
          double usual = 0;  // at the mean pressure
          for (const double pressure : {10.0, 3.0, 1.0, 0.3, 0.01, 1e-4, 0.0}) {
            at.pressure = pressure * range.pressure;
            at.friction_power = range.friction * at.pressure * at.speed;
            const double value = rate();
            if (pressure == 1) usual = value;
            if (pressure == 0 && !(value <= rounding * usual))
              throw InputError(
                  fmt::format("{}: expected no wear without pressure, got the rate {:.4g} at {}",
                              where, value, described(at)));
          }
        }
}

template Vector<2> read_point<2>(const Scene&, const std::string&);
template Vector<3> read_point<3>(const Scene&, const std::string&);
template Vector<2> read_direction<2>(const Scene&, const std::string&);
template Vector<3> read_direction<3>(const Scene&, const std::string&);

}  // namespace gnomon
