// The bodies of a scene: [body], or a [[body]] for each named group of elements.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/terms/material.hpp>
#include <string>
#include <vector>

#include "part/groups.hpp"

namespace gnomon::part {

/// Keys of `[[body]]`, those of [body] with the name of a group.
std::vector<Key> body_table_keys();

/// Whether the scene has several bodies, by [[body]].
bool has_bodies(const Scene& scene);

/// Throws InputError where groups of [[body]] are not all elements, each once.
template <int dim>
std::vector<Body> read_bodies(const Scene& scene, const ImportedBody<dim>& part, Section section);

bool has_small_strains(const std::vector<Body>& bodies);

/// Where groups of elements are one material, though they may be meant as several.
template <int dim>
std::vector<std::string> remarks_on_bodies(const Scene& scene, const ImportedBody<dim>& part);

/// Facets at which bodies are bonded, each with the outer normal of the body named first.
template <int dim>
Facets<dim> bonded_facets(const Mesh<dim>& mesh, const std::vector<Body>& bodies);

}  // namespace gnomon::part
