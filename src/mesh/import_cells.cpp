#include "mesh/import_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/mesh/cell_basis.hpp>

#include "mesh/import_nodes.hpp"

namespace gnomon {

namespace {

constexpr double no_volume = 1e-12;  // of the volume of a cube of the cell's longest edge
constexpr double poor_shape = 0.1;   // scaled Jacobian
constexpr double long_shape = 1000;  // longest edge by the shortest

struct CellShape {
  double volume = 0;                 ///< at the centroid [length^dim]
  double least = 0, most = 0;        ///< Jacobians at corners and Gauss points [length^dim]
  double scaled = 1;                 ///< least Jacobian of a corner by the lengths of its edges
  double shortest = 0, longest = 0;  ///< edges at the corners [length]
};

template <int dim>
CellShape shape_of(const CellNodal<dim>& X) {
  const CellBasis<dim>& basis = CellBasis<dim>::instance();
  const auto map = [&X](const CellNodal<dim>& gradients) {
    return Tensor<dim>(X.transpose() * gradients);
  };
  CellShape shape;
  shape.volume = map(basis.centroid).determinant() * (1 << dim);
  shape.least = shape.most = shape.volume;
  shape.shortest = std::numeric_limits<double>::infinity();
  const auto see = [&shape](double jacobian) {
    shape.least = std::min(shape.least, jacobian * (1 << dim));
    shape.most = std::max(shape.most, jacobian * (1 << dim));
  };
  for (int point = 0; point < CellBasis<dim>::points; ++point) {
    see(map(basis.gauss[point]).determinant());
    const Tensor<dim> corner = map(basis.corners[point]);
    see(corner.determinant());
    double lengths = 1;
    for (int i = 0; i < dim; ++i) {
      const double edge = 2 * corner.col(i).norm();
      lengths *= edge / 2;
      shape.shortest = std::min(shape.shortest, edge);
      shape.longest = std::max(shape.longest, edge);
    }
    shape.scaled = std::min(shape.scaled, corner.determinant() / lengths);
  }
  return shape;
}

/// The mirror image of the reference cell: the volume changes its sign.
template <int dim>
void turn(typename Mesh<dim>::Cell& cell) {
  if constexpr (dim == 2)
    std::swap(cell[1], cell[3]);
  else
    std::swap_ranges(cell.begin(), cell.begin() + 4, cell.begin() + 4);
}

template <int dim>
void check_shape(const ImportedBody<dim>& body, int cell, const CellShape& shape) {
  const double cube = std::pow(shape.longest, dim);
  const char* measure = dim == 2 ? "area" : "volume";
  if (std::max(std::abs(shape.least), std::abs(shape.most)) <= no_volume * cube)
    refuse_mesh(body.file, fmt::format("{} has no {}", cell_text(body, cell), measure));
  if (shape.least < 0 && shape.most > 0 && std::abs(shape.volume) <= 1e-6 * shape.most)
    refuse_mesh(body.file,
                fmt::format("{} crosses itself, expected its nodes in the order around it",
                            cell_text(body, cell)));
  if (shape.least <= no_volume * cube)
    refuse_mesh(body.file, fmt::format("{} is folded, expected {}", cell_text(body, cell),
                                       dim == 2 ? "inner angles below 180 degrees"
                                                : "a positive Jacobian at every corner"));
}

}  // namespace

template <int dim>
std::string cell_text(const ImportedBody<dim>& body, int cell) {
  const CellNodal<dim> X = body.mesh.positions(body.mesh.cells[cell]);
  const Vector<dim> middle = X.colwise().mean().transpose();
  return fmt::format("element {} at {}", body.cell_tags[cell],
                     place_text({middle.data(), static_cast<std::size_t>(dim)}));
}

template <int dim>
void orient_cells(ImportedBody<dim>& body) {
  long turned = 0, poor = 0, stretched = 0;
  int worst = 0, longest = 0;
  double scaled = 1, ratio = 1;
  for (int cell = 0; cell < static_cast<int>(body.mesh.cells.size()); ++cell) {
    CellShape shape = shape_of<dim>(body.mesh.positions(body.mesh.cells[cell]));
    if (shape.most < 0) {
      turn<dim>(body.mesh.cells[cell]);
      shape = shape_of<dim>(body.mesh.positions(body.mesh.cells[cell]));
      ++turned;
    }
    check_shape(body, cell, shape);
    poor += shape.scaled < poor_shape;
    stretched += shape.longest > long_shape * shape.shortest;
    if (shape.scaled < scaled) worst = cell;
    if (shape.longest > ratio * shape.shortest) longest = cell;
    scaled = std::min(scaled, shape.scaled);
    ratio = std::max(ratio, shape.longest / shape.shortest);
  }
  if (turned > 0)
    body.remarks.push_back(fmt::format("{} {} turned {}", counted(turned, "cell"),
                                       turned == 1 ? "was" : "were",
                                       dim == 2 ? "to counter-clockwise order" : "outside out"));
  if (poor > 0)
    body.remarks.push_back(
        fmt::format("{} badly shaped: the scaled Jacobian (1 for a {}) is {:.2g} in {}",
                    poor == 1 ? "1 cell is" : fmt::format("{} cells are", poor),
                    dim == 2 ? "rectangle" : "brick", scaled, cell_text(body, worst)));
  if (stretched > 0)
    body.remarks.push_back(
        fmt::format("{} very long: the longest edge is {:.2g} times the shortest in {}",
                    stretched == 1 ? "1 cell is" : fmt::format("{} cells are", stretched), ratio,
                    cell_text(body, longest)));
}

template std::string cell_text(const ImportedBody<2>&, int);
template std::string cell_text(const ImportedBody<3>&, int);
template void orient_cells(ImportedBody<2>&);
template void orient_cells(ImportedBody<3>&);

}  // namespace gnomon
