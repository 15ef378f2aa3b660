// What the process that uses Gmsh passes to gnomon: a letter, then a mesh or a complaint. Both ends
// are of one build, so numbers go as they lie in memory.
#pragma once

#include <algorithm>
#include <gnomon/mesh/imported_mesh.hpp>
#include <type_traits>

namespace gnomon::mesh_stream {

inline constexpr char sound = 'M', complaint = 'C';

/// The file descriptor on which the process writes a mesh.
inline constexpr int descriptor = 3;

/// Writes or reads objects in a fixed order of their parts, through `move(bytes, count)`, which
/// throws at the end of a stream that is read. Sizes are believed in small portions only: memory
/// that Gmsh has spoilt must not make gnomon ask for all there is.
template <bool reads, class Move>
struct Stream {
  Move move;

  void operator()(ImportedMesh& mesh) {
    all(mesh.dimension, mesh.nodes, mesh.node_tags, mesh.cells, mesh.facets, mesh.has_sizes,
        mesh.remarks, mesh.groups);
  }
  void operator()(ElementList& list) { all(list.kinds, list.tags, list.start, list.nodes); }
  void operator()(MeshGroup& group) { all(group.name, group.dimension, group.members); }

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(Number& number) { move(&number, sizeof number); }

  /// A vector or a text.
  template <class List>
  requires requires(List& list) { list.resize(1); }
  void operator()(List& list) {
    using Entry = typename List::value_type;
    constexpr bool as_in_memory = std::is_trivially_copyable_v<Entry>;
    constexpr std::size_t portion = as_in_memory ? (std::size_t{1} << 22) / sizeof(Entry) : 1;
    std::size_t size = list.size();
    (*this)(size);
    for (std::size_t done = 0; done < size; done += portion) {
      const std::size_t now = std::min(portion, size - done);
      if constexpr (reads) list.resize(done + now);
      if constexpr (as_in_memory)
        move(list.data() + done, now * sizeof(Entry));
      else
        (*this)(list[done]);
    }
  }

private:
  void all(auto&... parts) { ((*this)(parts), ...); }
};

}  // namespace gnomon::mesh_stream
