// The error of the mean over the phases of a cycle, estimated with other phases.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/model/wear_model.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon {

/// The deformation of a body in any phases of its cycle, at a fixed shape and time. What is known
/// of some phases gives the first guesses for others. At most as many phases as the body has, or
/// some, are solved at a time, for they take memory.
template <int dim>
class FixedShape {
public:
  /// The unworn shape at t = 0.
  explicit FixedShape(std::shared_ptr<const Assembly<dim>> body);
  /// The shape and time of a state, whose phases are known: its values, and contact in each phase.
  FixedShape(double t, const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
             const std::vector<PhaseContact<dim>>& contacts);

  /// Mean wear rate over the phases at every contact node [length / time]. Throws SolutionError.
  std::vector<double> mean_rate(const std::vector<Phase<dim>>& phases);
  /// A part of its volume: of every contact node, known after mean_rate() [length^(dim - 1)].
  const std::vector<double>& areas() const { return areas_; }

private:
  struct Known {
    double position;
    NodalField<dim> u;
    Eigen::VectorXd lambda;
    Eigen::VectorXd w;
    std::vector<double> rate;  // of wear, at every contact node
  };
  void solve(const std::vector<Phase<dim>>& phases);
  void find_deformation(const WornBodyEquations<dim>& equations, ComposedSystem<dim>& deformation,
                        std::vector<double>& y) const;
  void keep(const Phase<dim>& phase, const WornBodyFields& fields, const FieldValues<dim>& values,
            const std::vector<ContactNode<dim>>& nodes);
  const Known& nearest(double position) const;
  bool is_known(double position) const;

  std::shared_ptr<const Assembly<dim>> body_;
  double t_ = 0;
  NodalField<dim> d_;
  std::vector<Known> known_;
  std::vector<double> areas_;
};

/// The error of the means of speed, and of its products with force and load, over the phases:
/// against `fine` ones, as a part of the latter. Nothing is solved.
template <int dim>
double error_of_motion(const std::vector<Phase<dim>>& phases, const std::vector<Phase<dim>>& fine);

/// The number of phases, as many as the body has or more, that is within the tolerance at the
/// initial shape. Throws SolutionError.
template <int dim>
ChosenPhases choose_phases(std::shared_ptr<const Assembly<dim>> body, double tolerance);

/// Mean wear rates at the nodes of a surface, beside each other [volume / time].
struct RateDifference {
  double difference = 0;  ///< its absolute value summed up over the surface
  double whole = 0;       ///< of the second
};

/// By the area of each node and its two mean rates.
RateDifference compare_rates(const std::vector<double>& areas, const std::vector<double>& coarse,
                             const std::vector<double>& fine);

}  // namespace gnomon
