#include "part/pair_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/part/part_scene.hpp>
#include <map>
#include <set>

#include "mesh/import_nodes.hpp"
#include "part/body_motions.hpp"
#include "part/histories.hpp"

namespace gnomon::part {

namespace {

std::vector<Key> keys_of_pairs() {
  return {texts_key("pair.#.bodies", absent("needed in every [[pair]]"),
                    "two bodies, by their names, that touch each other; one name twice: surfaces "
                    "of one body"),
          texts_key("pair.#.surfaces", absent("all boundary that faces the other body"),
                    "groups of the mesh to which their contact is restricted; of one body, or of "
                    "bonded ones: the two that touch"),
          real_key("pair.#.friction", "", absent("friction.coefficient"), {.min = 0, .max = 1e30},
                   "Coulomb's coefficient of friction of the pair"),
          {.name = "pair.#.stick",
           .kind = KeyKind::flag,
           .absent_meaning = "friction.stick",
           .help = "the pair may stick in a part of the cycle, as in fretting: the same of all "
                   "pairs (docs/fretting.md)"}};
}

}  // namespace

std::vector<Key> pair_keys() {
  std::vector<Key> keys = keys_of_pairs();
  for (Key& key : motion_keys_of_bodies()) keys.push_back(std::move(key));
  return keys;
}

std::vector<std::string> pair_tables(const Scene& scene) {
  return entries_of(scene, "pair", keys_of_pairs(), {"bodies"});
}

bool has_pairs(const Scene& scene) {
  return std::ranges::any_of(pair_keys(),
                             [&](const Key& key) { return !scene.chosen_names(key.name).empty(); });
}

namespace {

std::vector<std::string> names_of_bodies(const Scene& scene) {
  std::vector<std::string> names;
  for (const std::string& body : scene.chosen_names("body.#.name"))
    names.push_back(scene.text("body." + body + ".name"));
  return names;
}

void require_two_bodies(const Scene& scene, const std::string& pair) {
  const std::string key = pair + ".bodies";
  const std::vector<std::string>& names = scene.texts(key);
  if (names.size() != 2) refuse(scene, key, "the names of two bodies");
  const std::vector<std::string> all = names_of_bodies(scene);
  for (const std::string& name : names)
    if (std::ranges::find(all, name) == all.end())
      throw InputError(fmt::format("{}: expected names of [[body]], \"{}\", got \"{}\"",
                                   scene.where(key), fmt::join(all, "\", \""), name));
  if (names[0] == names[1] && !scene.given(pair + ".surfaces"))
    refuse(scene, key,
           "the names of two bodies, or pair.surfaces, two groups of the one body that touch each "
           "other");
}

/// Of two pairs of the same bodies, whose surfaces have one name in common at most.
bool may_meet_twice(const std::set<std::string>& own, const std::set<std::string>& other) {
  return own.empty() || other.empty() || std::ranges::count_if(own, [&](const std::string& name) {
                                           return other.contains(name);
                                         }) > 1;
}

/// Empty: any.
std::set<std::string> surfaces_of(const Scene& scene, const std::string& pair) {
  const std::string key = pair + ".surfaces";
  if (!scene.given(key)) return {};
  const std::vector<std::string>& names = scene.texts(key);
  return {names.begin(), names.end()};
}

}  // namespace

bool may_stick(const Scene& scene) {
  const bool all = scene.given("friction.stick") && scene.flag("friction.stick");
  if (!has_pairs(scene)) return all;
  const std::vector<std::string> pairs = pair_tables(scene);
  const auto of = [&](const std::string& pair) {
    const std::string key = pair + ".stick";
    return scene.given(key) ? scene.flag(key) : all;
  };
  for (const std::string& pair : pairs)
    if (of(pair) != of(pairs.front())) refuse(scene, pair + ".stick", "the same in every [[pair]]");
  return of(pairs.front());
}

void find_mistakes_of_pairs(const Scene& scene, Mistakes& mistakes) {
  if (!has_pairs(scene)) return;
  std::map<std::set<std::string>, std::vector<std::set<std::string>>> seen;  // surfaces by bodies
  mistakes.collect([&] {
    if (scene.chosen_names("pair.#.bodies").empty())
      throw InputError(scene.path().string() +
                       ": expected a [[pair]] with the bodies that touch each other");
    for (const std::string& pair : pair_tables(scene))
      mistakes.collect([&] {
        if (!scene.has(pair + ".bodies")) return;  // a value of another sort is told already
        require_two_bodies(scene, pair);
        const std::vector<std::string>& names = scene.texts(pair + ".bodies");
        if (names[0] == names[1]) return;  // several folds of one body
        const std::set<std::string> own = surfaces_of(scene, pair);
        for (const std::set<std::string>& other : seen[{names[0], names[1]}])
          if (may_meet_twice(own, other))
            refuse(scene, pair + ".bodies",
                   "each pair of bodies once, or with surfaces of its own");
        seen[{names[0], names[1]}].push_back(own);
      });
  });
}

namespace {

/// Throws where a pair is of one body twice, and another body is in no pair.
void require_other_body(const Scene& scene, const std::string& what) {
  const std::vector<std::string> paired = separate_bodies(scene), all = names_of_bodies(scene);
  const auto alone = std::ranges::find_if(all, [&](const std::string& name) {
    return std::ranges::find(paired, name) == paired.end();
  });
  if (alone == all.end()) return;
  for (const std::string& pair : pair_tables(scene))
    if (const auto& names = scene.texts(pair + ".bodies"); names[0] == names[1])
      throw InputError(fmt::format("{}: expected two bodies, or \"{}\" bonded to \"{}\": {}",
                                   scene.where(pair + ".bodies"), *alone, names[0], what));
}

}  // namespace

template <int dim>
ImportedBody<dim> check_bodies(const Scene& scene, ImportedMesh mesh, int splits) try {
  return check_mesh<dim>(std::move(mesh), scene.texts("wear.on"), splits, separate_bodies(scene));
} catch (const UnconnectedCells& error) {
  require_other_body(scene, error.what());
  throw;
}

template ImportedBody<2> check_bodies(const Scene&, ImportedMesh, int);
template ImportedBody<3> check_bodies(const Scene&, ImportedMesh, int);

}  // namespace gnomon::part

namespace gnomon {

std::vector<std::string> separate_bodies(const Scene& scene) {
  std::set<std::string> names;
  for (const std::string& pair : scene.chosen_names("pair.#.bodies"))
    if (const std::string key = "pair." + pair + ".bodies"; scene.has(key))
      for (const std::string& name : scene.texts(key)) names.insert(name);
  return {names.begin(), names.end()};
}

}  // namespace gnomon
