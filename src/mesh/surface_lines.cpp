#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/surface_lines.hpp>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "mesh/facet_table.hpp"
#include "mesh/line_coordinates.hpp"

namespace gnomon {

namespace {

/// Nodes of one facet.
template <int dim>
class Neighbours {
public:
  explicit Neighbours(const std::vector<typename Mesh<dim>::Facet>& facets) {
    for (const auto& facet : facets)
      for (const int a : facet)
        for (const int b : facet) pairs_.insert({a, b});
  }
  /// The first of the nodes of a circle, in its order, that no facet joins with that before it; -1:
  /// the circle is closed.
  int beginning(const std::vector<int>& circle) const {
    for (std::size_t k = 0; k < circle.size(); ++k)
      if (const int before = circle[(k + circle.size() - 1) % circle.size()];
          circle.size() < 3 || !pairs_.contains({before, circle[k]}))
        return circle[k];
    return -1;
  }

  /// Whether facets join all nodes of a line, in its order.
  bool join(const std::vector<int>& line) const {
    for (std::size_t k = 1; k < line.size(); ++k)
      if (!pairs_.contains({line[k - 1], line[k]})) return false;
    return true;
  }

private:
  std::set<std::pair<int, int>> pairs_;
};

using Groups = std::vector<std::vector<int>>;

/// Divides groups of nodes where their values, in order, are farther apart than the tolerance.
template <class Value>
Groups divided(const Groups& groups, double tolerance, const Value& value) {
  Groups result;
  for (std::vector<int> group : groups) {
    std::ranges::sort(group, {}, value);
    result.emplace_back();
    for (std::size_t k = 0; k < group.size(); ++k) {
      if (k > 0 && value(group[k]) - value(group[k - 1]) > tolerance) result.emplace_back();
      result.back().push_back(group[k]);
    }
  }
  return result;
}

template <int dim>
Vector<dim> edge(const Mesh<dim>& mesh, int from, int to) {
  return mesh.nodes[static_cast<std::size_t>(to)] - mesh.nodes[static_cast<std::size_t>(from)];
}

/// Lines that the edges of a surface follow, where it is curved along them; empty where they fork.
template <int dim>
Groups followed_lines(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
                      const Vector<dim>& along) {
  constexpr double least = 0.9;  // cosine between an edge and the direction
  std::map<int, std::set<int>> next, before;
  for (const auto& facet : facets)
    for (std::size_t k = 0; k < facet.size(); ++k) {
      int a = facet[k], b = facet[(k + 1) % facet.size()];
      const Vector<dim> way = edge(mesh, a, b);
      if (std::abs(way.dot(along)) < least * way.norm() || a == b) continue;
      if (way.dot(along) < 0) std::swap(a, b);
      next[a].insert(b);
      before[b].insert(a);
    }
  Groups lines;
  for (const int node : nodes_of_facets(facets)) {
    if (next[node].size() > 1 || before[node].size() > 1) return {};
    if (!before[node].empty()) continue;
    lines.push_back({node});
    while (!next[lines.back().back()].empty())
      lines.back().push_back(*next[lines.back().back()].begin());
  }
  return lines;
}

/// Whether all edges of a line have one direction.
template <int dim>
bool is_straight(const Mesh<dim>& mesh, const std::vector<int>& line) {
  constexpr double rounding = 1e-6;
  const auto direction = [&](std::size_t k) -> Vector<dim> {
    return edge(mesh, line[k - 1], line[k]).normalized();
  };
  for (std::size_t k = 2; k < line.size(); ++k)
    if ((direction(k) - direction(1)).norm() > rounding) return false;
  return true;
}

template <int dim>
std::string point_text(const Vector<dim>& x) {
  std::string text;
  for (int i = 0; i < dim; ++i) text += fmt::format("{}{:.4g}", i ? ", " : "", x[i]);
  return "(" + text + ")";
}

template <int dim>
InputError broken_line(const Streamlines<dim>& along, double whole, const Vector<dim>& start,
                       double length) {
  return InputError(fmt::format(
      "expected a surface whose nodes lie on {} {}, each {:.6g} mm long from one end of the "
      "surface to the other, but that through {} goes on for {:.6g} mm",
      along.centre ? "circles about" : "lines along",
      point_text<dim>(dim == 2 && along.centre ? *along.centre : along.along), whole,
      point_text<dim>(start), length));
}

/// How far nodes on chords, as those of cells that were subdivided, may lie within a circle.
template <int dim>
double depth_of_chords(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
                       double radius, int halvings) {
  constexpr double margin = 1.2;
  double longest = 0;
  for (const auto& facet : facets)
    for (const int node : facet)
      longest = std::max(longest, edge(mesh, facet.front(), node).norm());
  const double chord = std::exp2(halvings) * longest;
  return margin * chord * chord / (8 * radius);
}

template <int dim>
double shortest_edge(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& facet : facets)
    for (std::size_t k = 0; k < facet.size(); ++k)
      shortest = std::min(shortest, edge(mesh, facet[k], facet[(k + 1) % facet.size()]).norm());
  return shortest;
}

/// Up to nodes on chords.
template <int dim>
void require_circle(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
                    const Vector<dim>& centre) {
  constexpr double rounding = 1e-6;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const int node : nodes_of_facets(facets)) {
    const double radius = (mesh.nodes[static_cast<std::size_t>(node)] - centre).norm();
    least = std::min(least, radius), most = std::max(most, radius);
  }
  if (most - least > rounding * most + depth_of_chords(mesh, facets, most, 1))
    throw InputError(
        fmt::format("expected a surface whose nodes lie on a circle about {}, but their distances "
                    "from there are {:.6g} to {:.6g} mm",
                    point_text<dim>(centre), least, most));
}

