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
/// unknowns of a carrier share its numbers. Values along a Field::direction have numbers of their
/// own behind those of the unknowns, so that terms need not know of it: the system adds their rows
/// and columns to those of the unknown (ComposedSystem).
class Numbering {
public:
  Numbering(std::shared_ptr<const FieldSet> set, const BlockSelection& selected);

  const FieldSet& set() const { return *set_; }
  int size() const { return static_cast<int>(unknowns_.size()); }
  /// A number behind those of the unknowns stands for `factor` times an unknown.
  struct Multiple {
    int unknown;
    double factor;
  };
  /// Those from size() on.
  const std::vector<Multiple>& multiples() const { return multiples_; }
  /// Of unknowns and multiples: the rows and columns that terms see.
  int all_numbers() const { return size() + static_cast<int>(multiples_.size()); }
  /// What a number that is not negative stands for.
  Multiple meaning(int number) const {
    return number < size() ? Multiple{number, 1} : multiples_[number - size()];
  }
  /// By number: the value that it stands for. Of entities that share it, that of the carrier; along
  /// a direction its largest component, a multiple of the unknown.
  struct Unknown {
    const Field& field;
    int entity, component;
  };
  const std::vector<Unknown>& unknowns() const { return unknowns_; }
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

  /// Copies y into the values, those without a number untouched.
  template <int dim>
  void scatter(std::span<const double> y, FieldValues<dim>& values) const;
  /// Copies the values into y.
  template <int dim>
  void gather(const FieldValues<dim>& values, std::span<double> y) const;

private:
  bool is_unknown(const Field& field, int entity, int component,
                  const BlockSelection& selected) const;
  /// Of the entities of a field with directions; their carriers have the numbers of unknowns.
  void number_multiples(std::size_t field, const BlockSelection& selected);

  std::shared_ptr<const FieldSet> set_;
  std::vector<Field::Indices> numbers_;
  Field::Indices absent_;
  std::vector<Unknown> unknowns_;
  std::vector<Multiple> multiples_;
};

}  // namespace gnomon
