// Terms that scenes may add to a worn body. A new term is one file with a Registration; nothing
// else has to change.
#pragma once

#include <functional>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/registry.hpp>
#include <string>
#include <vector>

namespace gnomon {

struct AddedTerm {
  std::string name;  ///< "springs"
  std::string help;  ///< one line
  /// Keys that are added to all scenes with a worn body; therefore they are optional or have a
  /// default.
  std::vector<Key> keys;
  /// The term that a scene requests; an empty function if it requests none. Throws InputError if
  /// its keys contradict each other.
  std::function<AddedTermFactory<2>(const Scene&)> in_the_plane;
  std::function<AddedTermFactory<3>(const Scene&)> in_space;

  /// For Registry. A term of one dimension alone refuses, or is no term, in the other.
  std::string missing() const {
    return !in_the_plane ? "in_the_plane" : !in_space ? "in_space" : "";
  }
};

using AddedTerms = Registry<AddedTerm>;

/// The terms that the scene requests.
template <int dim>
std::vector<AddedTermFactory<dim>> added_terms(const Scene& scene) {
  std::vector<AddedTermFactory<dim>> result;
  for (const AddedTerm& term : AddedTerms::all()) {
    AddedTermFactory<dim> factory;
    if constexpr (dim == 2)
      factory = term.in_the_plane(scene);
    else
      factory = term.in_space(scene);
    if (factory) result.push_back(std::move(factory));
  }
  return result;
}

}  // namespace gnomon
