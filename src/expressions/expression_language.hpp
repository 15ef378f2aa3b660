// The reserved names of the language of expressions.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "expressions/expression_program.hpp"

namespace gnomon {

struct ExpressionFunction {
  std::string_view name;
  Operation operation;
  std::size_t least_arguments, most_arguments;
};

/// All functions except `if`, which does not evaluate all of its arguments.
const ExpressionFunction* find_function(std::string_view name);

/// Whether the name is reserved, so that a scene cannot use it for something else.
bool is_reserved(std::string_view name);

/// The message that there is no such name, with the nearest name and the list of all names.
std::string unknown_expression_name(std::string_view name, const ExpressionNames& names);

}  // namespace gnomon
