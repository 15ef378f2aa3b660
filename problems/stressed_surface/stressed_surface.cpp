// stressed_surface: a free surface that dissolves or evaporates,
//
//   v_n = -m (w + gamma kappa - w0),
//
// w the elastic energy density, kappa the curvature, positive where the body is convex. A flat
// surface under stress is not stable (R. J. Asaro, W. A. Tiller, Metall. Trans. 3 (1972) 1789;
// M. A. Grinfeld, Sov. Phys. Dokl. 31 (1986) 831): in plane strain a small wave cos(q x) of it
// grows at the rate
//
//   m [2 (1 - nu^2) sigma^2 q / E - gamma q^2],   that is, if q < q_c = 2 (1 - nu^2) sigma^2/(E
//   gamma),
//
// and sharpens to a cusp in finite time. Without stress (w0 = 0) a circle shrinks as
// R^2 = R0^2 - 2 m gamma t, and its lobes cos(n angle) decay at the rate m gamma (n^2 - 1)/R^2,
// that is as R^(n^2 - 1). docs/stressed_surface.md.

#include <gnomon/model/problem.hpp>

#include "stressed_model.hpp"

namespace gnomon::stressed {

namespace {

const Registration<Problem> stressed_surface({
    .name = "stressed_surface",
    .help = "2D free surface that moves by its elastic energy and its curvature; no contact",
    .keys = stressed_body_keys(),
    .make = [](const Scene& scene) -> std::unique_ptr<Model> {
      return std::make_unique<StressedModel>(read_stressed_body(scene));
    },
});

}  // namespace

}  // namespace gnomon::stressed
