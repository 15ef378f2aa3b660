#include "model/tracks.hpp"

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <numeric>
#include <optional>
#include <string>

#include "model/connected_parts.hpp"
#include "model/initial_gradient.hpp"

namespace gnomon {

namespace {

/// Nodes with one shape, which is carried by the first.
template <int dim>
struct UniformLine {
  std::vector<int> nodes;
  double part;  ///< their length by that of the path
  std::optional<Streamlines<dim>> circle{};
};

template <int dim>
std::vector<UniformLine<dim>> lines_of(const CrossSection& section) {
  std::vector<UniformLine<dim>> lines;
  for (const int carrier : section.node)
    lines.push_back({{carrier}, section.length / section.path});
  for (std::size_t node = 0; node < section.of.size(); ++node)
    if (auto& line = lines[section.of[node]]; line.nodes.front() != static_cast<int>(node))
      line.nodes.push_back(static_cast<int>(node));
  return lines;
}

InputError held_otherwise(const std::string& where) {
  return InputError("an assembly: expected nodes of a " + where + " whose shape is held alike");
}

/// What one node of a line may do, all may.
template <int dim>
void require_alike(const std::vector<int>& nodes, const ShapeMotion<dim>& shape) {
  constexpr double rounding = 1e-12;
  const Tensor<dim> first = shape.free(nodes.front());
  for (const int node : nodes)
    if (!(shape.free(node) - first).isZero(rounding)) throw held_otherwise("line of a track");
}

/// Each node of a circle moves along one direction, that of its area, which is the same for all by
/// radius and axis.
template <int dim>
void require_one_direction(const std::vector<int>& nodes, const Streamlines<dim>& circle,
                           const AssemblyParts<dim>& parts, const NodalField<dim>& direction) {
  constexpr double rounding = 2e-6;  // components so small are held
  const auto across = [&](int node) {
    const Vector<dim>& X = parts.mesh.nodes[static_cast<std::size_t>(node)];
    return Vector<dim - 1>(circle.across(X).transpose() * direction.row(node).transpose());
  };
  for (const int node : nodes) {
    const Vector<dim> along = direction.row(node).transpose();
    if (!(parts.shape.free(node) - along * along.transpose()).isZero(rounding) ||
        !(across(node) - across(nodes.front())).isZero(rounding))
      throw held_otherwise("circle of a track");
  }
}

/// `length`: of each surface's; 0: it has no track.
template <int dim>
std::vector<UniformLine<dim>> uniform_lines(const AssemblyParts<dim>& parts,
                                            std::vector<double>& length) {
  if (parts.cross_section) return lines_of<dim>(*parts.cross_section);
  std::vector<UniformLine<dim>> result;
  for (const Surface<dim>& surface : parts.interface.surfaces) {
    length.push_back(0);
    if (!surface.track) continue;
    const auto& [along, path] = *surface.track;
    SurfaceLines lines = lines_of_surface(parts.mesh, surface.facets, along);
    length.back() = lines.length;
    for (std::vector<int>& nodes : lines.nodes) {
      result.push_back({std::move(nodes), lines.length / path});
      if (along.centre)
        result.back().circle = along;
      else
        require_alike(result.back().nodes, parts.shape);
    }
  }
  return result;
}

}  // namespace

/// What all nodes of a line together wear off moves all of them. A node that alone had the
/// rate Wdot A moved by it / A; in the sum over the line it counts by its part of the line's area
/// and of the path: seen along the mean normal of a line that may be curved, on a circle along the
/// direction in which each node moves.
template <int dim>
SharedShape<dim> shared_shape(const AssemblyParts<dim>& parts,
                              const std::vector<ContactPatch<dim>>& patches) {
  SharedShape<dim> result;
  const std::vector<UniformLine<dim>> lines = uniform_lines(parts, result.length);
  if (lines.empty()) return {};
  result.carrier.resize(parts.mesh.nodes.size());
  std::iota(result.carrier.begin(), result.carrier.end(), 0);
  const auto nodes = static_cast<Eigen::Index>(parts.mesh.nodes.size());
  NodalField<dim> area = NodalField<dim>::Zero(nodes, dim), free_area = area;
  for (const ContactPatch<dim>& patch : patches) {
    area.row(patch.node) = patch.initial_area * patch.initial_normal.transpose();
    free_area.row(patch.node) = initial_volume_gradient(parts.mesh, patch).transpose();
  }
  std::vector<double> weight(parts.mesh.nodes.size(), 1);
  NodalField<dim> direction = NodalField<dim>::Zero(nodes, dim);
  bool turns = false;
  for (const auto& [line, part, circle] : lines) {
    double whole = 0;
    Vector<dim> sum = Vector<dim>::Zero();
    for (const int node : line) {
      result.carrier[node] = line.front();
      sum += area.row(node).transpose();
      whole += free_area.row(node).norm();
      if (circle) direction.row(node) = free_area.row(node).normalized();
      turns = turns || !(direction.row(node) - direction.row(line.front())).isZero(0);
    }
    if (circle)
      require_one_direction<dim>(line, *circle, parts, direction);
    else
      whole = sum.norm();
    for (const int node : line)
      if (whole > 0) weight[node] = part * (circle ? free_area : area).row(node).norm() / whole;
  }
  if (turns) result.direction = std::move(direction);
  for (const ContactPatch<dim>& patch : patches) result.weight.push_back(weight[patch.node]);
  return result;
}

namespace {

/// Between a facet and where it was.
template <int dim>
double volume_behind(const Mesh<dim>& mesh, const typename Mesh<dim>::Facet& facet,
                     const NodalField<dim>& d) {
  constexpr int corners = Mesh<dim>::facet_nodes;
  CellNodal<dim> X;
  for (int a = 0; a < corners; ++a) {
    const int node = facet[dim == 2 ? a : corners - 1 - a];  // out of the body it goes round
    const Vector<dim> initial = mesh.nodes[static_cast<std::size_t>(node)];
    X.row(a) = initial.transpose();
    X.row(dim == 2 ? 3 - a : corners + a) = initial.transpose() + d.row(node);
  }
  return cell_volume<dim>(X, Section::plane);
}

}  // namespace

template <int dim>
std::vector<double> worn_beyond_mesh(const Assembly<dim>& assembly, const NodalField<dim>& d) {
  std::vector<double> result(assembly.bodies.size(), 0);
  if (assembly.track_length.empty()) return result;
  const std::vector<int> owner = body_of_nodes(assembly.mesh, assembly.body_of);
  for (std::size_t s = 0; s < assembly.interface.surfaces.size(); ++s) {
    const Surface<dim>& surface = assembly.interface.surfaces[s];
    if (!surface.track) continue;
    const double beyond = surface.track->path / assembly.track_length[s] - 1;
    for (const auto& facet : surface.facets)
      result[owner[facet.front()]] += beyond * volume_behind<dim>(assembly.mesh, facet, d);
  }
  return result;
}

template <int dim>
std::string find_touched_end(const Assembly<dim>& assembly,
                             const std::vector<PhaseContact<dim>>& contacts) {
  constexpr double rounding = 1e-6;
  // A node of a large facet bears a little where contact begins at the other end of it.
  constexpr double covered = 0.5, pressed = 1e-3;
  const auto touches = [&](int node) {
    const auto c = static_cast<std::size_t>(assembly.contact_node(node));
    return std::ranges::any_of(contacts, [&](const PhaseContact<dim>& at) {
      const double most = -std::ranges::min(at.nodes, {}, &ContactNode<dim>::traction).traction;
      return at.nodes[c].active && -at.nodes[c].traction >= pressed * most &&
             at.nodes[c].area >= covered * assembly.contact_nodes[c].initial_area;
    });
  };
  for (const Surface<dim>& surface : assembly.interface.surfaces) {
    if (!surface.track) continue;
    const auto& [along, path] = *surface.track;
    const SurfaceLines lines = lines_of_surface(assembly.mesh, surface.facets, along);
    if (!lines.closed && path > (1 + rounding) * lines.length &&
        std::ranges::any_of(lines.nodes, [&](const std::vector<int>& line) {
          return touches(line.front()) || touches(line.back());
        }))
      return surface.name;
  }
  return "";
}

template std::string find_touched_end(const Assembly<2>&, const std::vector<PhaseContact<2>>&);
template std::string find_touched_end(const Assembly<3>&, const std::vector<PhaseContact<3>>&);
template SharedShape<2> shared_shape(const AssemblyParts<2>&, const std::vector<ContactPatch<2>>&);
template SharedShape<3> shared_shape(const AssemblyParts<3>&, const std::vector<ContactPatch<3>>&);
template std::vector<double> worn_beyond_mesh(const Assembly<2>&, const NodalField<2>&);
template std::vector<double> worn_beyond_mesh(const Assembly<3>&, const NodalField<3>&);

}  // namespace gnomon
