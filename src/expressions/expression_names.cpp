// The names in expressions: the language's own and those that are declared.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/scene/scene.hpp>
#include <set>

#include "expressions/expression_grammar.hpp"

namespace gnomon {

namespace {

constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

constexpr ExpressionFunction functions[] = {
    {"exp", Operation::exponential, 1, 1},     {"log", Operation::logarithm, 1, 1},
    {"sqrt", Operation::square_root, 1, 1},    {"sin", Operation::sine, 1, 1},
    {"cos", Operation::cosine, 1, 1},          {"abs", Operation::absolute, 1, 1},
    {"pow", Operation::power, 2, 2},           {"min", Operation::minimum, 2, any_number},
    {"max", Operation::maximum, 2, any_number}};

std::vector<std::string> function_names() {
  std::vector<std::string> result;
  for (const ExpressionFunction& function : functions) result.emplace_back(function.name);
  result.emplace_back("if");
  return result;
}

template <class Map>
std::vector<std::string> keys_of(const Map& map) {
  std::vector<std::string> result;
  for (const auto& [name, value] : map) result.push_back(name);
  return result;
}

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : separator) + word;
  return result;
}

}  // namespace

const ExpressionFunction* find_function(std::string_view name) {
  const auto found = std::find_if(std::begin(functions), std::end(functions),
                                  [&](const auto& function) { return function.name == name; });
  return found == std::end(functions) ? nullptr : found;
}

namespace {

/// Whether a scene cannot use the name for something else.
bool is_reserved(std::string_view name) {
  return find_function(name) || name == "if" || name == "and" || name == "or";
}

}  // namespace

std::string describe_expression_names(const ExpressionNames& names) {
  std::vector<std::string> kinds;
  const auto add = [&](const char* kind, const std::vector<std::string>& some) {
    if (!some.empty()) kinds.push_back(fmt::format("{} {}", kind, joined(some, ", ")));
  };
  add("variables", names.variables);
  add("constants", keys_of(names.constants));
  add("tables", keys_of(names.tables));
  add("functions", function_names());
  return joined(kinds, "; ");
}

bool is_taken_in_expressions(const std::string& name, const ExpressionNames& names) {
  const auto& variables = names.variables;
  return is_reserved(name) || names.constants.contains(name) || names.tables.contains(name) ||
         std::find(variables.begin(), variables.end(), name) != variables.end();
}

std::string unknown_expression_name(std::string_view name, const ExpressionNames& names) {
  std::vector<std::string> all = names.variables;
  for (const auto& some : {keys_of(names.constants), keys_of(names.tables), function_names()})
    all.insert(all.end(), some.begin(), some.end());
  // A letter is as near to any other.
  const std::string near = name.size() > 1 ? nearest_name(std::string(name), all) : "";
  return fmt::format("unknown name {}, {}there are the {}", quote(name),
                     near.empty() ? "" : "did you mean \"" + near + "\"? ",
                     describe_expression_names(names));
}

void check_expression_names(const ExpressionNames& names) {
  std::set<std::string> seen;
  const auto check = [&](const std::string& name) {
    if (!is_expression_name(name))
      throw ExpressionError(
          fmt::format("the name {} cannot stand in an expression, expected letters of ASCII, "
                      "digits and underscores that do not begin with a digit",
                      quote(name)));
    if (is_reserved(name))
      throw ExpressionError(
          fmt::format("the name {} is reserved in expressions, expected another "
                      "name than exp, log, sqrt, sin, cos, abs, pow, min, max, if, and, or",
                      quote(name)));
    if (!seen.insert(name).second)
      throw ExpressionError(
          fmt::format("the name {} is declared twice, expected distinct names", quote(name)));
  };
  if (names.variables.size() > max_variables)
    throw ExpressionError(fmt::format("an expression has {} variables, expected at most {}",
                                      names.variables.size(), max_variables));
  for (const std::string& name : names.variables) check(name);
  for (const auto& [name, table] : names.tables) check(name);
  for (const auto& [name, value] : names.constants) {
    check(name);
    if (!std::isfinite(value))
      throw ExpressionError(
          fmt::format("the constant {} is {}, expected a finite number", quote(name), value));
  }
}

}  // namespace gnomon