/// Of circles: not a point on the axis, and in one piece.
template <int dim>
void require_arcs(const Mesh<dim>& mesh, const SurfaceLines& lines,
                  const Neighbours<dim>& neighbours, const Vector<dim>& centre,
                  const LineCoordinates<dim>& coordinates) {
  for (const std::vector<int>& line : lines.nodes) {
    const Vector<dim>& x = mesh.nodes[static_cast<std::size_t>(line.front())];
    if (coordinates.is_on_axis(x))
      throw InputError(fmt::format(
          "expected a surface that does not reach the axis of rotation through {}, as at {}",
          point_text<dim>(centre), point_text<dim>(x)));
    if (!neighbours.join(line))
      throw InputError(
          fmt::format("expected a surface in one piece along circles, but that through "
                      "{} is interrupted",
                      point_text<dim>(x)));
  }
}

}  // namespace

template <int dim>
SurfaceLines lines_of_surface(const Mesh<dim>& mesh,
                              const std::vector<typename Mesh<dim>::Facet>& facets,
                              const Streamlines<dim>& along) {
  constexpr double rounding = 1e-6;  // of the size of the surface: files have so many digits
  const auto at = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
  const std::set<int> nodes = nodes_of_facets(facets);
  if (dim == 2 && along.centre) require_circle<dim>(mesh, facets, *along.centre);
  std::vector<Vector<dim>> points;
  for (const int node : nodes) points.push_back(at(node));
  double size = 0;
  for (const Vector<dim>& x : points) size = std::max(size, (x - points.front()).norm());
  LineCoordinates<dim> coordinates(along, points);
  const auto lines_within = [&](double tolerance) {
    Groups groups = {{nodes.begin(), nodes.end()}};
    for (int i = 0; i < dim; ++i)
      if (dim == 3 || !along.centre)
        groups =
            divided(groups, tolerance, [&](int node) { return coordinates.across(at(node))[i]; });
    return groups;
  };
  const auto place = [&](int node) { return coordinates.place(at(node)); };
  const auto sort = [&](std::vector<int>& line) { std::ranges::sort(line, {}, place); };
  const Neighbours<dim> neighbours(facets);
  SurfaceLines lines;
  const auto arrange = [&](double tolerance) {
    lines.nodes = lines_within(tolerance);
    if (along.centre) {
      sort(lines.nodes.front());
      const int first = neighbours.beginning(lines.nodes.front());
      lines.closed = first < 0;
      if (!lines.closed) coordinates.begin_at(at(first));
    }
    std::ranges::for_each(lines.nodes, sort);
  };
  arrange(rounding * size);
  if (dim == 3 && along.centre &&
      !std::ranges::all_of(lines.nodes, [&](const auto& line) { return neighbours.join(line); })) {
    constexpr double apart = 0.25;  // of edges: other circles are farther away
    arrange(std::min(depth_of_chords(mesh, facets, coordinates.circumference() / (2 * M_PI), 2),
                     apart * shortest_edge(mesh, facets)));
  }
  if (along.centre) require_arcs(mesh, lines, neighbours, *along.centre, coordinates);
  const auto [first, last] = std::ranges::minmax_element(nodes, {}, place);
  const double low = place(*first), high = place(*last);
  lines.length = high - low;
  const auto is_broken = [&](const std::vector<int>& line) {
    if (lines.closed) return neighbours.beginning(line) >= 0;
    return std::max(place(line.front()) - low, high - place(line.back())) > rounding * size;
  };
  auto broken = std::ranges::find_if(lines.nodes, is_broken);
  if (broken == lines.nodes.end()) {
    if (!along.centre) return lines;
    points.clear();
    for (const int node : lines.nodes.front()) points.push_back(at(node));
    lines.length = coordinates.length_of(points, lines.closed);
    lines.circumference = coordinates.circumference();
    return lines;
  }
  if (Groups curved = along.centre ? Groups{} : followed_lines<dim>(mesh, facets, along.along);
      !curved.empty() && std::ranges::none_of(curved, [&](const std::vector<int>& line) {
        return is_broken(line) || is_straight<dim>(mesh, line);
      }))
    return {curved, lines.length};
  throw broken_line<dim>(along, lines.length, at(broken->front()),
                         place(broken->back()) - place(broken->front()));
}

template SurfaceLines lines_of_surface(const Mesh<2>&, const std::vector<Mesh<2>::Facet>&,
                                       const Streamlines<2>&);
template SurfaceLines lines_of_surface(const Mesh<3>&, const std::vector<Mesh<3>::Facet>&,
                                       const Streamlines<3>&);

}  // namespace gnomon
