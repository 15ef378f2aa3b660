// Dead loads that follow a history: nodal forces on a body, and the force that presses a rigid
// counter-body.
#pragma once

#include <gnomon/base/error.hpp>
#include <gnomon/laws/load_history.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// - factor(t) f in the rows of a vector field (nodes x dim) or of a scalar one.
template <int dim>
class Loads : public Term<dim> {
public:
  /// What a load is for: one that alone keeps the bodies together may not vanish.
  enum class Purpose { presses, acts };

  /// `forces`: at factor one, entities x components of the field [force]. The field may be absent.
  Loads(const Numbering& numbering, FieldId field, const Field::Values& forces, LoadHistory history,
        Purpose purpose = Purpose::presses)
      : history_(std::move(history)), purpose_(purpose) {
    const Field::Indices& numbers = numbering.numbers(field);
    for (Eigen::Index k = 0; k < numbers.size(); ++k)
      if (numbers.data()[k] >= 0 && forces.data()[k] != 0)
        entries_.push_back({numbers.data()[k], forces.data()[k]});
  }

  void declare(TermStructure& structure) const override {
    structure.breakpoints.insert(structure.breakpoints.end(), history_.times().begin(),
                                 history_.times().end());
  }
  /// Throws if the load, continued past its breakpoint, is no longer positive.
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    if (entries_.empty()) return;
    const double factor = at.load_fraction * history_.factor(at.t, at.within);
    if (factor <= 0 && purpose_ == Purpose::presses)
      throw RecoverableError("no load is left at a stage past the end of the step");
    for (const Entry& entry : entries_) F[entry.row] -= factor * entry.force;
  }
  void add_jacobian(const Evaluation<dim>&, double, std::span<double>) const override {}

private:
  struct Entry {
    int row;
    double force;
  };
  LoadHistory history_;
  Purpose purpose_;
  std::vector<Entry> entries_;
};

}  // namespace gnomon
