#include "part/histories.hpp"

#include <fmt/format.h>

#include <gnomon/base/mistakes.hpp>
#include <set>

namespace gnomon::part {

void refuse(const Scene& scene, const std::string& key, const std::string& expected) {
  throw InputError(scene.where(key) + ": expected " + expected);
}

std::vector<std::string> entries_of(const Scene& scene, const std::string& table,
                                    const std::vector<Key>& keys,
                                    const std::vector<std::string>& needed) {
  std::set<std::string> names;
  for (const Key& key : keys)
    for (const std::string& name : scene.chosen_names(key.name)) names.insert(name);
  std::vector<std::string> entries;
  Mistakes mistakes;
  for (const std::string& name : names) {
    entries.push_back(table + "." + name);
    for (const std::string& key : needed)
      if (!scene.given(entries.back() + "." + key))
        mistakes.add(fmt::format("{}: [[{}]] number {}: missing key `{}`", scene.path().string(),
                                 table, name, key));
  }
  mistakes.require_none();
  return entries;
}

Section section_of(const Scene& scene) {
  return scene.text("model.plane") == "axisymmetric" ? Section::meridian : Section::plane;
}

template <int dim>
std::vector<std::string> direction_names(const Scene& scene) {
  if constexpr (dim == 3) return {"x", "y", "z"};
  if (section_of(scene) == Section::meridian) return {"r", "z"};
  return {"x", "y"};
}

Key density_key(const std::string& name, std::function<std::string(const Scene&)> idle) {
  return real_key(name, "t/mm^3", absent("no load.#.acceleration"), positive_quantity,
                  "mass by volume", std::move(idle));
}

Key times_key(const std::string& prefix, const std::string& quantity) {
  return reals_key(prefix + ".times", "s", absent(quantity + " does not change with time"),
                   non_negative,
                   "ascending times of factors, one twice for a jump; steps end on them exactly");
}

Key factors_key(const std::string& prefix, const std::string& quantity) {
  return reals_key(
      prefix + ".factors", "", absent(quantity + " does not change with time"), any_quantity,
      "what it is multiplied by at the times: linear between them, constant before the "
      "first and after the last");
}

LoadHistory read_history(const Scene& scene, const std::string& prefix) {
  const std::string times_name = prefix + ".times", factors_name = prefix + ".factors";
  const bool has_times = scene.given(times_name), has_factors = scene.given(factors_name);
  if (!has_times && !has_factors) return {};
  if (has_times != has_factors)
    throw InputError(fmt::format("{}: expected also {}",
                                 scene.where(has_times ? times_name : factors_name),
                                 has_times ? factors_name : times_name));
  const std::vector<double>&times = scene.reals(times_name), &factors = scene.reals(factors_name);
  if (times.empty() || times.size() != factors.size())
    throw InputError(fmt::format("{}: expected as many as {}, {}, and one or more, got {}",
                                 scene.where(factors_name), times_name, times.size(),
                                 factors.size()));
  if (LoadHistory::first_misplaced(times) < times.size())
    refuse(scene, times_name, "ascending times, one twice for a jump");
  return {times, factors};
}

template std::vector<std::string> direction_names<2>(const Scene&);
template std::vector<std::string> direction_names<3>(const Scene&);

}  // namespace gnomon::part
