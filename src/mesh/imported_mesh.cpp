#include <gnomon/mesh/imported_mesh.hpp>

namespace gnomon {

namespace {

struct KindFacts {
  const char* name;
  int dimension, nodes;
};

constexpr KindFacts facts[element_kinds] = {
    {"point", 0, 1},       {"line", 1, 2},       {"triangle", 2, 3}, {"quadrilateral", 2, 4},
    {"tetrahedron", 3, 4}, {"hexahedron", 3, 8}, {"wedge", 3, 6},    {"pyramid", 3, 5}};

}  // namespace

int node_count(ElementKind kind) {
  return facts[static_cast<int>(kind)].nodes;
}

int dimension_of(ElementKind kind) {
  return facts[static_cast<int>(kind)].dimension;
}

const char* name_of(ElementKind kind) {
  return facts[static_cast<int>(kind)].name;
}

void ElementList::add(ElementKind kind, std::int64_t tag, std::span<const int> element_nodes) {
  kinds.push_back(kind);
  tags.push_back(tag);
  nodes.insert(nodes.end(), element_nodes.begin(), element_nodes.end());
  start.push_back(static_cast<int>(nodes.size()));
}

}  // namespace gnomon
