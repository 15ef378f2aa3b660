// How unlike the bodies in contact are.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <gnomon/terms/material.hpp>
#include <gnomon/terms/mortar_pair.hpp>
#include <vector>

namespace gnomon {

/// Dundurs' second constant: how normal tractions move the bodies along their contact, 0 of similar
/// bodies (K. L. Johnson, Contact Mechanics, eq. 5.3); of several contacts that farthest from 0.
/// Without `pairs` every body is beside a rigid one.
template <int dim>
double dundurs_of(const std::vector<Body>& bodies, const std::vector<MortarPair<dim>>& pairs);

/// Whether bodies of unlike elasticity are bonded: such a body is no half-space of one material,
/// and bends in the contact.
template <int dim>
bool are_layered(const Mesh<dim>& mesh, const std::vector<Body>& bodies);

}  // namespace gnomon
