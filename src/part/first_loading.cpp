#include "part/first_loading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/keys.hpp>

#include "model/unlike_bodies.hpp"

namespace gnomon::part {

namespace {

constexpr const char *press_key = "cycle.loading.press", *others_key = "cycle.loading.others";

}  // namespace

std::vector<Key> first_loading_keys() {
  return {reals_key(press_key, "", absent("[1, 1]"), {.min = 1e-3, .max = 1e3},
                    "where friction may stick: the first loading in steps, as parts of loads and "
                    "of what presses where the path begins; the last is 1"),
          reals_key(others_key, "", absent("[0, 1]"), {.min = -1e3, .max = 1e3},
                    "in the same steps, parts of the other forces; the last is 1")};
}

std::vector<LoadingStep> read_first_loading(const Scene& scene, bool sticks) {
  const LoadingStep pressed{1, 0}, whole{1, 1};
  if (!scene.given(press_key) && !scene.given(others_key)) return {pressed, whole};
  const std::string key = scene.given(press_key) ? press_key : others_key;
  const auto refuse = [&](const std::string& expected) {
    return InputError(scene.where(key) + ": expected " + expected);
  };
  if (!sticks) throw refuse("friction.stick = true, or stick of [[pair]], and a cycle beside it");
  if (!scene.given(press_key) || !scene.given(others_key))
    throw refuse(std::string("also ") + (key == press_key ? others_key : press_key));
  const std::vector<double>&press = scene.reals(press_key), &others = scene.reals(others_key);
  if (press.size() != others.size() || press.empty() || press.back() != 1 || others.back() != 1)
    throw refuse(fmt::format("as many parts as {}, in both the last 1", others_key));
  std::vector<LoadingStep> steps;
  for (std::size_t k = 0; k < press.size(); ++k) steps.push_back({press[k], others[k]});
  return steps;
}

template <int dim>
std::string history_that_matters(const AssemblyParts<dim>& parts) {
  constexpr double little = 0.01;
  const double most = std::abs(dundurs_of(parts.bodies, parts.pairs));
  if (most < little) return {};
  return fmt::format(
      "pressures move the bodies along their contact, since they are unlike (Dundurs' beta is "
      "{:.2g}): tractions where it sticks, and slip by some percent, depend on the first loading "
      "(cycle.loading.press and .others)",
      most);
}

template std::string history_that_matters(const AssemblyParts<2>&);
template std::string history_that_matters(const AssemblyParts<3>&);

}  // namespace gnomon::part
