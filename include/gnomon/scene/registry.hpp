// Registries of values (integrators, problems). A file in `integrators/` or `problems/` defines one
// static Registration; nothing else has to change to add an entry.
#pragma once

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Two registrations of one name.
struct RegistrationError : Error {
  using Error::Error;
};

/// All registered values of type T, sorted by name. T has a member `std::string name`. Members
/// throw RegistrationError after two registrations of one name.
template <class T>
class Registry {
public:
  static const std::vector<T>& all() {
    if (!twice().empty()) refuse(twice());
    return entries();
  }

  static std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const T& entry : all()) result.push_back(entry.name);
    return result;
  }

  /// The entry called `name`; throws InputError that names the nearest one. `what` is the noun of
  /// the message ("integrator").
  static const T& find(const std::string& name, const std::string& what) {
    for (const T& entry : all())
      if (entry.name == name) return entry;
    throw InputError(unknown_name(name, what, names()));
  }

  static void add(T entry) {
    auto& list = entries();
    const auto place = std::lower_bound(list.begin(), list.end(), entry,
                                        [](const T& a, const T& b) { return a.name < b.name; });
    if (place != list.end() && place->name == entry.name) refuse(entry.name);
    list.insert(place, std::move(entry));
  }

  /// As add(), but the error is thrown by the first use, where it can be caught and told.
  static void add_statically(T entry) {
    const std::string name = entry.name;
    try {
      add(std::move(entry));
    } catch (const RegistrationError&) {
      twice() = name;
    }
  }

private:
  [[noreturn]] static void refuse(const std::string& name) {
    throw RegistrationError("\"" + name +
                            "\" is registered twice, expected another name for one of the two");
  }
  /// A name that was registered twice.
  static std::string& twice() {
    static std::string name;
    return name;
  }
  static std::vector<T>& entries() {
    static std::vector<T> list;  // function-local: safe to fill during static initialisation
    return list;
  }
};

/// `const Registration<Integrator> registration{ {.name = ...} };` at namespace scope.
template <class T>
struct Registration {
  explicit Registration(T entry) { Registry<T>::add_statically(std::move(entry)); }
};

}  // namespace gnomon
