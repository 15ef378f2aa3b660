// Fields: which values are unknown, on which entities and of which size; and values of all fields.
#pragma once

#include <gnomon/fields/block.hpp>
#include <gnomon/fields/nodal.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Values over entities of the mesh, any number of components at each.
struct Field {
  using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Indices = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  std::string name;
  std::vector<int> node;  ///< mesh node of each entity; the number of nodes: an entity at no node
  Indices block;          ///< entities x components: FieldSet::blocks of each value, -1: held
  Values row_scale;       ///< entities x components: magnitude of F_i, in the unit of its row
  Values unknown_scale;   ///< entities x components: typical |y_i|
  /// The entity whose unknowns each entity shares (the shape of a groove is that of one section);
  /// empty: each entity has its own.
  std::vector<int> carrier;
  /// Entities x components, empty: of none. Where it is not zero, the entity has one unknown, that
  /// of its carrier, and its values are this unit vector times it: on a ring that recedes as a
  /// whole, every node moves along its own radius.
  Values direction;

  Field(std::string field_name, std::vector<int> nodes, int components)
      : name(std::move(field_name)),
        node(std::move(nodes)),
        block(Indices::Constant(entities(), components, -1)),
        row_scale(Values::Ones(entities(), components)),
        unknown_scale(Values::Ones(entities(), components)) {}

  Eigen::Index entities() const { return static_cast<Eigen::Index>(node.size()); }
  int components() const { return static_cast<int>(block.cols()); }
  int carrier_of(int entity) const { return carrier.empty() ? entity : carrier[entity]; }
  bool has_direction(int entity) const {
    return direction.size() > 0 && !direction.row(entity).isZero(0);
  }
};

/// All fields of a problem. Unknowns are numbered node by node, the fields of a node in this order,
/// and last the values at no node.
struct FieldSet {
  std::vector<Block> blocks;
  std::vector<Field> fields;
  int nodes = 0;  ///< of the mesh

  int add(Block b) {
    blocks.push_back(std::move(b));
    return static_cast<int>(blocks.size()) - 1;
  }
  FieldId add(Field field) {
    fields.push_back(std::move(field));
    return static_cast<FieldId>(fields.size() - 1);
  }
  const Field& operator[](FieldId id) const { return fields[static_cast<std::size_t>(id)]; }
  Field& operator[](FieldId id) { return fields[static_cast<std::size_t>(id)]; }
};

/// Values of all fields of a set, including held and frozen ones.
template <int dim>
class FieldValues {
public:
  FieldValues() = default;
  /// All values are zero.
  explicit FieldValues(const FieldSet& set) {
    for (const Field& field : set.fields) {
      const bool vector = field.components() == dim;
      vectors_.push_back(NodalField<dim>::Zero(vector ? field.entities() : 0, dim));
      others_.push_back(
          Field::Values::Zero(vector ? 0 : field.entities(), vector ? 0 : field.components()));
    }
  }
  /// A field of `dim` components: entities x dim.
  const NodalField<dim>& vector(FieldId id) const { return vectors_[index(id)]; }
  NodalField<dim>& vector(FieldId id) { return vectors_[index(id)]; }
  /// A field of any other number of components: entities x components.
  const Field::Values& matrix(FieldId id) const { return others_[index(id)]; }
  Field::Values& matrix(FieldId id) { return others_[index(id)]; }
  /// A field of one component: one value for each entity.
  auto scalar(FieldId id) const { return matrix(id).col(0); }
  auto scalar(FieldId id) { return matrix(id).col(0); }

  /// The values of one field, one after the other, entity by entity.
  double* data(std::size_t field) {
    return vectors_[field].size() > 0 ? vectors_[field].data() : others_[field].data();
  }
  const double* data(std::size_t field) const {
    return vectors_[field].size() > 0 ? vectors_[field].data() : others_[field].data();
  }

private:
  static std::size_t index(FieldId id) { return static_cast<std::size_t>(id); }
  std::vector<NodalField<dim>> vectors_;  // of a field with another number of components: empty
  std::vector<Field::Values> others_;     // of a field with `dim` components: empty
};

}  // namespace gnomon
