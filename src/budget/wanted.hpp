// The values that accuracy.of asks for, and their errors.
#pragma once

#include <gnomon/budget/budget.hpp>
#include <vector>

namespace gnomon::budget {

/// accuracy.within. Throws InputError where the scene does not have it.
double read_within(const Scene& scene);

/// Their places among `values`. Throws InputError for a word that has no value.
std::vector<std::size_t> wanted_places(const Scene& scene, const std::vector<Scalar>& values);

/// Those of `places`, all where no other is left, without the values that follow the ends of the
/// contact: on coarse elements they differ by which nodes close, whatever else is made finer.
std::vector<std::size_t> without_ends(const std::vector<std::size_t>& places,
                                      const std::vector<Scalar>& values);

/// An error that cannot be told counts as a whole one.
double assumed(double error);

/// The largest of the errors at some places.
double largest(const std::vector<double>& errors, const std::vector<std::size_t>& places);

}  // namespace gnomon::budget
