#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/system/composed_system.hpp>

#include "base/threads.hpp"

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
  PatternBuilder builder(numbering_.all_numbers());
  const auto add = [](auto& list, const auto& more) {
    list.insert(list.end(), more.begin(), more.end());
  };
  std::vector<double>& breakpoints = structure_.breakpoints;
  std::vector<double>& stops = structure_.stops;
  first_switch_.push_back(0);
  for (const auto& term : terms_) {
    TermStructure part{.pattern = builder};
    term->declare(part);
    slow_.push_back(part.slow);
    sweeps_.push_back(part.sweeps_cells);
    add(structure_.switch_node, part.switch_node);
    add(structure_.switch_jumps, part.switch_jumps);
    structure_.switch_jumps.resize(structure_.switch_node.size());
    first_switch_.push_back(structure_.switch_node.size());
    add(breakpoints, part.breakpoints);
    add(stops, part.stops);
  }
  for (const PrescribedValues& held : composition_->prescribed)
    add(breakpoints, held.history.times());
  for (std::vector<double>* times : {&breakpoints, &stops}) {
    std::sort(times->begin(), times->end());
    times->erase(std::unique(times->begin(), times->end()), times->end());
  }
  structure_.size = numbering_.size();
  structure_.pattern = builder.build();
  if (!numbering_.multiples().empty()) reduce_entries();
  for (const auto& term : terms_) term->map_to(reduced_ ? reduced_->all() : structure_.pattern);
  if (!reduced_) find_shared_entries();
  structure_.solver = composition_->solver;
  const std::vector<Block>& blocks = composition_->fields->blocks;
  structure_.blocks = {composition_->fields, &blocks};
  structure_.position = composition_->position;
  structure_.position.resize(composition_->fields->nodes + 1);  // the last: at no node
  structure_.coarsening = composition_->coarsening;
  for (const auto& [field, entity, i] : numbering_.unknowns()) {
    const int block = field.block(entity, i);
    structure_.group.push_back(field.node[entity]);
    structure_.row_scale.push_back(field.row_scale(entity, i));
    structure_.unknown_scale.push_back(field.unknown_scale(entity, i));
    structure_.block.push_back(block);
    structure_.component.push_back(static_cast<char>(i));
    if (blocks[block].role == Role::memory && !blocks[block].differential)
      structure_.remembered.push_back(static_cast<int>(structure_.differential.size()));
    structure_.differential.push_back(blocks[block].differential);
    structure_.tolerance_scale.push_back(blocks[block].tolerance_scale);
  }
}

template <int dim>
void ComposedSystem<dim>::reduce_entries() {
  reduced_.emplace(numbering_, std::move(structure_.pattern));
  structure_.pattern = reduced_->pattern();
  all_rows_.resize(static_cast<std::size_t>(reduced_->all().size()));
  all_entries_.resize(static_cast<std::size_t>(reduced_->all().nonzeros()));
}

/// The entries to which terms add that are not slow. Where entries are reduced they are not in the
/// array that keeps the slow part, and all are computed anew.
template <int dim>
void ComposedSystem<dim>::find_shared_entries() {
  if (std::ranges::count(slow_, 1) == 0) return;
  PatternBuilder builder(numbering_.size());
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    if (slow_[k]) continue;
    TermStructure part{.pattern = builder};
    terms_[k]->declare(part);
  }
  const SparsePattern fast = builder.build();
  for (int column = 0; column < fast.size(); ++column)
    for (int k = fast.column_start[column]; k < fast.column_start[column + 1]; ++k)
      shared_.push_back(structure_.pattern.find(fast.row_index[k], column));
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
  add_residuals(at, reduced_ ? std::span<double>(all_rows_) : F);
  if (reduced_) reduced_->add_rows(all_rows_, F);
}

template <int dim>
void ComposedSystem<dim>::add_residuals(const Point& at, std::span<double> F) const {
  std::fill(F.begin(), F.end(), 0.0);
  for_terms(std::nullopt, [&](std::size_t k) {
    if (!at.rates_only || !sweeps_[k]) terms_[k]->add_residual(evaluation(at, values_, k), F);
  });
}

template <int dim>
template <class Work>
void ComposedSystem<dim>::for_terms(std::optional<bool> slow, const Work& work) const {
  std::vector<std::size_t> sweeping, others;
  for (std::size_t k = 0; k < terms_.size(); ++k)
    if (!slow || *slow == bool(slow_[k])) (sweeps_[k] ? sweeping : others).push_back(k);
  divide_among_threads(static_cast<long>(sweeping.size()),
                       static_cast<long>(structure_.pattern.row_index.size()),
                       [&](long i) { work(sweeping[i]); });
  for (std::size_t k : others) work(k);
}

namespace {

/// Whether an unknown belongs to the displacement (1) or to the shape (2); otherwise 0.
int motion(Role role) {
  if (role == Role::stiffness) return 1;
  return role == Role::extension || role == Role::evolution ? 2 : 0;
}

}  // namespace

