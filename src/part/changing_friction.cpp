#include "part/changing_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/scene/keys.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <set>

#include "expressions/expression_tables.hpp"
#include "expressions/expression_text.hpp"
#include "mesh/facet_table.hpp"
#include "part/histories.hpp"
#include "part/surfaces.hpp"

namespace gnomon::part {

namespace {

constexpr const char* key = "friction.factor";

WearLaw factor_by_text(const Scene& scene, double nominal_speed) {
  ExpressionNames names;
  names.variables = wear_law_variables();
  add_tables(scene, names);
  try {
    const Expression factor(scene.text(key), names);
    const auto used = tokens_in(factor.text());
    for (const char* name : {"p", "v", "q", "q_mean"})
      if (used.contains(name))
        refuse(scene, key, fmt::format("a function of h, t, s, x0, y0, z0, got {}", name));
    return expression_wear_law(factor, scene.real("time.end"), nominal_speed);
  } catch (const ExpressionError& error) {
    throw InputError(scene.where(key) + ": " + error.what());
  }
}

/// Where nothing is worn, at some times.
template <int dim>
void require_values(const Scene& scene, const FrictionFactor& factor,
                    const AssemblyParts<dim>& parts) {
  const double end = scene.real("time.end");
  try {
    for (const ContactPatch<dim>& patch : contact_nodes_of(parts))
      for (const double part : {0.0, 0.01, 0.1, 0.5, 1.0})
        factor.at(
            0,
            {.time = part * end, .slid = *parts.interface.speed * part * end, .within = part * end},
            initial_position_of<dim>(patch));
  } catch (const RecoverableError& error) {
    throw InputError(scene.where(key) + ": " + error.what());
  }
}

}  // namespace

Key friction_factor_key() {
  return text_key(key, absent("1"),
                  "factor of the coefficient of friction where it may stick: an expression of the "
                  "depth h, time t, sliding distance s and initial position x0 y0 z0 (of pairs, "
                  "those of the slave) and of tables");
}

bool reads_in_friction(const Scene& scene, const std::string& name) {
  return scene.knows(key) && scene.given(key) && tokens_in(scene.text(key)).contains(name);
}

template <int dim>
FrictionFactor read_friction_factor(const Scene& scene, const AssemblyParts<dim>& parts) {
  if (!scene.given(key)) return {};
  if (!parts.interface.sticks && !parts.interface.rolling)
    refuse(scene, key, "friction.stick = true, or [rolling], beside it");
  if (reads_in_rates(scene, "f"))
    refuse(scene, "wear.rate", "no f beside friction.factor: q is f p v with its factor");
  if (!parts.pairs.empty() && (reads_in_rates(scene, "q") || reads_in_rates(scene, "q_mean")))
    refuse(scene, "wear.rate",
           "no q or q_mean beside friction.factor in a [[pair]], since both of its surfaces would "
           "need the factor of the other one");
  const auto slides_alike = [&](const MortarPair<dim>& pair) {
    return pair.slides == parts.pairs.front().slides;
  };
  if (reads_in_friction(scene, "s") && !std::ranges::all_of(parts.pairs, slides_alike))
    refuse(scene, key, "no s where pairs slide at different speeds, or also wear.velocity");
  require_positions<dim>(scene, key);
  FrictionFactor factor(factor_by_text(scene, *parts.interface.speed));
  require_values(scene, factor, parts);
  return factor;
}

template <int dim>
void tell_of_unworn_friction(const Scene& scene, AssemblyParts<dim>& parts) {
  if (!reads_in_friction(scene, "h")) return;
  std::set<int> worn;
  for (const Surface<dim>& surface : parts.interface.surfaces)
    if (surface.wears) worn.merge(nodes_of_facets(surface.facets));
  for (const MortarPair<dim>& pair : parts.pairs)
    if (std::ranges::none_of(nodes_of_facets(pair.slave),
                             [&](int node) { return worn.contains(node); }))
      parts.remarks.push_back(fmt::format(
          "friction.factor has no effect by h between \"{0}\" and \"{1}\": it reads the "
          "depth of \"{0}\", which does not wear",
          pair.bodies[0], pair.bodies[1]));
}

template void tell_of_unworn_friction(const Scene&, AssemblyParts<2>&);
template void tell_of_unworn_friction(const Scene&, AssemblyParts<3>&);
template FrictionFactor read_friction_factor(const Scene&, const AssemblyParts<2>&);
template FrictionFactor read_friction_factor(const Scene&, const AssemblyParts<3>&);

}  // namespace gnomon::part
