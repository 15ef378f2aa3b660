// Registries of values (integrators, problems). A file in `integrators/` or `problems/` defines one
// static Registration; nothing else has to change to add an entry.
#pragma once

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// All registered values of type T, sorted by name. T has a member `std::string name`.
template <class T>
class Registry {
public:
  static const std::vector<T>& all() { return entries(); }

  static std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const T& entry : entries()) result.push_back(entry.name);
    return result;
  }

  /// The entry called `name`; throws InputError that names the nearest one. `what` is the noun of
  /// the message ("integrator").
  static const T& find(const std::string& name, const std::string& what) {
    for (const T& entry : entries())
      if (entry.name == name) return entry;
    throw InputError(unknown_name(name, what, names()));
  }

  static void add(T entry) {
    auto& list = entries();
    const auto place = std::lower_bound(list.begin(), list.end(), entry,
                                        [](const T& a, const T& b) { return a.name < b.name; });
    list.insert(place, std::move(entry));
  }

private:
  static std::vector<T>& entries() {
    static std::vector<T> list;  // function-local: safe to fill during static initialisation
    return list;
  }
};

/// `const Registration<Integrator> registration{ {.name = ...} };` at namespace scope.
template <class T>
struct Registration {
  explicit Registration(T entry) { Registry<T>::add(std::move(entry)); }
};

}  // namespace gnomon
