#include <algorithm>
#include <cmath>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/part/part_scene.hpp>

#include "part/bodies.hpp"
#include "part/body_meshes.hpp"
#include "part/changing_friction.hpp"
#include "part/first_loading.hpp"
#include "part/graded_mesh.hpp"
#include "part/histories.hpp"
#include "part/loads.hpp"
#include "part/pair_keys.hpp"
#include "part/rolling_scene.hpp"
#include "part/shape_support.hpp"
#include "part/supports.hpp"

namespace gnomon {

namespace {

using namespace part;

constexpr int most_splits = 6;

std::string idle_beside_bodies(const Scene& scene) {
  return has_bodies(scene) ? "each [[body]] has its own" : "";
}

/// Of a geometry; a mesh is what it is. Where a plan has chosen a size for the contact, which
/// mesh.factor multiplies, and edges there are smaller than that, edges away from it are by the
/// square root: their part of the error falls with their square. Larger ones are all by the factor,
/// because sizes of the geometry itself, which may be as small at the contact, know no other.
std::optional<Scene> with_scaled_edges(const Scene& scene, double factor) {
  if (!has_geometry(scene)) return {};
  const auto scaled = [](const Scene& given, const char* key, double by) {
    return given.with(key, by * given.real(key));
  };
  if (!scene.given("mesh.contact_size") || scene.is_set("mesh.contact_size"))
    return scaled(scene, "mesh.factor", factor);
  const double before = scene.real("mesh.factor"),
               chosen = scene.real("mesh.contact_size") / std::min(1.0, before);
  const double edges = factor * (before > 1 ? before : before * before);  // by the chosen size
  const double all = edges > 1 ? edges : std::sqrt(edges);
  return scene.with("mesh.factor", all).with("mesh.contact_size", chosen * std::min(1.0, all));
}

std::optional<Scene> with_scaled_split(const Scene& scene, double factor) {
  const long splits = scene.integer("mesh.split") - std::lround(std::log2(factor));
  const bool has_mesh = scene.has("mesh.file") || !scene.chosen_names("body.#.mesh").empty();
  if (!has_mesh || splits < 0 || splits > most_splits) return {};
  return scene.with("mesh.split", splits);
}

std::vector<Key> mesh_keys() {
  std::vector<Key> keys = {
      {.name = "mesh.file",
       .kind = KeyKind::text,
       .absent_meaning = "needed by every command that reads the scene from a file",
       .names_file = true,
       .help = "mesh of Gmsh (.msh), or geometry (.geo, .step) that Gmsh meshes, beside the "
               "scene or by its path"},
      real_key("mesh.size", "mm", absent("as the geometry asks for"), positive_quantity,
               "longest edge of an element where the geometry asks for no smaller one"),
      real_key("mesh.contact_size", "mm", absent("as elsewhere"), positive_quantity,
               "of a geometry: edge of the elements where the bodies are expected to touch over "
               "the run; from there they grow"),
      controlling(real_key("mesh.factor", "", by_default(1.0), {.min = 1e-3, .max = 1e3},
                           "multiplies every edge of the geometry: 0.5 for a mesh twice as fine"),
                  ErrorSource::mesh, with_scaled_edges),
      controlling(integer_key("mesh.split", by_default(0L), {.min = 0, .max = most_splits},
                              "times that each cell is split into four (eight in space), with new "
                              "nodes of the boundary on smooth curves through the old ones"),
                  ErrorSource::mesh, with_scaled_split)};
  keys.back().controls->judges_only = true;
  std::ranges::find(keys, "mesh.factor", &Key::name)->controls->chosen = with_contact_size;
  return keys;
}

std::vector<Key> own_keys() {
  return {
      {.name = "friction.stick",
       .kind = KeyKind::flag,
       .absent_meaning = "false, but contact that rolls may stick",
       .help = "contact may stick in a part of the cycle, as in fretting: its phases are then a "
               "path (docs/fretting.md)"},
      friction_factor_key(),
      text_key("model.plane", by_default("strain"),
               "what a mesh in the plane is a section of: plane strain, or a body of revolution "
               "about x = 0, in coordinates (r, z)",
               {"strain", "axisymmetric"}),
      density_key("body.density", idle_beside_bodies),
      texts_key("wear.on", required(),
                "groups of the mesh that touch the counter-body, or another body, and wear"),
      real_key("wear.surfaces.\"*\".coefficient", "1/MPa", absent("wear.coefficient"),
               {.min = 0, .max = positive_quantity.max},
               "wear coefficient of one of wear.on by its name, as wear.coefficient"),
      real_key("wear.surfaces.\"*\".path", "mm", absent("it wears where it is in contact"),
               any_quantity,
               "length of the track of one of wear.on whose material passes the contact of a "
               "[[pair]] once in each turn, as that of a disc under a pin: it wears by the mean "
               "along it"),
      {.name = "wear.surfaces.\"*\".rate",
       .kind = KeyKind::text,
       .unit = "mm/s",
       .absent_meaning = "wear.rate",
       .help = "wear rate of one of wear.on by its name, as wear.rate"}};
}

/// All [[body]] with small strains, where none gives a material, or those that have them with
/// finite ones.
std::optional<Scene> with_other_kinematics(const Scene& scene, double factor) {
  const std::vector<Key> keys = body_table_keys();
  Key material = *std::ranges::find(keys, "body.#.material", &Key::name);
  Scene result = scene.knows("solver.reduce") ? scene.without("solver.reduce") : scene;
  bool changed = false;
  for (const std::string& body : scene.chosen_names("body.#.young_modulus")) {
    material.name = "body." + body + ".material";
    const bool given = scene.given(material.name),
               small = given && scene.text(material.name) == "linear";
    if (factor > 1 && given) return {};
    if (factor == 1 || (factor < 1 && !small)) continue;
    result = factor > 1 ? result.with(material, "linear") : result.without(material.name);
    changed = true;
  }
  if (!changed) return {};
  return result;
}

/// What a part does not have: its loads are an array, its counter-body moves.
bool replaced(const std::string& key) {
  return key == "load.force" || key == "load.times" || key == "load.factors";
}

/// Those of the built-in problems, with what a part tells otherwise.
std::vector<Key> shared_keys() {
  std::vector<Key> keys;
  for (Key key : worn_body_keys(2)) {
    if (replaced(key.name)) continue;
    if (key.name == "wear.velocity") {
      key.absent_meaning =
          "that of counter_body.motion, or of [[motion]], at the contact; in rolling the creepage, "
          "and spin times half of the expected width of the contact, times the velocity";
      key.help = "sliding speed that s = v t is counted with";
      key.idle = [](const Scene& scene) {
        return reads_in_rates(scene, "s") || reads_in_friction(scene, "s") ? ""
               : has_pairs(scene)
                   ? "[[motion]] gives the speed, and nothing reads s"
                   : "the motion of the counter-body gives the speed, and nothing reads s";
      };
    }
    if (key.name == "wear.coefficient") key.range.min = 0;  // a contact analysis
    if (key.name.starts_with("body.")) key.idle = idle_beside_bodies;
    if (key.name == "body.material") {
      key.controls->scaled = [of_one = key.controls->scaled](const Scene& scene, double factor) {
        return has_bodies(scene) ? with_other_kinematics(scene, factor) : of_one(scene, factor);
      };
    }
    keys.push_back(std::move(key));
  }
  return keys;
}

}  // namespace

std::vector<Key> part_keys() {
  std::vector<Key> keys = mesh_keys();
  for (const auto& more :
       {own_keys(), support_keys(), load_keys(), pair_keys(), cycle_keys(), first_loading_keys(),
        rolling_keys(), shared_keys(), body_table_keys(), body_mesh_keys(), shape_support_keys()})
    keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

}  // namespace gnomon
