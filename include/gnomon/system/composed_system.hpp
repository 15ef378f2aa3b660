// A system of terms over fields, or a part of it with the other blocks frozen.
#pragma once

#include <functional>
#include <gnomon/fields/reduced_entries.hpp>
#include <gnomon/system/system.hpp>
#include <gnomon/terms/term.hpp>
#include <memory>
#include <optional>

namespace gnomon {

template <int dim>
class ComposedSystem;

/// The parts of a system; shared by a system and its algebraic stages.
template <int dim>
struct Composition {
  std::shared_ptr<const FieldSet> fields;
  std::vector<TermFactory<dim>> terms;
  std::vector<PrescribedValues> prescribed;
  /// Blocks of the algebraic stages, in the order in which they are solved.
  std::vector<BlockSelection> stages;
  /// Called with the whole system whenever a stage that has Structure::remembered is frozen: sets
  /// fields without unknowns by the state of then.
  std::function<void(const ComposedSystem<dim>& whole, const Point& at, FieldValues<dim>& values)>
      remember;
  std::vector<std::array<double, 3>> position;  ///< of the mesh nodes, initial [length]
  std::shared_ptr<const std::vector<NodeInterpolation>> coarsening;  ///< as in Structure
  LinearSolverMaker solver;
  /// Of the mesh nodes, and at last of what is at no node: to which part of the mesh they belong,
  /// as of two bodies that touch; empty: all to one.
  std::vector<int> part;
};

/// F is the sum of the terms; the rows are those of the unknowns of the selected blocks. Not safe
/// for concurrent calls on one object, because it has a workspace.
template <int dim>
class ComposedSystem : public System {
public:
  ComposedSystem(std::shared_ptr<const Composition<dim>> composition,
                 const BlockSelection& selected);
  /// The system of all blocks.
  explicit ComposedSystem(std::shared_ptr<const Composition<dim>> composition);

  const Structure& structure() const override { return structure_; }
  void residual(const Point& at, std::span<double> F) const override;
  void jacobian(const Point& at, double alpha, std::span<double> values) const override;
  void switching(const Point& at, std::span<double> values) const override;
  std::vector<AlgebraicStage> algebraic_stages() const override;

  const Numbering& numbering() const { return numbering_; }
  /// Values of all fields at y and t; those of frozen blocks as last given to freeze() (zero
  /// before).
  FieldValues<dim> values(double t, std::span<const double> y) const;
  /// Sets the values of the blocks that this system does not solve for, and the frozen time.
  void freeze(FieldValues<dim> values, double t);
  /// The term of the k-th factory, and where it is evaluated at a point with these values.
  const Term<dim>& term(std::size_t k) const { return *terms_[k]; }
  Evaluation<dim> evaluation(const Point& at, const FieldValues<dim>& values, std::size_t k) const;
  /// Fraction by which all loads and prescribed values are multiplied: less than one in a load
  /// ramp.
  void set_load_fraction(double fraction) { load_fraction_ = fraction; }

private:
  void build_structure();
  void reduce_entries();
  void find_shared_entries();
  void add_residuals(const Point& at, std::span<double> F) const;
  void add_jacobians(const Point& at, double alpha, std::span<double> values) const;
  double change_of_strain(std::span<const double> y0, std::span<const double> y) const;
  bool serves(const SlowPart& slow, std::span<const double> y) const;
  void keep(SlowPart& slow, std::span<const double> y, std::span<const double> values) const;
  /// Values of all fields at y, and those that are prescribed at t on the smooth part of `within`.
  void fill(std::span<const double> y, double t, double within, FieldValues<dim>& values) const;
  /// work(k) for all terms, or for those that are slow, or not; terms that sweep over cells first.
  template <class Work>
  void for_terms(std::optional<bool> slow, const Work& work) const;
  double time(const Point& at) const { return frozen_time_.value_or(at.t); }
  double within(const Point& at) const { return frozen_time_.value_or(at.within.value_or(at.t)); }

  std::shared_ptr<const Composition<dim>> composition_;
  Numbering numbering_;
  std::vector<std::unique_ptr<Term<dim>>> terms_;
  std::vector<std::size_t> first_switch_;  // of each term, and last their total number
  std::vector<char> slow_;                 // 1 for each term whose derivatives are slow
  std::vector<char> sweeps_;               // 1 for each term that sweeps over cells
  std::vector<int> shared_;                // entries of J to which terms add that are not slow
  // Where numbers are multiples of unknowns, and what terms have added to the rows and entries of
  // all numbers.
  std::optional<ReducedEntries> reduced_;
  mutable std::vector<double> all_rows_, all_entries_;
  Structure structure_;
  std::optional<double> frozen_time_;
  double load_fraction_ = 1;
  mutable FieldValues<dim> values_;  // frozen ones, and those of the last evaluation
};

}  // namespace gnomon
