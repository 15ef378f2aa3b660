#include <algorithm>
#include <array>
#include <gnomon/fields/numbering.hpp>

namespace gnomon {

Numbering::Numbering(std::shared_ptr<const FieldSet> set, const BlockSelection& selected)
    : set_(std::move(set)) {
  std::vector<std::array<int, 3>> order;  // node, field, entity
  for (int f = 0; f < static_cast<int>(set_->fields.size()); ++f) {
    const Field& field = set_->fields[f];
    numbers_.push_back(Field::Indices::Constant(field.entities(), field.components(), -1));
    for (int entity = 0; entity < field.entities(); ++entity)
      if (field.carrier_of(entity) == entity) order.push_back({field.node[entity], f, entity});
  }
  std::ranges::sort(order);
  for (const auto& [node, f, entity] : order) {
    const Field& field = set_->fields[f];
    for (int i = 0; i < field.components(); ++i) {
      if (!is_unknown(field, entity, i, selected)) continue;
      numbers_[f](entity, i) = size();
      unknowns_.push_back({field, entity, i});
    }
  }
  for (std::size_t f = 0; f < set_->fields.size(); ++f) {
    for (int entity = 0; entity < set_->fields[f].entities(); ++entity)
      numbers_[f].row(entity) = numbers_[f].row(set_->fields[f].carrier_of(entity)).eval();
    if (set_->fields[f].direction.size() > 0) number_multiples(f, selected);
  }
}

/// Of an entity with a direction, the component that is largest stands for the unknown.
bool Numbering::is_unknown(const Field& field, int entity, int component,
                           const BlockSelection& selected) const {
  const int block = field.block(entity, component);
  if (block < 0 || !selected[block]) return false;
  if (!field.has_direction(entity)) return true;
  Eigen::Index largest = 0;
  field.direction.row(entity).cwiseAbs().maxCoeff(&largest);
  return component == largest;
}

void Numbering::number_multiples(std::size_t f, const BlockSelection& selected) {
  const Field& field = set_->fields[f];
  const Field::Indices of_carriers = numbers_[f];
  for (int entity = 0; entity < field.entities(); ++entity) {
    if (!field.has_direction(entity)) continue;
    numbers_[f].row(entity).setConstant(-1);
    const int unknown = of_carriers.row(entity).maxCoeff();
    if (unknown < 0) continue;
    for (int i = 0; i < field.components(); ++i) {
      const int block = field.block(entity, i);
      if (block < 0 || !selected[block]) continue;
      numbers_[f](entity, i) = all_numbers();
      multiples_.push_back({unknown, field.direction(entity, i)});
    }
  }
}

template <int dim>
void Numbering::scatter(std::span<const double> y, FieldValues<dim>& values) const {
  for (std::size_t f = 0; f < numbers_.size(); ++f) {
    double* value = values.data(f);
    for (Eigen::Index k = 0; k < numbers_[f].size(); ++k)
      if (const int number = numbers_[f].data()[k]; number >= 0) {
        const auto [unknown, factor] = meaning(number);
        value[k] = factor * y[unknown];
      }
  }
}

template <int dim>
void Numbering::gather(const FieldValues<dim>& values, std::span<double> y) const {
  for (const Multiple& multiple : multiples_) y[multiple.unknown] = 0;
  for (std::size_t f = 0; f < numbers_.size(); ++f) {
    const Field& field = set_->fields[f];
    const double* value = values.data(f);
    for (Eigen::Index k = 0; k < numbers_[f].size(); ++k) {
      const int number = numbers_[f].data()[k];
      if (number < 0) continue;
      if (number < size())
        y[number] = value[k];
      else if (const int entity = static_cast<int>(k / field.components());
               field.carrier_of(entity) == entity)
        y[meaning(number).unknown] += meaning(number).factor * value[k];
    }
  }
}

template void Numbering::scatter(std::span<const double>, FieldValues<2>&) const;
template void Numbering::scatter(std::span<const double>, FieldValues<3>&) const;
template void Numbering::gather(const FieldValues<2>&, std::span<double>) const;
template void Numbering::gather(const FieldValues<3>&, std::span<double>) const;

}  // namespace gnomon
