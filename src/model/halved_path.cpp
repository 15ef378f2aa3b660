#include "model/halved_path.hpp"

#include <algorithm>
#include <gnomon/base/processes.hpp>

#include "model/observed_path.hpp"
#include "model/path_march.hpp"

namespace gnomon {

namespace {

/// Phases of a path, each in two halves: the known ones, and before each the mean with the last.
template <int dim>
void guess_halves(const WornBodyEquations<dim>& equations, const FieldValues<dim>& known,
                  const WornBodyEquations<dim>& finer, FieldValues<dim>& guess) {
  const std::size_t count = equations.phases().size();
  for (std::size_t p = 0; p < count; ++p) {
    const WornBodyFields &last = equations.fields((p + count - 1) % count),
                         &own = equations.fields(p);
    for (const double part : {0.5, 1.0}) {
      const WornBodyFields& to = finer.fields(2 * p + (part == 1));
      for (std::size_t k = 0; k < to.of_phase().size(); ++k) {
        const FieldId a = last.of_phase()[k], b = own.of_phase()[k], between = to.of_phase()[k];
        if (between == FieldId::none) continue;
        guess.vector(between) = (1 - part) * known.vector(a) + part * known.vector(b);
        guess.matrix(between) = (1 - part) * known.matrix(a) + part * known.matrix(b);
      }
    }
  }
}

/// The phases of a path, each in two halves.
template <int dim>
std::vector<Phase<dim>> halved(const Assembly<dim>& assembly) {
  std::vector<CyclePoint> ends;
  for (const Phase<dim>& phase : assembly.phases)
    for (const double back : {0.5, 0.0})
      ends.push_back({phase.position - back * phase.interval, phase.interval / 2});
  return path_phases(ends, assembly.cycle->motion, assembly.interface.partner,
                     assembly.interface.force);
}

/// The largest distance between places of nodes that touch in some phase.
template <int dim>
double most_moved(const NodalField<dim>& from, const NodalField<dim>& to,
                  const std::vector<Hold>& holds) {
  double most = 0;
  for (std::size_t c = 0; c < holds.size(); ++c)
    if (const auto row = static_cast<Eigen::Index>(c); holds[c] != Hold::open)
      most = std::max(most, (to.row(row) - from.row(row)).norm());
  return largest_over_processes(most);
}

}  // namespace

template <int dim>
std::vector<PhaseContact<dim>> contacts_of_halves(const WornBodyEquations<dim>& equations,
                                                  const FieldValues<dim>& values, double t,
                                                  const NewtonOptions& newton) {
  const WornBodyEquations<dim> finer(equations.shared_assembly(), halved(equations.assembly()));
  FieldValues<dim> guess(*finer.composition()->fields);
  guess.vector(finer.fields().d) = values.vector(equations.fields().d);
  guess_halves(equations, values, finer, guess);
  Counters counters;
  PathMarch<dim> march(finer, guess, t, counters, newton);
  march.go_on_from(guess, values.vector(equations.fields().memory));
  const ComposedSystem<dim> system(finer.composition());
  const auto contacts_of = [&](const FieldValues<dim>& cycle) {
    std::vector<double> y(static_cast<std::size_t>(system.structure().size));
    system.numbering().gather(cycle, y);
    std::vector<PhaseContact<dim>> contacts;
    for (std::size_t p = 0; p < finer.phases().size(); ++p)
      contacts.push_back(
          {finer.phases()[p].weight, finer.contact_nodes(system, cycle, {.t = t, .y = y}, p)});
    return contacts;
  };
  constexpr double closed = 1e-3;
  const NodalField<dim> begin = march.place();
  std::vector<PhaseContact<dim>> contacts = contacts_of(march.cycle());
  const CycleOfSlip slip = cycle_of_slip(equations.assembly(), contacts);
  if (most_moved<dim>(begin, march.place(), slip.holds) > closed * slip.path)
    contacts = contacts_of(march.cycle());
  return contacts;
}

template std::vector<PhaseContact<2>> contacts_of_halves(const WornBodyEquations<2>&,
                                                         const FieldValues<2>&, double,
                                                         const NewtonOptions&);
template std::vector<PhaseContact<3>> contacts_of_halves(const WornBodyEquations<3>&,
                                                         const FieldValues<3>&, double,
                                                         const NewtonOptions&);

}  // namespace gnomon