/// The largest change, from `y0` to `y`, of the difference of a displacement or shape between
/// neighbours in a body, divided by their distance: of the order of the change of the slow part.
template <int dim>
double ComposedSystem<dim>::change_of_strain(std::span<const double> y0,
                                             std::span<const double> y) const {
  const SparsePattern& pattern = structure_.pattern;
  const std::vector<Block>& blocks = composition_->fields->blocks;
  const auto kind_of = [&](int i) { return motion(blocks[structure_.block[i]].role); };
  const auto place = [this](int i) { return structure_.position[structure_.group[i]]; };
  const std::vector<int>& part = composition_->part;
  const auto part_of = [&](int i) { return part.empty() ? 0 : part[structure_.group[i]]; };
  double largest = 0;
  const bool threaded = long(pattern.row_index.size()) >= worth_threads;
#pragma omp parallel for if (threaded) reduction(max : largest)
  for (int j = 0; j < pattern.size(); ++j) {
    const int kind = kind_of(j);
    if (kind == 0) continue;
    const double change = y[j] - y0[j];
    const std::array<double, 3> at = place(j);
    for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
      const int i = pattern.row_index[k];
      const bool alike = structure_.component[i] == structure_.component[j] && kind_of(i) == kind;
      if (i <= j || !alike || part_of(i) != part_of(j)) continue;
      const double difference = y[i] - y0[i] - change;
      const std::array<double, 3> other = place(i);
      double square = 0;
      for (int c = 0; c < dim; ++c) square += (other[c] - at[c]) * (other[c] - at[c]);
      if (difference * difference > largest * square) largest = difference * difference / square;
    }
  }
  return std::sqrt(largest);
}

/// Whether the slow part at hand serves at y. Where strains have changed by less than this, the
/// counts of Newton iterations of whole runs do not change (docs/notes/linear.md).
template <int dim>
bool ComposedSystem<dim>::serves(const SlowPart& slow, std::span<const double> y) const {
  constexpr double most = 0.1;
  return slow.known && change_of_strain(std::span(slow.values).subspan(shared_.size()), y) <= most;
}

template <int dim>
void ComposedSystem<dim>::jacobian(const Point& at, double alpha, std::span<double> values) const {
  fill(at.y, time(at), within(at), values_);
  add_jacobians(at, alpha, reduced_ ? std::span<double>(all_entries_) : values);
  if (reduced_) reduced_->add_entries(all_entries_, values);
}

template <int dim>
void ComposedSystem<dim>::add_jacobians(const Point& at, double alpha,
                                        std::span<double> values) const {
  const auto add = [&](bool slow) {
    for_terms(slow, [&](std::size_t k) {
      terms_[k]->add_jacobian(evaluation(at, values_, k), alpha, values);
    });
  };
  SlowPart* const slow = shared_.empty() ? nullptr : at.slow;
  if (slow && serves(*slow, at.y)) {
    for (std::size_t k = 0; k < shared_.size(); ++k) values[shared_[k]] = slow->values[k];
  } else {
    std::fill(values.begin(), values.end(), 0.0);
    if (slow) slow->known = false;
    add(true);
    if (slow) keep(*slow, at.y, values);
  }
  add(false);
}

template <int dim>
void ComposedSystem<dim>::keep(SlowPart& slow, std::span<const double> y,
                               std::span<const double> values) const {
  slow.values.clear();
  for (int entry : shared_) slow.values.push_back(values[entry]);
  slow.values.insert(slow.values.end(), y.begin(), y.end());
  slow.known = true;
}

template <int dim>
void ComposedSystem<dim>::switching(const Point& at, std::span<double> values) const {
  fill(at.y, time(at), within(at), values_);
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
  const std::vector<Block>& blocks = composition_->fields->blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (!blocks[b].differential &&
        std::ranges::none_of(composition_->stages, [b](const auto& stage) { return stage[b]; }))
      throw Error("block " + blocks[b].name + ": expected an algebraic stage that has it");
  for (const BlockSelection& selected : composition_->stages) {
    auto part = std::make_unique<ComposedSystem<dim>>(composition_, selected);
    // A single layer of elements has no shape unknowns off the worn surface.
    if (part->numbering_.size() == 0) continue;
    AlgebraicStage stage;
    stage.unknowns.resize(static_cast<std::size_t>(part->numbering_.size()));
    for (std::size_t f = 0; f < composition_->fields->fields.size(); ++f) {
      const auto id = static_cast<FieldId>(f);
      const Field::Indices &mine = part->numbering_.numbers(id), &whole = numbering_.numbers(id);
      for (Eigen::Index k = 0; k < mine.size(); ++k)
        if (mine.data()[k] >= 0)
          stage.unknowns[part->numbering_.meaning(mine.data()[k]).unknown] =
              numbering_.meaning(whole.data()[k]).unknown;
    }
    stage.freeze = [this, part = part.get()](double t, std::span<const double> y) {
      FieldValues<dim> now = values(t, y);
      if (!part->structure_.remembered.empty()) {
        composition_->remember(*this, {.t = t, .y = y}, now);
        values_ = now;
      }
      part->freeze(std::move(now), t);
    };
    stage.system = std::move(part);
    stages.push_back(std::move(stage));
  }
  return stages;
}

template class ComposedSystem<2>;
template class ComposedSystem<3>;

}  // namespace gnomon
