// Values, flags and numbers at the nodes of a mesh, and values that are held.
#pragma once

#include <Eigen/Core>
#include <gnomon/base/tensor.hpp>
#include <gnomon/laws/load_history.hpp>
#include <map>
#include <vector>

namespace gnomon {

/// Row-major nodal field; row = entity (mesh node, contact node).
template <int dim>
using NodalField = Eigen::Matrix<double, Eigen::Dynamic, dim, Eigen::RowMajor>;
template <int dim>
using NodalFlags = Eigen::Matrix<char, Eigen::Dynamic, dim, Eigen::RowMajor>;
/// By node: the orthogonal projector on the plane or line along which its value may change.
template <int dim>
using NodalProjectors = std::map<int, Tensor<dim>>;
/// Numbers of nodal values in y; -1 where a value is held, frozen or absent.
template <int dim>
using NodalNumbers = Eigen::Matrix<int, Eigen::Dynamic, dim, Eigen::RowMajor>;

/// Position of a field in a FieldSet; none: the scene does not have the field.
enum class FieldId : int { none = -1 };

/// Values of a field that are held, but not at zero: value times the factor of a history.
struct PrescribedValues {
  struct Entry {
    int entity, component;
    double value;
  };
  FieldId field = FieldId::none;  ///< a vector field
  std::vector<Entry> entries;
  LoadHistory history;
};

}  // namespace gnomon
