#include <algorithm>
#include <gnomon/system/composed_system.hpp>

namespace gnomon {

template <int dim>
ComposedSystem<dim>::ComposedSystem(std::shared_ptr<const Composition<dim>> composition,
                                    const BlockSelection& selected)
    : composition_(std::move(composition)),
      numbering_(composition_->fields, selected),
      values_(*composition_->fields) {
  for (const TermFactory<dim>& make : composition_->terms) terms_.push_back(make(numbering_));
  build_structure();
}

template <int dim>
ComposedSystem<dim>::ComposedSystem(std::shared_ptr<const Composition<dim>> composition)
    : ComposedSystem(composition, BlockSelection(composition->fields->blocks.size(), 1)) {}

template <int dim>
void ComposedSystem<dim>::build_structure() {
  PatternBuilder builder(numbering_.size());
  std::vector<double>& breakpoints = structure_.breakpoints;
  first_switch_.push_back(0);
  for (const auto& term : terms_) {
    TermStructure part{.pattern = builder};
    term->declare(part);
    auto& nodes = structure_.switch_node;
    nodes.insert(nodes.end(), part.switch_node.begin(), part.switch_node.end());
    first_switch_.push_back(nodes.size());
    breakpoints.insert(breakpoints.end(), part.breakpoints.begin(), part.breakpoints.end());
  }
  for (const PrescribedValues& held : composition_->prescribed)
    breakpoints.insert(breakpoints.end(), held.history.times().begin(), held.history.times().end());
  std::sort(breakpoints.begin(), breakpoints.end());
  breakpoints.erase(std::unique(breakpoints.begin(), breakpoints.end()), breakpoints.end());
  structure_.size = numbering_.size();
  structure_.pattern = builder.build();
  for (const auto& term : terms_) term->map_to(structure_.pattern);
  structure_.group = numbering_.node();
  structure_.row_scale = numbering_.row_scale();
  structure_.unknown_scale = numbering_.unknown_scale();
  structure_.solver = composition_->solver;
  structure_.blocks = composition_->fields->blocks;
  structure_.block = numbering_.block();
  structure_.component = numbering_.component();
  structure_.position = composition_->position;
  structure_.position.resize(composition_->fields->nodes + 1);  // the last: at no node
  structure_.coarsening = composition_->coarsening;
  for (int block : structure_.block)
    structure_.differential.push_back(structure_.blocks[block].role == Role::evolution);
}

template <int dim>
Evaluation<dim> ComposedSystem<dim>::evaluation(const Point& at, const FieldValues<dim>& values,
                                                std::size_t k) const {
  Evaluation<dim> evaluation{.values = values,
                             .ydot = at.ydot,
                             .t = time(at),
                             .within = within(at),
                             .load_fraction = load_fraction_};
  if (at.branch)
    evaluation.branch = std::span<const char>(*at.branch)
                            .subspan(first_switch_[k], first_switch_[k + 1] - first_switch_[k]);
  return evaluation;
}

template <int dim>
void ComposedSystem<dim>::fill(std::span<const double> y, double t, double within,
                               FieldValues<dim>& values) const {
  numbering_.scatter(y, values);
  for (const PrescribedValues& held : composition_->prescribed) {
    const double factor = load_fraction_ * held.history.factor(t, within);
    NodalField<dim>& field = values.vector(held.field);
    for (const PrescribedValues::Entry& entry : held.entries)
      field(entry.entity, entry.component) = factor * entry.value;
  }
}

template <int dim>
void ComposedSystem<dim>::residual(const Point& at, std::span<double> F) const {
  fill(at.y, time(at), within(at), values_);
  std::fill(F.begin(), F.end(), 0.0);
  for (std::size_t k = 0; k < terms_.size(); ++k)
    terms_[k]->add_residual(evaluation(at, values_, k), F);
}

template <int dim>
void ComposedSystem<dim>::jacobian(const Point& at, double alpha, std::span<double> values) const {
  fill(at.y, time(at), within(at), values_);
  std::fill(values.begin(), values.end(), 0.0);
  for (std::size_t k = 0; k < terms_.size(); ++k)
    terms_[k]->add_jacobian(evaluation(at, values_, k), alpha, values);
}

template <int dim>
void ComposedSystem<dim>::switching(double t, std::span<const double> y,
                                    std::span<double> values) const {
  const Point at{.t = t, .y = y};
  fill(y, time(at), within(at), values_);
  for (std::size_t k = 0; k < terms_.size(); ++k)
    terms_[k]->switching(evaluation(at, values_, k),
                         values.subspan(first_switch_[k], first_switch_[k + 1] - first_switch_[k]));
}

template <int dim>
FieldValues<dim> ComposedSystem<dim>::values(double t, std::span<const double> y) const {
  FieldValues<dim> result = values_;
  const Point at{.t = t, .y = y};
  fill(y, time(at), within(at), result);
  return result;
}

template <int dim>
void ComposedSystem<dim>::freeze(FieldValues<dim> values, double t) {
  values_ = std::move(values);
  frozen_time_ = t;
}

template <int dim>
std::vector<AlgebraicStage> ComposedSystem<dim>::algebraic_stages() const {
  std::vector<AlgebraicStage> stages;
  for (const BlockSelection& selected : composition_->stages) {
    auto part = std::make_unique<ComposedSystem<dim>>(composition_, selected);
    AlgebraicStage stage;
    stage.unknowns.resize(static_cast<std::size_t>(part->numbering_.size()));
    for (std::size_t f = 0; f < composition_->fields->fields.size(); ++f) {
      const auto id = static_cast<FieldId>(f);
      const Field::Indices &mine = part->numbering_.numbers(id), &whole = numbering_.numbers(id);
      for (Eigen::Index k = 0; k < mine.size(); ++k)
        if (mine.data()[k] >= 0) stage.unknowns[mine.data()[k]] = whole.data()[k];
    }
    stage.freeze = [this, part = part.get()](double t, std::span<const double> y) {
      part->freeze(values(t, y), t);
    };
    stage.system = std::move(part);
    stages.push_back(std::move(stage));
  }
  return stages;
}

template class ComposedSystem<2>;
template class ComposedSystem<3>;

}  // namespace gnomon
