// Friction that may stick, followed along the path of a cycle at a fixed shape and time
// (docs/fretting.md).
#pragma once

#include <functional>
#include <gnomon/base/counters.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/newton/newton_options.hpp>
#include <memory>
#include <string>

namespace gnomon {

/// One phase after the other, each alone, from a state that is known. Throws SolutionError where a
/// phase has no equilibrium, at the start InputError where loads are more than friction holds.
template <int dim>
class PathMarch {
public:
  /// The path of these equations, at this shape and time; equations and counters must outlive it.
  PathMarch(const WornBodyEquations<dim>& equations, const FieldValues<dim>& shape, double t,
            Counters& counters, NewtonOptions newton = {.max_iterations = 40})
      : whole_(equations),
        near_(equations.shared_assembly()),
        t_(t),
        counters_(counters),
        newton_(newton),
        values_(shape),
        last_(equations.phases().size() - 1) {}

  /// The first loading (Interface::loading), where the path begins.
  void load();
  /// Values of all fields, the last phase being known; from the others those of the next cycle are
  /// guessed. `place`: r of every contact node in the last phase.
  void go_on_from(const FieldValues<dim>& values, NodalField<dim> place) {
    values_ = values;
    place_ = std::move(place);
    is_expected_ = true;
    come_near(whole_.phases()[last_], values_.vector(whole_.fields(last_).u), early_);
  }
  /// The values of all fields over the next cycle, with the memory at its begin.
  const FieldValues<dim>& cycle();
  /// r of every contact node in the phase that is known last.
  const NodalField<dim>& place() const { return place_; }

private:
  struct Alone;
  bool press(const Phase<dim>& phase, bool by_facets);
  bool press_sliding(const Phase<dim>& phase);
  NodalField<dim> slipping(const std::vector<ContactNode<dim>>& nodes, double part) const;
  bool has_left_facets(const Alone& alone, const Phase<dim>& phase, const FieldValues<dim>& at,
                       double part) const;
  void keep(const Alone& alone, std::size_t phase);
  void keep_near(Alone alone, std::size_t to);
  bool come_near(const Phase<dim>& at, const NodalField<dim>& u, double part);
  /// Phases from the last one, at part 0, to the next one, at part 1.
  using OnTheWay = std::function<Phase<dim>(double part)>;
  void advance(std::size_t to, const OnTheWay& on_the_way, bool is_expected = false);
  void follow(std::size_t phase);
  double shear() const;
  NodalField<dim> way_to(Alone& alone, const Phase<dim>& phase) const;
  bool is_far(Alone& alone, const Phase<dim>& phase) const;
  void start_from(std::size_t phase, Alone& alone) const;
  void start_from_last(Alone& alone) const;
  enum class Carried { wholly, by_shear };
  void guess(Alone& alone, const Phase<dim>& phase, Carried by) const;
  bool solve(Alone& alone, std::string& reason, bool by_branches = false);
  bool by_halves(Alone& target, const OnTheWay& on_the_way, std::string& reason);
  [[noreturn]] void refuse(const Phase<dim>& phase, const std::string& reason) const;

  static constexpr double early_ = 0.5;  // of the margin in which bodies of pairs may slide
  const WornBodyEquations<dim>& whole_;
  std::shared_ptr<const Assembly<dim>> near_;  // where the bodies of pairs are, by what they carry
  double t_;
  Counters& counters_;
  NewtonOptions newton_;
  FieldValues<dim> values_;
  bool is_expected_ = false;  // values_ have a guess of every phase
  std::size_t last_;          // that of which values_ are known
  NodalField<dim> place_;     // r of every contact node there
};

/// Values of all fields over the second cycle of a path, with the memory at its beginning, at the
/// initial shape (docs/fretting.md): the load grows where the path begins, and two cycles follow,
/// phase by phase. Throws SolutionError.
template <int dim>
FieldValues<dim> start_of_path(const WornBodyEquations<dim>& equations, Counters& counters);

}  // namespace gnomon
