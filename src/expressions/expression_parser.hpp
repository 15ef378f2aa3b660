// Reads the text of an expression into a program.
#pragma once

#include <string>
#include <string_view>

#include "expressions/expression_program.hpp"

namespace gnomon {

/// Throws ExpressionError unless the names are as ExpressionNames says.
void check_expression_names(const ExpressionNames& names);

/// Throws ExpressionError for a text that is not an expression of these names.
ExpressionProgram parse_expression(std::string_view text, const ExpressionNames& names);

}  // namespace gnomon
