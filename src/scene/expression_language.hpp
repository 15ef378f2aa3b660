// The names that the language of expressions has of its own.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scene/expression_program.hpp"

namespace gnomon {

struct ExpressionFunction {
  std::string_view name;
  Operation operation;
  std::size_t least_arguments, most_arguments;
};

/// All functions but `if`, which does not evaluate all of its arguments.
const ExpressionFunction* find_function(std::string_view name);

/// Whether a scene may not use the name for something else.
bool is_reserved(std::string_view name);

/// Says that there is no such name, which one may have been meant, and which ones there are.
std::string unknown_expression_name(std::string_view name, const ExpressionNames& names);

}  // namespace gnomon
