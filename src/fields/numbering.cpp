#include <gnomon/fields/numbering.hpp>

namespace gnomon {

namespace {

/// Entities of a field at every mesh node, and last those at no node.
std::vector<std::vector<int>> entities_by_node(const Field& field, int nodes) {
  std::vector<std::vector<int>> result(static_cast<std::size_t>(nodes) + 1);
  for (std::size_t entity = 0; entity < field.node.size(); ++entity)
    result[field.node[entity]].push_back(static_cast<int>(entity));
  return result;
}

}  // namespace

Numbering::Numbering(std::shared_ptr<const FieldSet> set, const BlockSelection& selected)
    : set_(std::move(set)) {
  std::vector<std::vector<std::vector<int>>> at;
  for (const Field& field : set_->fields) {
    numbers_.push_back(Field::Indices::Constant(field.entities(), field.components(), -1));
    at.push_back(entities_by_node(field, set_->nodes));
  }
  for (int node = 0; node <= set_->nodes; ++node)
    for (std::size_t f = 0; f < set_->fields.size(); ++f)
      for (int entity : at[f][node]) number_entity(f, entity, selected);
  for (std::size_t f = 0; f < set_->fields.size(); ++f)
    for (int entity = 0; entity < set_->fields[f].entities(); ++entity)
      numbers_[f].row(entity) = numbers_[f].row(set_->fields[f].carrier_of(entity)).eval();
}

void Numbering::number_entity(std::size_t f, int entity, const BlockSelection& selected) {
  const Field& field = set_->fields[f];
  if (field.carrier_of(entity) != entity) return;
  for (int i = 0; i < field.components(); ++i) {
    const int block = field.block(entity, i);
    if (block < 0 || !selected[block]) continue;
    numbers_[f](entity, i) = size();
    node_.push_back(field.node[entity]);
    block_.push_back(block);
    component_.push_back(static_cast<char>(i));
    row_scale_.push_back(field.row_scale(entity, i));
    unknown_scale_.push_back(field.unknown_scale(entity, i));
  }
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
