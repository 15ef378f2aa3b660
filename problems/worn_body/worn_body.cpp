// worn_body: a part of one's own, from a mesh with named surfaces, against a rigid counter-body of
// any shape.

#include <gnomon/model/problem.hpp>
#include <gnomon/part/part_scene.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>

namespace gnomon {

namespace {

const Registration<Problem> registration({
    .name = "worn_body",
    .help = "parts from meshes with named surfaces (Gmsh), against a counter-body or each other",
    .keys = part_keys(),
    .make = make_part,
    .remake = remake_part,
    .registered_keys = [] { return counter_body_keys(); },
    .further_mistakes = find_mistakes_of_groups,
});

}  // namespace

}  // namespace gnomon
