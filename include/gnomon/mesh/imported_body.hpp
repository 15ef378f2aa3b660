// A mesh of another program, checked, repaired where that is harmless, and numbered for gnomon.
#pragma once

#include <cstdint>
#include <gnomon/mesh/imported_mesh.hpp>
#include <gnomon/mesh/mesh.hpp>

namespace gnomon {

/// A facet of the boundary as the file has it that stands for a piece of a smooth surface through
/// its nodes.
struct RoundFacet {
  std::vector<int> nodes;
  double area = 0;     ///< in the plane length
  double outside = 0;  ///< how far that surface lies outside of the body, in the mean [length]
};

/// Everything is plain arrays, so that a result can carry it.
template <int dim>
struct ImportedBody {
  using Facet = typename Mesh<dim>::Facet;

  std::string file;  ///< for messages
  /// Cells of positive volume, connected by facets, no node hanging. In `boundary` are the groups
  /// of facets that lie on the boundary as a whole, oriented outwards and each facet once. In 2D
  /// the nodes of the boundary come first, numbered along it with the body to the left, and the
  /// facets of each part follow in that order.
  Mesh<dim> mesh;
  std::vector<Facet> exterior;                           ///< the whole boundary, in the order above
  std::map<std::string, std::vector<int>> cell_groups;   ///< cells of each named volume (2D: area)
  std::map<std::string, std::vector<int>> point_groups;  ///< nodes of each group of points
  std::map<std::string, std::string> unusable;  ///< why a name is no boundary part, in words
  std::vector<std::int64_t> node_tags;          ///< in the user's file; 0: made by subdivision
  std::vector<std::int64_t> cell_tags;  ///< of the element that the cell is, or is a part of
  std::vector<RoundFacet> round;        ///< of bodies that may touch each other
  std::vector<std::string> remarks;     ///< what was repaired or is doubtful, in sentences
};

/// Checks a mesh and makes it one that gnomon computes with. Repaired, and said in the remarks:
/// cells and facets of either orientation, nodes of no cell, nodes at the same place, cells and
/// facets that are listed twice, a plane at constant z, cells that are to be subdivided
/// into quadrilaterals or hexahedra. Refused by InputError with the element and its place:
/// everything else that is not sound. A group that is no part of the boundary becomes `unusable`.
/// In 2D the numbers of the nodes ascend along the parts named `ascending` (contact surfaces) as
/// far as that is possible: they cannot along all of a closed curve. `splits`: times that each cell
/// becomes four (eight in space), with new nodes of the boundary on smooth curves through the old
/// ones. `separate`: groups of cells that are bodies of their own, which may touch each other.
template <int dim>
ImportedBody<dim> check_mesh(ImportedMesh mesh, const std::vector<std::string>& ascending = {},
                             int splits = 0, const std::vector<std::string>& separate = {});

/// The named groups of cells, if there are several and nodes that belong to two of them do not bond
/// all to one: bodies of their own, unless a scene says otherwise. Else none.
std::vector<std::string> separate_groups(const ImportedMesh& mesh);

/// The facets of a boundary part. Throws InputError that says why there is none, with the nearest
/// name, or all names.
template <int dim>
const std::vector<typename Mesh<dim>::Facet>& boundary_part(const ImportedBody<dim>& body,
                                                            const std::string& name);

/// The nodes of a boundary part, or of a group of points. Errors as boundary_part(), with the names
/// of groups of points among the others.
template <int dim>
std::vector<int> group_nodes(const ImportedBody<dim>& body, const std::string& name);

/// The mesh of a body with its groups, in the format of Gmsh that most programs read: 2.2, ASCII.
/// Positions are written such that reading gives the same numbers. A cell of several groups is in
/// the first of them; a facet of several is listed in each.
template <int dim>
std::string gmsh_text(const ImportedBody<dim>& body);

}  // namespace gnomon
