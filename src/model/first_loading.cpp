#include "model/first_loading.hpp"

#include <cmath>

namespace gnomon {

template <int dim>
Phase<dim> with_parts(Phase<dim> phase, const LoadingStep& parts) {
  phase.load *= parts.press;
  if (phase.force) *phase.force *= parts.press;
  phase.swing = parts.others;
  std::vector<Guide<dim>>& guides = phase.counter_body.guides;
  for (std::size_t k = 1; k < guides.size(); ++k)
    if (guides[k].force) *guides[k].force *= parts.others;
  if (parts.others == 0 && !guides.empty() && phase.force)
    phase.counter_body.come_along(guides.front().along);
  return phase;
}

LoadingStep between(const LoadingStep& from, const LoadingStep& to, double part) {
  return {std::lerp(from.press, to.press, part), std::lerp(from.others, to.others, part)};
}

std::vector<LoadingStep> with_a_pressed_start(std::vector<LoadingStep> steps) {
  constexpr double small = 0.05;
  constexpr int increments = 10;
  const LoadingStep first = steps.front();
  if (first.others == 0) return steps;
  std::vector<LoadingStep> way = {{small * first.press, 0}};
  for (int k = 1; k < increments; ++k) {
    const double part = std::lerp(small, 1.0, double(k) / increments);
    way.push_back({part * first.press, part * first.others});
  }
  steps.insert(steps.begin(), way.begin(), way.end());
  return steps;
}

template Phase<2> with_parts(Phase<2>, const LoadingStep&);
template Phase<3> with_parts(Phase<3>, const LoadingStep&);

}  // namespace gnomon
