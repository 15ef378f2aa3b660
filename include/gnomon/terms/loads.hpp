// Dead loads that follow a history: nodal forces on a body, and the force that presses a rigid
// counter-body.
#pragma once

#include <gnomon/laws/load_history.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// - factor(t) f in the rows of a vector field (nodes x dim) or of a scalar one.
template <int dim>
class Loads : public Term<dim> {
public:
  /// `forces`: at factor one, entities x components of the field [force]. The field may be absent.
  /// The history must outlive the term.
  Loads(const Numbering& numbering, FieldId field, const Field::Values& forces,
        const LoadHistory& history);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern&) override {}
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>&, double, std::span<double>) const override {}
  void switching(const Evaluation<dim>&, std::span<double>) const override {}

private:
  struct Entry {
    int row;
    double force;
  };
  const LoadHistory& history_;
  std::vector<Entry> entries_;
};

}  // namespace gnomon
