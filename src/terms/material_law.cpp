#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/terms/material_law.hpp>

namespace gnomon {

namespace {

/// "body." of "body.material".
std::string table_of(const std::string& choice) {
  return choice.substr(0, choice.rfind('.') + 1);
}

constexpr const char* usual_material = "neo-hookean";  // of a [[body]] that names none
constexpr const char* linear_material = "linear";      // of small strains, which have no law
constexpr double usual_modulus = 1;  // of the auxiliary elasticity: its solutions have no modulus

}  // namespace

std::vector<int> body_of_cells(const std::vector<Body>& bodies, std::size_t cells) {
  if (bodies.size() == 1 && bodies.front().cells.empty()) return std::vector<int>(cells, 0);
  std::vector<int> body_of(cells, -1);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const int cell : bodies[b].cells) {
      int& body = body_of.at(static_cast<std::size_t>(cell));
      if (body >= 0)
        throw InputError(
            fmt::format("expected bodies that share no element, but \"{}\" and \"{}\" do",
                        bodies[static_cast<std::size_t>(body)].name, bodies[b].name));
      body = static_cast<int>(b);
    }
  if (const auto without = std::ranges::count(body_of, -1))
    throw InputError(
        fmt::format("expected a body for every element, {} of {} have none", without, cells));
  return body_of;
}

Material make_material(const std::string& law, const ElasticModuli& moduli) {
  const MaterialLaw& found = MaterialLaws::find(law, "material");
  return {moduli, found.kernels, found.collapse_force, moduli.young_modulus(),
          moduli.lambda / (2 * (moduli.lambda + moduli.mu))};
}

Material read_material(const Scene& scene, const std::string& choice) {
  const std::string table = table_of(choice), modulus = table + "young_modulus",
                    name = scene.given(choice) ? scene.text(choice) : usual_material,
                    law_name = name == linear_material ? usual_material : name;
  const double young = scene.knows(modulus) ? scene.real(modulus) : usual_modulus,
               poisson = scene.real(table + "poisson_ratio");
  Material material = make_material(law_name, ElasticModuli::from_young_poisson(young, poisson));
  material.young_modulus = young;
  material.poisson_ratio = poisson;
  const MaterialLaw& found = MaterialLaws::find(law_name, "material");
  for (const MaterialLaw& law : MaterialLaws::all())
    for (const Key& key : law.keys)
      if (scene.given(table + key.name) && !std::ranges::count(found.keys, key.name, &Key::name))
        throw InputError(fmt::format("{}: only for {} = \"{}\", got \"{}\"",
                                     scene.where(table + key.name), choice, law.name, name));
  if (found.ratios) material.moduli.ratios = found.ratios(scene, table, material.moduli);
  return material;
}

void add_material_keys(std::vector<Key>& table, const std::string& choice) {
  const auto place =
      std::find_if(table.begin(), table.end(), [&](const Key& key) { return key.name == choice; });
  if (place == table.end()) return;
  for (const std::string& name : MaterialLaws::names())
    if (std::ranges::count(place->choices, name) == 0) place->choices.push_back(name);
  std::vector<Key> further;
  for (const MaterialLaw& law : MaterialLaws::all())
    for (Key key : law.keys) {
      key.name = table_of(choice) + key.name;
      key.idle = place->idle;
      require_optional(key, law.name);
      if (!same_key(further, key, law.name)) further.push_back(std::move(key));
    }
  table.insert(place + 1, further.begin(), further.end());
}

}  // namespace gnomon
