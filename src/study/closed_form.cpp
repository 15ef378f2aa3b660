#include "study/closed_form.hpp"

#include <gnomon/base/error.hpp>

namespace gnomon::study {

std::vector<ContactSurface> closed_form(const Model& model, const std::vector<double>& times) {
  std::vector<ContactSurface> surfaces;
  if (!model.exact || !model.exact(times.back())) return surfaces;
  for (const double t : times) {
    const auto surface = model.contact(*model.exact(t));
    if (!surface) throw InputError("the problem has no contact surface, expected one to compare");
    surfaces.push_back(*surface);
  }
  return surfaces;
}

}  // namespace gnomon::study
