// The names that a scene gives to constants and tables of its expressions.
#pragma once

#include <gnomon/expressions/expression.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>

namespace gnomon {

/// Throws InputError for a name that the scene chooses, with this key, and that is taken.
void require_free_name(const Scene& scene, const std::string& key, const std::string& name,
                       const ExpressionNames& names);

/// The piecewise linear function through these points. Throws InputError, which begins with
/// `where`.
PiecewiseLinear linear_table(const std::vector<double>& x, const std::vector<double>& y,
                             const std::string& where);

/// Adds the tables of the scene, tables.NAME.x and .y. Throws InputError.
void add_tables(const Scene& scene, ExpressionNames& names);

}  // namespace gnomon
