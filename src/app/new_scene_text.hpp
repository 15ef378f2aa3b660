// What the scenes have in common that `gnomon new` writes for one body and for several.
#pragma once

#include <filesystem>
#include <gnomon/mesh/imported_body.hpp>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace gnomon::app {

/// Whether somebody may have named a part so because it is what these words say.
bool sounds_like(const std::string& name, std::initializer_list<const char*> words);
bool sounds_held(const std::string& name);

/// Of the named parts that which sounds held, else of flat ones that which looks most away from
/// `outward`, else any; "..." of none.
template <int dim>
std::string part_away_from(const ImportedBody<dim>& body, const std::vector<std::string>& names,
                           const Vector<dim>& outward);

struct Circle {
  Vector<2> centre = Vector<2>::Zero();
  double radius = 0;
  bool hollow = false;  ///< a bore: its normals look to the centre
};

/// The circle that facets are, or at least a half of; `outward`: their mean normal, if they have
/// one.
std::optional<Circle> circle_of(const Mesh<2>& mesh, const std::vector<Mesh<2>::Facet>& facets,
                                const Vector<2>& outward);

/// A direction along a plane.
template <int dim>
Vector<dim> sliding_direction(const Vector<dim>& normal);

/// As a user would write it: without rounding errors.
template <int dim>
std::string coordinates(const Vector<dim>& vector);

template <int dim>
std::set<int> every_direction();

/// [[support]] with its directions.
std::string support_text(const std::string& on, const std::set<int>& directions,
                         const std::string& comment);

inline constexpr const char* material_text = "young_modulus = 210e3  # MPa\npoisson_ratio = 0.3\n";
inline const char* unit_of_force(int dim) {
  return dim == 2 ? "N per mm of thickness; axisymmetric: N" : "N";
}

/// Title, problem, mesh and, in 2D, what it is a section of.
template <int dim>
std::string scene_head(const std::string& title, const std::filesystem::path& mesh,
                       std::optional<double> size, const ImportedBody<dim>& body);

/// Wear of these parts, friction, time and integrator.
std::string scene_tail(const std::vector<std::string>& wearing);

}  // namespace gnomon::app
