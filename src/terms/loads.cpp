#include <gnomon/base/error.hpp>
#include <gnomon/terms/loads.hpp>

namespace gnomon {

template <int dim>
Loads<dim>::Loads(const Numbering& numbering, FieldId field, const Field::Values& forces,
                  LoadHistory history, Purpose purpose)
    : history_(std::move(history)), purpose_(purpose) {
  const Field::Indices& numbers = numbering.numbers(field);
  for (Eigen::Index k = 0; k < numbers.size(); ++k)
    if (numbers.data()[k] >= 0 && forces.data()[k] != 0)
      entries_.push_back({numbers.data()[k], forces.data()[k]});
}

template <int dim>
void Loads<dim>::declare(TermStructure& structure) const {
  structure.breakpoints.insert(structure.breakpoints.end(), history_.times().begin(),
                               history_.times().end());
}

/// Throws if the load, continued past its breakpoint, is no longer positive.
template <int dim>
void Loads<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  if (entries_.empty()) return;
  const double factor = at.load_fraction * history_.factor(at.t, at.within);
  if (factor <= 0 && purpose_ == Purpose::presses)
    throw RecoverableError("no load is left at a stage past the end of the step");
  for (const Entry& entry : entries_) F[entry.row] -= factor * entry.force;
}

template class Loads<2>;
template class Loads<3>;

}  // namespace gnomon
