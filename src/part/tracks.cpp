#include "part/tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/scene/toml_key.hpp>
#include <set>

#include "mesh/facet_table.hpp"
#include "part/body_motions.hpp"
#include "part/facing_facets.hpp"
#include "part/surfaces.hpp"

namespace gnomon::part {

namespace {

std::string path_key(const std::string& surface) {
  return "wear.surfaces." + toml_key(surface) + ".path";
}

InputError unfit_track(const Scene& scene, const std::string& surface,
                       const std::string& expected) {
  return InputError(scene.where(path_key(surface)) + ": " + expected);
}

/// The body whose surface it is.
template <int dim>
const Body& body_of_track(const Scene& scene, const Surface<dim>& surface,
                          const AssemblyParts<dim>& parts) {
  const BodyOfFacets<dim> body_of(parts.mesh, parts.bodies);
  const int body = body_of(surface.facets.front());
  for (const auto& facet : surface.facets)
    if (body_of(facet) != body)
      throw unfit_track(scene, surface.name, "expected a surface of one body");
  return parts.bodies[static_cast<std::size_t>(body)];
}

/// Straight lines or circles; none of what moves otherwise, or across the plane.
template <int dim>
std::optional<Streamlines<dim>> streamlines_of(const RigidMotion<dim>& motion) {
  constexpr double rounding = 1e-12;
  if (motion.across != 0 || !motion.across_by_x.isZero(0)) return {};
  if (motion.spin.isZero(0)) {
    if (motion.velocity.norm() == 0) return {};
    return Streamlines<dim>{motion.velocity.normalized()};
  }
  if constexpr (dim == 2) {
    const double spin = motion.spin(1, 0);
    return Streamlines<2>{Vector<2>::Zero(),
                          Vector<2>(motion.spin * motion.velocity / (spin * spin)), spin < 0};
  } else {
    const Vector<3> spin(motion.spin(2, 1), motion.spin(0, 2), motion.spin(1, 0)),
        v = motion.velocity;
    if (std::abs(v.dot(spin)) <= rounding * v.norm() * spin.norm())
      return Streamlines<3>{spin.normalized(), Vector<3>(spin.cross(v) / spin.squaredNorm())};
    return {};
  }
}

/// Straight lines along the surface, not into it.
template <int dim>
void require_motion_along(const Scene& scene, const Surface<dim>& surface, const Mesh<dim>& mesh,
                          const Streamlines<dim>& lines) {
  constexpr double steep = 0.7;  // cosine
  if (lines.centre) return;
  double across = 0, area = 0;
  for (const auto& patch : contact_patches<dim>(mesh, surface.facets)) {
    across += patch.initial_area * std::abs(patch.initial_normal.dot(lines.along));
    area += patch.initial_area;
  }
  if (across > steep * area)
    throw unfit_track(scene, surface.name,
                      "expected a [[motion]] along the surface, but the velocity of its body goes "
                      "across it");
}

/// Where both of two bodies that roll wear, their lines have one direction.
template <int dim>
void require_common_lines(const Scene& scene, const Surface<dim>& surface,
                          const AssemblyParts<dim>& parts) {
  constexpr double rounding = 1e-9;
  const auto& [V, other] = parts.pairs.front().velocities;
  const bool alone = std::ranges::count_if(parts.interface.surfaces, [&](const Surface<dim>& of) {
                       return is_track(scene, of.name);
                     }) < 2;
  const Vector<dim> across = other - other.dot(V) / V.squaredNorm() * V;
  if (!alone && across.norm() > rounding * other.norm())
    throw unfit_track(scene, surface.name,
                      "expected a creepage across the velocity to be found by "
                      "motion.#.force_across, or only one of both surfaces to wear: lines of both "
                      "go along one velocity");
}

/// A node wears by one law, and by the mean along a track or not.
template <int dim>
void require_own_nodes(const Scene& scene, const Surface<dim>& surface,
                       const AssemblyParts<dim>& parts) {
  const std::set<int> own = nodes_of_facets(surface.facets);
  for (const Surface<dim>& other : parts.interface.surfaces) {
    if (&other == &surface || !other.wears) continue;
    for (const int node : nodes_of_facets(other.facets))
      if (own.contains(node))
        throw unfit_track(
            scene, surface.name,
            fmt::format("expected a surface that shares no node with another one that wears, but "
                        "\"{}\" does",
                        other.name));
  }
}

}  // namespace

bool is_track(const Scene& scene, const std::string& surface) {
  return scene.given(path_key(surface));
}

void refuse_track(const Scene& scene, const std::string& surface) {
  if (is_track(scene, surface))
    throw unfit_track(scene, surface,
                      "expected none beside a rigid counter-body: a track is worn by a body of a "
                      "[[pair]], or in [rolling]; a groove under a rigid ball is problem = "
                      "\"ball_on_half_space\"");
}

template <int dim>
std::optional<Track<dim>> read_track(const Scene& scene, const Surface<dim>& surface,
                                     const AssemblyParts<dim>& parts) {
  const std::string key = path_key(surface.name);
  const bool is_given = is_track(scene, surface.name);
  const auto& rolling = parts.interface.rolling;
  const bool on_rigid = rolling && parts.pairs.empty();
  if (!is_given && rolling)
    throw InputError((on_rigid ? scene.where("rolling.velocity") : scene.path().string()) +
                     ": expected also " + key +
                     ", the length that passes the contact in a turn: what rolls wears alike all "
                     "along it");
  if (!is_given) return {};
  if (!(scene.real(key) > 0))
    throw unfit_track(scene, surface.name,
                      fmt::format("expected the length of the whole track, of which the mesh is a "
                                  "part, got {:g} mm; without it the surface wears where it is in "
                                  "contact",
                                  scene.real(key)));
  if (parts.section() == Section::meridian)
    throw unfit_track(scene, surface.name,
                      "expected none of a body of revolution: it wears alike all around");
  if (!parts.phases.empty())
    throw unfit_track(scene, surface.name, "expected none beside a cycle: a steady motion");
  if (parts.shape.constraint == ConstraintForm::multiplier)
    throw unfit_track(scene, surface.name, "expected shape.constraint = \"eliminated\"");
  if (on_rigid) return Track<dim>{{rolling->velocity.normalized()}, scene.real(key)};
  if (rolling) require_common_lines(scene, surface, parts);
  const std::string& body = body_of_track(scene, surface, parts).name;
  const auto motions = read_motions_of_bodies(scene, parts);
  const auto motion = motions.find(body);
  if (motion == motions.end())
    throw unfit_track(scene, surface.name,
                      fmt::format("expected a [[motion]] with body = \"{}\", which has none: along "
                                  "a track its material passes the contact",
                                  body));
  std::optional<Streamlines<dim>> along = streamlines_of(motion->second.motion);
  if (rolling)
    if (const auto rolls = read_rolling_body(scene, parts, body); !rolls.on_axle)
      along = Streamlines<dim>{rolls.velocity.normalized()};
  if (along) require_motion_along(scene, surface, parts.mesh, *along);
  if (!along)
    throw unfit_track(
        scene, surface.name,
        fmt::format("expected a [[motion]] of \"{}\" with {}: its material passes the "
                    "contact",
                    body,
                    dim == 2 ? "a velocity in the plane, none across it, or a rotation"
                             : "a velocity, or a rotation"));
  return Track<dim>{*along, scene.real(key)};
}

template <int dim>
void require_lines(const Scene& scene, const AssemblyParts<dim>& parts) {
  for (const Surface<dim>& surface : parts.interface.surfaces) {
    if (!surface.track) continue;
    const auto refuse = [&](const std::string& expected) {
      return unfit_track(scene, surface.name, expected);
    };
    require_own_nodes(scene, surface, parts);
    SurfaceLines lines;
    try {
      lines = lines_of_surface(parts.mesh, surface.facets, surface.track->along);
    } catch (const InputError& error) {
      const bool rolls = parts.interface.rolling.has_value();
      throw refuse(std::string(error.what()) + (rolls ? ": rolling goes along the lines" : ""));
    }
    constexpr double nearly = 0.01, rounding = 1e-6;
    if (lines.circumference > 0) {  // the geometry says how long a circle is
      if (std::abs(surface.track->path / lines.circumference - 1) > nearly)
        throw refuse(
            fmt::format("expected the circumference at the mean of its radii, {:.6g} mm, got {:g} "
                        "mm",
                        lines.circumference, surface.track->path));
    } else if (surface.track->path < (1 - rounding) * lines.length)
      throw refuse(
          fmt::format("expected at least the length of its mesh along the track, {:.6g} "
                      "mm, got {:g} mm",
                      lines.length, surface.track->path));
  }
}

template <int dim>
void require_receding_tracks(const Scene& scene, const AssemblyParts<dim>& parts) {
  constexpr double freely = 0.1;  // part of the normal
  for (const Surface<dim>& surface : parts.interface.surfaces) {
    if (!surface.track) continue;
    for (const auto& patch : contact_patches<dim>(parts.mesh, surface.facets))
      if ((parts.shape.free(patch.node) * patch.initial_normal).norm() < freely)
        throw unfit_track(
            scene, surface.name,
            surface.track->along.centre
                ? "expected a surface that recedes as a whole, but a circle of it is held: it has "
                  "to be the whole circle or to end at planes through the axis, and sides beside "
                  "it have to be planes across the axis or round about it"
                : "expected a surface that recedes as a whole, but a line of it is held: sides at "
                  "both ends of the track have to be planes across it, and those beside it planes "
                  "along it");
  }
}

template <int dim>
std::vector<std::string> remarks_on_tracks(const Magnitudes& expected,
                                           const AssemblyParts<dim>& parts) {
  constexpr double most = 0.9;
  std::vector<std::string> remarks;
  const double contact = contact_width<dim>(expected.scales);
  for (const Surface<dim>& surface : parts.interface.surfaces) {
    if (!surface.track) continue;
    const auto& [along, path] = *surface.track;
    const double length = lines_of_surface(parts.mesh, surface.facets, along).length;
    const bool ends = dim == 2 && contact > most * length && most * path > length;
    remarks.push_back(
        fmt::format("\"{}\" wears by the mean along its track of {:g} mm: its mesh is {:.3g} mm of "
                    "it, and contact covers about {:.2g} %{}",
                    surface.name, path, length, 100 * std::min(1.0, contact / path),
                    ends ? ", perhaps up to the ends of that mesh or beyond: shapes and pressures "
                           "are wrong then, and a longer mesh is needed"
                         : ""));
  }
  return remarks;
}

template <int dim>
std::vector<std::string> remarks_on_passing_material(const Scene& scene,
                                                     const AssemblyParts<dim>& parts) {
  if (parts.pairs.empty() || !parts.phases.empty() || parts.section() == Section::meridian)
    return {};
  std::vector<std::string> remarks;
  const auto motions = read_motions_of_bodies(scene, parts);
  const BodyOfFacets<dim> body_of(parts.mesh, parts.bodies);
  for (const Surface<dim>& surface : parts.interface.surfaces) {
    if (surface.track || !surface.wears ||
        wear_by_pressure(surface.wear, circumstances_of(parts, surface)) == 0)
      continue;
    const int body = body_of(surface.facets.front());
    const auto motion = motions.find(parts.bodies[static_cast<std::size_t>(body)].name);
    if (motion == motions.end()) continue;
    const RigidMotion<dim>& moves = motion->second.motion;
    if (moves.velocity.norm() == 0 && moves.spin.isZero(0)) continue;
    remarks.push_back(fmt::format(
        "material of \"{0}\" passes the contact, but wears as if the same stayed in it{1}",
        surface.name,
        streamlines_of(moves)
            ? fmt::format(": {} gives the length of its track", path_key(surface.name))
            : ": where it touches for a part of a turn only, its depth is too large by a turn over "
              "that part"));
  }
  return remarks;
}

template std::optional<Track<2>> read_track(const Scene&, const Surface<2>&,
                                            const AssemblyParts<2>&);
template std::optional<Track<3>> read_track(const Scene&, const Surface<3>&,
                                            const AssemblyParts<3>&);
template void require_lines(const Scene&, const AssemblyParts<2>&);
template void require_lines(const Scene&, const AssemblyParts<3>&);
template void require_receding_tracks(const Scene&, const AssemblyParts<2>&);
template void require_receding_tracks(const Scene&, const AssemblyParts<3>&);
template std::vector<std::string> remarks_on_tracks(const Magnitudes&, const AssemblyParts<2>&);
template std::vector<std::string> remarks_on_tracks(const Magnitudes&, const AssemblyParts<3>&);
template std::vector<std::string> remarks_on_passing_material(const Scene&,
                                                              const AssemblyParts<2>&);
template std::vector<std::string> remarks_on_passing_material(const Scene&,
                                                              const AssemblyParts<3>&);

}  // namespace gnomon::part
