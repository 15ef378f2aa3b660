// The interface of a term: a part of the equations that adds to the rows of some fields and reads
// others.
#pragma once

#include <functional>
#include <gnomon/fields/numbering.hpp>
#include <gnomon/fields/sparse_pattern.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// The contributions of terms to the structure of a system.
struct TermStructure {
  PatternBuilder& pattern;               ///< of J
  std::vector<int> switch_node = {};     ///< mesh node of each switching function of the term
  std::vector<char> switch_jumps = {};   ///< of each: whether rates may jump there
  std::vector<double> breakpoints = {};  ///< times at which the term may have a kink in t
  std::vector<double> stops = {};        ///< times at which steps shall end (Structure)
  bool slow = false;  ///< its derivatives change slowly and are expensive (SlowPart)
  /// It sweeps over all cells of a mesh, and no other term of the system that does so adds to its
  /// rows, which are not differential: such terms are evaluated at the same time, each by one
  /// thread, where there are many, and not at all for rates.
  bool sweeps_cells = false;
};

/// The point at which a term is evaluated.
template <int dim>
struct Evaluation {
  const FieldValues<dim>& values;  ///< of all fields
  std::span<const double> ydot;    ///< of the system; may be empty if nothing is differential
  double t = 0;                    ///< [time]
  double within = 0;               ///< time whose smooth part in t is continued to t [time]
  double load_fraction = 1;        ///< of all loads: less than one in a load ramp
  std::span<const char> branch{};  ///< of the term's switching functions, 1: active; empty: by sign
};

/// Made for one numbering.
template <int dim>
class Term {
public:
  virtual ~Term() = default;

  /// Adds rows x columns of J to the pattern, switching functions and breakpoints to their lists.
  virtual void declare(TermStructure& structure) const = 0;
  /// Computes the positions of its entries in the values of J; called once, after the pattern is
  /// built.
  virtual void map_to(const SparsePattern&) {}
  /// F += residual. Throws RecoverableError if there is none (inverted element).
  virtual void add_residual(const Evaluation<dim>& at, std::span<double> F) const = 0;
  /// values += dF/dy + rate_weight dF/dydot. Same errors.
  virtual void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                            std::span<double> values) const = 0;
  /// One value per entry of TermStructure::switch_node, <= 0 where it is active.
  virtual void switching(const Evaluation<dim>&, std::span<double>) const {}
};

/// A term of a numbering: systems of some blocks are made of the same factories as the whole.
template <int dim>
using TermFactory = std::function<std::unique_ptr<Term<dim>>(const Numbering&)>;

}  // namespace gnomon
