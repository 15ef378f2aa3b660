// A mesh as a file of another program has it: nothing is checked, oriented or renumbered yet.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// Elements of first order, their nodes in the order of VTK (and Gmsh).
enum class ElementKind : std::uint8_t {
  point,
  line,
  triangle,
  quadrilateral,
  tetrahedron,
  hexahedron,
  wedge,
  pyramid
};
inline constexpr int element_kinds = 8;

int node_count(ElementKind kind);
int dimension_of(ElementKind kind);
const char* name_of(ElementKind kind);  ///< "triangle"

/// Elements of any kinds, one after the other.
struct ElementList {
  std::vector<ElementKind> kinds;
  std::vector<std::int64_t> tags;  ///< as the file numbers them
  std::vector<int> start = {0};    ///< of each element in `nodes`, and the end
  std::vector<int> nodes;          ///< indices of nodes of the mesh

  int size() const { return static_cast<int>(kinds.size()); }
  std::span<const int> at(int element) const {
    return {nodes.data() + start[element],
            static_cast<std::size_t>(start[element + 1] - start[element])};
  }
  void add(ElementKind kind, std::int64_t tag, std::span<const int> element_nodes);
};

/// A named set of elements of one dimension.
struct MeshGroup {
  std::string name;
  int dimension = 0;
  /// Of the dimension of the mesh: indices of its cells; of one less: of its facets; below that:
  /// indices of nodes.
  std::vector<int> members;
};

struct ImportedMesh {
  std::string file;   ///< for messages
  int dimension = 0;  ///< of the cells, the highest that the file has: 2 or 3 where it can be used
  std::vector<std::array<double, 3>> nodes;  ///< positions [length]
  std::vector<std::int64_t> node_tags;       ///< as the file numbers them
  ElementList cells;                         ///< of the dimension of the mesh
  ElementList facets;                        ///< one dimension less
  std::vector<MeshGroup> groups;
  bool has_sizes = true;             ///< a geometry may have none, and Gmsh chooses
  std::vector<std::string> remarks;  ///< what the user should know about the reading, in sentences
};

}  // namespace gnomon
