// The rows that move the worn surface, eq. (14): ddot + sum over the sources of Wdot N = 0, and in
// the multiplier form the reaction mu that carries them into the auxiliary equilibrium, eq. (29).
#pragma once

#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// The fields of the worn surface, and its nodes.
template <int dim>
struct WornSurface {
  FieldId d = FieldId::none;   ///< shape, at all nodes of the mesh
  FieldId mu = FieldId::none;  ///< shape multiplier, at `nodes`; none: the reaction is eliminated
  const std::vector<ContactPatch<dim>>* nodes = nullptr;
  double augmentation = 0;  ///< of mu: mu^ = mu + augmentation x row of d [stress time / length]
};

/// The rows to which a source of wear adds its share. By eq. (29) every share in a row of d is also
/// added to the row of mu, times -A^ and the augmentation.
template <int dim>
class EvolutionRows {
public:
  EvolutionRows(const Numbering& numbering, const WornSurface<dim>& surface);

  /// Number of the row of d at worn node c, -1: none.
  int row(int c, int i) const { return rows_(c, i); }
  /// Number of the row of mu, -1: none.
  int reaction(int c, int i) const { return reactions_(c, i); }
  /// Factor of an entry of the row of d in the row of mu; zero if one of the rows is missing.
  double factor(int c) const { return factor_[static_cast<std::size_t>(c)]; }
  /// F += share in both rows.
  void add(int c, const Vector<dim>& share, std::span<double> F) const;

private:
  NodalNumbers<dim> rows_, reactions_;
  std::vector<double> factor_;
};

/// ddot in the rows of d, and -A^ (mu + augmentation ddot) in those of mu.
template <int dim>
class ShapeEvolution : public Term<dim> {
public:
  ShapeEvolution(const Numbering& numbering, const WornSurface<dim>& surface);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;
  void switching(const Evaluation<dim>&, std::span<double>) const override {}

private:
  struct Row {
    int row, reaction;      // numbers, -1: none
    double factor, area;    // factor of the share in the reaction; A^
    int entity, component;  // of mu
    int by_rate = -1, reaction_by_rate = -1, reaction_by_mu = -1;  // positions in J
  };
  FieldId mu_;
  std::vector<Row> rows_;
};

}  // namespace gnomon
