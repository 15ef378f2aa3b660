#include "expressions/expression_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>

namespace gnomon {

void require_free_name(const Scene& scene, const std::string& key, const std::string& name,
                       const ExpressionNames& names) {
  if (is_taken_in_expressions(name, names))
    throw InputError(fmt::format("{}: expected another name, there are already the {}, and, or",
                                 scene.where(key), describe_expression_names(names)));
}

PiecewiseLinear linear_table(const std::vector<double>& x, const std::vector<double>& y,
                             const std::string& where) {
  try {
    return {x, y};
  } catch (const ExpressionError& error) {
    throw InputError(where + ": " + error.what());
  }
}

void add_tables(const Scene& scene, ExpressionNames& names) {
  constexpr std::size_t most = 10000;
  const auto key_of = [](const std::string& name, const char* axis) {
    return "tables." + name + axis;
  };
  const std::vector<std::string> of_x = scene.chosen_names(key_of("*", ".x")),
                                 of_y = scene.chosen_names(key_of("*", ".y"));
  for (const std::string& name : of_y)
    if (std::ranges::count(of_x, name) == 0)
      throw InputError(scene.where(key_of(name, ".y")) + ": expected x and y of the table");
  for (const std::string& name : of_x) {
    const std::string x = key_of(name, ".x"), y = key_of(name, ".y");
    if (std::ranges::count(of_y, name) == 0)
      throw InputError(scene.where(x) + ": expected x and y of the table");
    require_free_name(scene, x, name, names);
    if (scene.reals(x).size() > most)
      throw InputError(fmt::format("{}: expected at most {} points of a table, got {}",
                                   scene.where(x), most, scene.reals(x).size()));
    names.tables.emplace(name, linear_table(scene.reals(x), scene.reals(y), scene.where(x)));
  }
}

}  // namespace gnomon
