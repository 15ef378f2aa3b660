// A user's term: a boundary part on elastic springs, in one file and without other changes. A scene
// switches it on by the keys that the registration adds.

#include <gmock/gmock.h>

#include <gnomon/mesh/named_part.hpp>
#include <gnomon/model/added_term.hpp>

#include "support/pin.hpp"

namespace gnomon::own_term_test {
namespace {

using namespace testing;

/// k A_i u_i in the rows of u of the nodes of a boundary part, A_i their shares of its area.
template <int dim>
class Springs : public Term<dim> {
public:
  Springs(const Mesh<dim>& mesh, const std::string& part, double stiffness,
          const Numbering& numbering, FieldId u)
      : u_(u) {
    for (const ContactPatch<dim>& patch : contact_patches<dim>(mesh, named_part(mesh, part)))
      for (int i = 0; i < dim; ++i)
        if (const int row = numbering.number(u, patch.node, i); row >= 0)
          springs_.push_back({row, -1, patch.node, i, stiffness * patch.initial_area});
  }
  void declare(TermStructure& structure) const override {
    for (const Spring& s : springs_) structure.pattern.add({s.row}, {s.row});
  }
  void map_to(const SparsePattern& pattern) override {
    for (Spring& s : springs_) s.position = pattern.find(s.row, s.row);
  }
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    for (const Spring& s : springs_) F[s.row] += s.stiffness * at.values.vector(u_)(s.node, s.i);
  }
  void add_jacobian(const Evaluation<dim>&, double, std::span<double> values) const override {
    for (const Spring& s : springs_) values[s.position] += s.stiffness;
  }
  void switching(const Evaluation<dim>&, std::span<double>) const override {}

private:
  struct Spring {
    int row, position, node, i;
    double stiffness;  // [force / length]
  };
  FieldId u_;
  std::vector<Spring> springs_;
};

template <int dim>
AddedTermFactory<dim> make(const Scene& scene) {
  if (!scene.has("springs.stiffness")) return {};
  const double stiffness = scene.real("springs.stiffness");
  const std::string part = scene.text("springs.on");
  return [=](const WornBody<dim>& body, const WornBodyFields& fields, const Numbering& numbering) {
    return std::make_unique<Springs<dim>>(body.mesh, part, stiffness, numbering, fields.u);
  };
}

const Registration<AddedTerm> registration({.name = "springs",
                                            .help = "a boundary part on elastic springs",
                                            .keys = {{.name = "springs.stiffness",
                                                      .unit = "MPa/mm",
                                                      .presence = Key::Presence::optional,
                                                      .absent_meaning = "no springs",
                                                      .range = positive_quantity,
                                                      .help = "traction per unit of displacement"},
                                                     {.name = "springs.on",
                                                      .kind = KeyKind::text,
                                                      .presence = Key::Presence::defaulted,
                                                      .default_value = "top",
                                                      .help = "boundary part on springs"}},
                                            .in_the_plane = make<2>,
                                            .in_space = make<3>});

double contact_force(const Overrides& overrides, double* top = nullptr) {
  const auto model = pin_model(overrides);
  Counters counters;
  const State start = model->start(counters);
  if (top) {
    const GridField u = model->fields(start).front();
    const Grid grid = model->grid().value();
    *top = 0;
    for (std::size_t n = 0; n < grid.points.size(); ++n)
      if (grid.points[n][1] == 10)
        *top += u.values[3 * n + 1] * (std::abs(grid.points[n][0]) == 5 ? 0.5 : 1);
    *top /= 8;  // elements across: the mean of the displacement by the trapezoidal rule
  }
  return observed(*model, start, "contact_force");
}

// The springs carry the part of the load that contact does not carry: force + k L (mean
// displacement of the top) = load.
TEST(OwnTerm, SpringsCarryTheirShareOfTheLoad) {
  constexpr double load = 20, stiffness = 3, width = 10;
  double free_top = 0, held_top = 0;
  EXPECT_NEAR(contact_force({elements(8)}, &free_top), load, 1e-8);
  const double carried = contact_force({elements(8), "springs.stiffness=3"}, &held_top);
  EXPECT_LT(carried, 0.95 * load);
  EXPECT_LT(std::abs(held_top), std::abs(free_top));
  EXPECT_NEAR(carried - stiffness * width * held_top, load, 1e-8);
}

TEST(OwnTerm, KeepsTheJacobianExact) {
  const auto model = pin_model({elements(3), "springs.stiffness=50", "springs.on=top"});
  std::vector<double> y(model->system().structure().size);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = 0.01 * std::sin(double(i));
  check_jacobian(model->system(), 0, y, 0.2);
}

TEST(OwnTerm, ItsKeysAreCheckedLikeAllOthers) {
  EXPECT_THROW(pin_scene({"springs.stiffness=-1"}), InputError);
  EXPECT_THROW(pin_scene({"springs.stifness=1"}), InputError);
}

// So that a result can be read without terms that are known, but that its scene did not request.
TEST(OwnTerm, ItsKeysAreStoredWithTheScenesThatRequestIt) {
  const auto stored = [](const Overrides& overrides) {
    const Scene scene = pin_scene(overrides);
    const std::string text = scene.resolved();
    EXPECT_TRUE(parse_scene(text, "resolved", {}, key_table) == scene);
    return text;
  };
  EXPECT_THAT(stored({}), ::testing::Not(::testing::HasSubstr("springs")));
  EXPECT_THAT(stored({"springs.stiffness=50"}), ::testing::HasSubstr("\non = \"top\""));
}

TEST(OwnTerm, AnUnknownPartIsToldWithTheNamesThatThereAre) {
  EXPECT_THAT(
      [] {
        pin_model({elements(3), "springs.stiffness=1", "springs.on=tpo"});
      },
      ::testing::ThrowsMessage<InputError>(
          "the mesh has no boundary part called \"tpo\", it has bottom, left, right, "
          "top"));
}

}  // namespace
}  // namespace gnomon::own_term_test
