// Numbering of the unknowns: which value of which field is which entry of y.
#pragma once

#include <gnomon/fields/field.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// Which blocks of a FieldSet a system solves for, one flag for each; the others are frozen.
using BlockSelection = std::vector<char>;

/// Numbers are -1 where a value is held, frozen or absent. Node by node, the fields of a node in
/// the order of the set, components ascending; then the values at no node. Entities that share the
/// unknowns of a carrier share its numbers.
class Numbering {
public:
  Numbering(std::shared_ptr<const FieldSet> set, const BlockSelection& selected);

  const FieldSet& set() const { return *set_; }
  int size() const { return static_cast<int>(node_.size()); }
  /// Entities x components; empty for an absent field.
  const Field::Indices& numbers(FieldId id) const {
    return id == FieldId::none ? absent_ : numbers_[static_cast<std::size_t>(id)];
  }
  /// The same for a vector field.
  template <int dim>
  NodalNumbers<dim> nodal(FieldId id) const {
    return numbers(id);
  }
  /// Number of a value, -1 if it has none or the field is absent.
  int number(FieldId id, Eigen::Index entity, int component = 0) const {
    return id == FieldId::none ? -1 : numbers(id)(entity, component);
  }

  // One entry for each unknown:
  const std::vector<int>& node() const {
    return node_;
  }  ///< mesh node; the number of nodes: at no node
  const std::vector<int>& block() const { return block_; }  ///< in set().blocks
  const std::vector<char>& component() const { return component_; }
  const std::vector<double>& row_scale() const { return row_scale_; }
  const std::vector<double>& unknown_scale() const { return unknown_scale_; }

  /// Copies y into the values, those without a number untouched.
  template <int dim>
  void scatter(std::span<const double> y, FieldValues<dim>& values) const;
  /// Copies the values into y.
  template <int dim>
  void gather(const FieldValues<dim>& values, std::span<double> y) const;

private:
  void number_entity(std::size_t field, int entity, const BlockSelection& selected);

  std::shared_ptr<const FieldSet> set_;
  std::vector<Field::Indices> numbers_;
  Field::Indices absent_;
  std::vector<int> node_, block_;
  std::vector<char> component_;
  std::vector<double> row_scale_, unknown_scale_;
};

}  // namespace gnomon
