#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/surface_lines.hpp>
#include <set>

namespace gnomon {

namespace {

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
std::string point_text(const Vector<dim>& x) {
  std::string text;
  for (int i = 0; i < dim; ++i) text += fmt::format("{}{:.6g}", i ? ", " : "", x[i]);
  return "(" + text + ")";
}

}  // namespace

template <int dim>
SurfaceLines lines_of_surface(const Mesh<dim>& mesh,
                              const std::vector<typename Mesh<dim>::Facet>& facets,
                              const Vector<dim>& along) {
  constexpr double rounding = 1e-6;  // of the size of the surface: files have so many digits
  std::set<int> nodes;
  for (const auto& facet : facets) nodes.insert(facet.begin(), facet.end());
  const auto at = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
  double size = 0;
  for (const int node : nodes) size = std::max(size, (at(node) - at(*nodes.begin())).norm());
  const double tolerance = rounding * size;
  const auto place = [&](int node) { return at(node).dot(along); };
  Groups lines = {{nodes.begin(), nodes.end()}};
  for (int i = 0; i < dim; ++i)
    lines = divided(lines, tolerance,
                    [&](int node) { return at(node)[i] - place(node) * along[i]; });
  const auto [first, last] = std::ranges::minmax_element(nodes, {}, place);
  const double low = place(*first), high = place(*last);
  for (std::vector<int>& line : lines) {
    std::ranges::sort(line, {}, place);
    const double from = place(line.front()), to = place(line.back());
    if (from - low > tolerance || high - to > tolerance)
      throw InputError(fmt::format(
          "expected a surface whose nodes lie on lines along {}, each {:.6g} mm long from one end "
          "of the surface to the other, but that through {} goes on for {:.6g} mm",
          point_text<dim>(along), high - low,
          point_text<dim>(at(line.front())), to - from));
  }
  return {std::move(lines), high - low};
}

template SurfaceLines lines_of_surface(const Mesh<2>&, const std::vector<Mesh<2>::Facet>&,
                                       const Vector<2>&);
template SurfaceLines lines_of_surface(const Mesh<3>&, const std::vector<Mesh<3>::Facet>&,
                                       const Vector<3>&);

}  // namespace gnomon
