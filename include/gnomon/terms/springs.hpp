// Elastic springs on a part of the boundary, an elastic foundation; and dead loads that follow a
// history: nodal forces on a body, and the force that presses a rigid counter-body.
#pragma once

#include <gnomon/base/error.hpp>
#include <gnomon/laws/load_history.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// k A^_i u_i in the rows of u of the nodes of a boundary part, A^_i their shares of its initial
/// area.
template <int dim>
class Springs : public Term<dim> {
public:
  /// `stiffness`: traction per unit of displacement, for each component; zero: no spring [stress /
  /// length]. The field is the displacement at all nodes of the mesh.
  Springs(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
          const Vector<dim>& stiffness, const Numbering& numbering, FieldId u,
          Section section = Section::plane)
      : u_(u) {
    for (const ContactPatch<dim>& patch : contact_patches<dim>(mesh, facets, {}, section))
      for (int i = 0; i < dim; ++i)
        if (const int row = numbering.number(u, patch.node, i); row >= 0 && stiffness[i] != 0)
          springs_.push_back({row, -1, patch.node, i, stiffness[i] * patch.initial_area});
  }

  void declare(TermStructure& structure) const override {
    for (const Spring& spring : springs_) structure.pattern.add({spring.row}, {spring.row});
  }
  void map_to(const SparsePattern& pattern) override {
    for (Spring& spring : springs_) spring.position = pattern.find(spring.row, spring.row);
  }
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    for (const Spring& spring : springs_)
      F[spring.row] += spring.stiffness * at.values.vector(u_)(spring.node, spring.component);
  }
  void add_jacobian(const Evaluation<dim>&, double, std::span<double> values) const override {
    for (const Spring& spring : springs_) values[spring.position] += spring.stiffness;
  }

private:
  struct Spring {
    int row, position, node, component;
    double stiffness;  // [force / length]
  };
  FieldId u_;
  std::vector<Spring> springs_;
};

/// - factor(t) f in the rows of a vector field (nodes x dim) or of a scalar one.
template <int dim>
class Loads : public Term<dim> {
public:
  /// What a load is for: one that alone keeps the bodies together may not vanish.
  enum class Purpose { presses, acts };

  /// `forces`: at factor one, entities x components of the field [force]. The field may be absent.
  Loads(const Numbering& numbering, FieldId field, const Field::Values& forces, LoadHistory history,
        Purpose purpose = Purpose::presses)
      : history_(std::move(history)), purpose_(purpose) {
    const Field::Indices& numbers = numbering.numbers(field);
    for (Eigen::Index k = 0; k < numbers.size(); ++k)
      if (numbers.data()[k] >= 0 && forces.data()[k] != 0)
        entries_.push_back({numbers.data()[k], forces.data()[k]});
  }

  void declare(TermStructure& structure) const override {
    structure.breakpoints.insert(structure.breakpoints.end(), history_.times().begin(),
                                 history_.times().end());
  }
  /// Throws if the load, continued past its breakpoint, is no longer positive.
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    if (entries_.empty()) return;
    const double factor = at.load_fraction * history_.factor(at.t, at.within);
    if (factor <= 0 && purpose_ == Purpose::presses)
      throw RecoverableError("no load is left at a stage past the end of the step");
    for (const Entry& entry : entries_) F[entry.row] -= factor * entry.force;
  }
  void add_jacobian(const Evaluation<dim>&, double, std::span<double>) const override {}

private:
  struct Entry {
    int row;
    double force;
  };
  LoadHistory history_;
  Purpose purpose_;
  std::vector<Entry> entries_;
};

}  // namespace gnomon
