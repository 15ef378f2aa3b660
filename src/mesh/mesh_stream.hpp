// What the process that uses Gmsh passes to gnomon: a letter, then a mesh or a complaint. Both ends
// are of one build, so numbers go as they lie in memory.
#pragma once

#include <algorithm>
#include <gnomon/mesh/imported_mesh.hpp>

namespace gnomon::mesh_stream {

inline constexpr char sound = 'M', complaint = 'C';

/// The file descriptor on which the process writes.
inline constexpr int descriptor = 3;

/// Visits everything that is handed over, in a fixed order.
template <class Mesh, class Visitor>
void visit(Mesh& mesh, Visitor&& one) {
  const auto elements = [&one](auto& list) {
    one(list.kinds);
    one(list.tags);
    one(list.start);
    one(list.nodes);
  };
  one(mesh.dimension);
  one(mesh.nodes);
  one(mesh.node_tags);
  elements(mesh.cells);
  elements(mesh.facets);
  one(mesh.remarks);
  one(mesh.groups);
}

/// Writes through `put(bytes, count)`.
template <class Put>
struct Writer {
  Put put;

  template <class T>
  void operator()(const T& value) {
    put(&value, sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(values.size());
    put(values.data(), values.size() * sizeof(T));
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    put(text.data(), text.size());
  }
  void operator()(const std::vector<std::string>& texts) {
    (*this)(texts.size());
    for (const std::string& text : texts) (*this)(text);
  }
  void operator()(const std::vector<MeshGroup>& groups) {
    (*this)(groups.size());
    for (const MeshGroup& group : groups) {
      (*this)(group.name);
      (*this)(group.dimension);
      (*this)(group.members);
    }
  }
};

/// Reads through `get(bytes, count)`, which throws at the end of the stream. Sizes are believed in
/// small portions only: memory that Gmsh has spoilt must not make gnomon ask for all there is.
template <class Get>
struct Reader {
  Get get;

  template <class T>
  void operator()(T& value) {
    get(&value, sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    constexpr std::size_t portion = (std::size_t{1} << 22) / sizeof(T);
    values.clear();
    for (std::size_t left = size(); left > 0;) {
      const std::size_t now = std::min(left, portion), old = values.size();
      values.resize(old + now);
      get(values.data() + old, now * sizeof(T));
      left -= now;
    }
  }
  void operator()(std::string& text) {
    std::vector<char> letters;
    (*this)(letters);
    text.assign(letters.begin(), letters.end());
  }
  void operator()(std::vector<std::string>& texts) {
    texts.clear();
    for (std::size_t left = size(); left > 0; --left) (*this)(texts.emplace_back());
  }
  void operator()(std::vector<MeshGroup>& groups) {
    groups.clear();
    for (std::size_t left = size(); left > 0; --left) {
      MeshGroup& group = groups.emplace_back();
      (*this)(group.name);
      (*this)(group.dimension);
      (*this)(group.members);
    }
  }

private:
  std::size_t size() {
    std::size_t result = 0;
    get(&result, sizeof result);
    return result;
  }
};

}  // namespace gnomon::mesh_stream
