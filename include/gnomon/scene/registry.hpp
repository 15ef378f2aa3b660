// Registries of values: integrators, problems, laws, shapes, materials, solvers. A file in
// `integrators/` or `problems/` defines one static Registration; nothing else has to change to add
// an entry.
#pragma once

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>
#include <list>
#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

namespace gnomon {

/// What is registered of a type, by the name of the type: in the library, so that it is the same in
/// programs and plug-ins that hide their own symbols. Empty at first.
std::shared_ptr<void>& registered_of_type(const char* type);

/// The key of the table that has the name of a key of something registered, or none. Throws
/// RegistrationError where it has another kind, length or default.
Key* same_key(std::vector<Key>& table, const Key& key, const std::string& thing);

/// Throws RegistrationError for a key that every scene would have to give.
void require_optional(const Key& key, const std::string& thing);

/// Adds the key of something registered that `choice` ("wear.law") names; where the scene chooses
/// another, the key is idle. Others that may be chosen may have it too. Throws like these two.
void add_key_of_choice(std::vector<Key>& table, const Key& key, const std::string& choice,
                       const std::string& thing);

/// All registered values of type T, sorted by name. T has a member `std::string name`, and perhaps
/// `std::string missing() const`: the name of a member that every entry needs and this one lacks.
/// Members throw RegistrationError for, and after a static registration of, an entry that cannot
/// be used.
template <class T>
class Registry {
public:
  static const std::list<T>& all() {
    if (!fault().empty()) throw RegistrationError(fault());
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
    require_whole(entry);
    auto& list = entries();
    const auto place = std::lower_bound(list.begin(), list.end(), entry,
                                        [](const T& a, const T& b) { return a.name < b.name; });
    if (place != list.end() && place->name == entry.name)
      throw RegistrationError("\"" + entry.name +
                              "\" is registered twice, expected another name for one of the two");
    list.insert(place, std::move(entry));
  }

  /// As add(), but it takes the place of an entry of that name.
  static void put(T entry) {
    require_whole(entry);
    for (T& earlier : entries())
      if (earlier.name == entry.name) {
        earlier = std::move(entry);
        return;
      }
    add(std::move(entry));
  }

  /// As add(), but the error is thrown by the first use, where it can be caught and reported.
  static void add_statically(T entry) {
    try {
      add(std::move(entry));
    } catch (const RegistrationError& error) {
      fault() = error.what();
    }
  }

private:
  static void require_whole(const T& entry) {
    std::string missing = entry.name.empty() ? "name" : "";
    if constexpr (requires { entry.missing(); })
      if (missing.empty()) missing = entry.missing();
    if (!missing.empty())
      throw RegistrationError("\"" + entry.name + "\" is registered without `" + missing + "`");
  }
  struct Kept {
    std::list<T> entries;  // what it holds stays where it is
    std::string fault;     // of a static registration
  };
  static Kept& kept() {
    static Kept* const found = [] {
      std::shared_ptr<void>& things = registered_of_type(typeid(T).name());
      if (!things) things = std::make_shared<Kept>();
      return static_cast<Kept*>(things.get());
    }();
    return *found;
  }
  static std::string& fault() { return kept().fault; }
  static std::list<T>& entries() { return kept().entries; }
};

/// `const Registration<Integrator> registration{ {.name = ...} };` at namespace scope.
template <class T>
struct Registration {
  explicit Registration(T entry) { Registry<T>::add_statically(std::move(entry)); }
};

}  // namespace gnomon
