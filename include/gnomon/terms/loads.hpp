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
  /// What a load is for: one that alone keeps the bodies together may not vanish.
  enum class Purpose { presses, acts };

  /// `forces`: at factor one, entities x components of the field [force]. The field may be absent.
  Loads(const Numbering& numbering, FieldId field, const Field::Values& forces, LoadHistory history,
        Purpose purpose = Purpose::presses);

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
  LoadHistory history_;
  Purpose purpose_;
  std::vector<Entry> entries_;
};

}  // namespace gnomon
