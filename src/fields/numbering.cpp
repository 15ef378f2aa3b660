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
      const int block = field.block(entity, i);
      if (block < 0 || !selected[block]) continue;
      numbers_[f](entity, i) = size();
      unknowns_.push_back({field, entity, i});
    }
  }
  for (std::size_t f = 0; f < set_->fields.size(); ++f)
    for (int entity = 0; entity < set_->fields[f].entities(); ++entity)
      numbers_[f].row(entity) = numbers_[f].row(set_->fields[f].carrier_of(entity)).eval();
}

template <int dim>
void Numbering::scatter(std::span<const double> y, FieldValues<dim>& values) const {
  for (std::size_t f = 0; f < numbers_.size(); ++f) {
    double* value = values.data(f);
    for (Eigen::Index k = 0; k < numbers_[f].size(); ++k)
      if (const int number = numbers_[f].data()[k]; number >= 0) value[k] = y[number];
  }
}

template <int dim>
void Numbering::gather(const FieldValues<dim>& values, std::span<double> y) const {
  for (std::size_t f = 0; f < numbers_.size(); ++f) {
    const double* value = values.data(f);
    for (Eigen::Index k = 0; k < numbers_[f].size(); ++k)
      if (const int number = numbers_[f].data()[k]; number >= 0) y[number] = value[k];
  }
}

template void Numbering::scatter(std::span<const double>, FieldValues<2>&) const;
template void Numbering::scatter(std::span<const double>, FieldValues<3>&) const;
template void Numbering::gather(const FieldValues<2>&, std::span<double>) const;
template void Numbering::gather(const FieldValues<3>&, std::span<double>) const;

}  // namespace gnomon
