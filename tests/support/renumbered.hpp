// A model that begins a new epoch every few seconds: its unknowns in another order, or in the same
// one with a larger pattern, as where other candidates of contact are declared.
#pragma once

#include <algorithm>
#include <gnomon/model/model.hpp>
#include <memory>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace gnomon::testing {

/// Unknown i of the inner system is unknown place[i] of this one.
using Places = std::vector<int>;

inline Places places_of_epoch(long size, int epoch, bool renumber) {
  Places places(static_cast<std::size_t>(size));
  std::iota(places.begin(), places.end(), 0);
  if (renumber && epoch > 0) std::shuffle(places.begin(), places.end(), std::mt19937(epoch));
  return places;
}

template <class T>
std::vector<T> moved(const std::vector<T>& values, const Places& places) {
  std::vector<T> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) result[places[i]] = values[i];
  return result;
}

template <class T>
std::vector<T> moved_back(std::span<const T> values, const Places& places) {
  std::vector<T> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) result[i] = values[places[i]];
  return result;
}

class RenumberedSystem : public System {
public:
  /// `wider`: how many subdiagonals are declared beside the entries that there are.
  RenumberedSystem(const System& inner, Places places, int wider)
      : inner_(inner), places_(std::move(places)), structure_(inner.structure()) {
    const SparsePattern& pattern = inner.structure().pattern;
    const int n = pattern.size();
    PatternBuilder builder(n);
    for (int j = 0; j < n; ++j) {
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        builder.add({places_[pattern.row_index[k]]}, {places_[j]});
      for (int i = j + 1; i < std::min(n, j + 1 + wider); ++i) builder.add({i}, {j});
    }
    structure_.pattern = builder.build();
    for (int j = 0; j < n; ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        map_.push_back(structure_.pattern.find(places_[pattern.row_index[k]], places_[j]));
    for (auto* values : {&structure_.group, &structure_.block})
      if (!values->empty()) *values = moved(*values, places_);
    for (auto* values : {&structure_.differential, &structure_.component})
      if (!values->empty()) *values = moved(*values, places_);
    for (auto* values :
         {&structure_.row_scale, &structure_.unknown_scale, &structure_.tolerance_scale})
      if (!values->empty()) *values = moved(*values, places_);
  }

  const Structure& structure() const override { return structure_; }
  void residual(const Point& at, std::span<double> F) const override {
    std::vector<double> inner(F.size());
    with_inner(at, [&](const Point& point) { inner_.residual(point, inner); });
    for (std::size_t i = 0; i < F.size(); ++i) F[places_[i]] = inner[i];
  }
  void jacobian(const Point& at, double alpha, std::span<double> values) const override {
    std::vector<double> inner(map_.size());
    with_inner(at, [&](const Point& point) { inner_.jacobian(point, alpha, inner); });
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t k = 0; k < map_.size(); ++k) values[map_[k]] = inner[k];
  }
  void switching(const Point& at, std::span<double> values) const override {
    with_inner(at, [&](const Point& point) { inner_.switching(point, values); });
  }
  std::vector<AlgebraicStage> algebraic_stages() const override {
    auto stages = inner_.algebraic_stages();
    for (AlgebraicStage& stage : stages) {
      for (int& unknown : stage.unknowns) unknown = places_[unknown];
      stage.freeze = [this, freeze = stage.freeze](double t, std::span<const double> y) {
        freeze(t, moved_back(y, places_));
      };
    }
    return stages;
  }
  const Places& places() const { return places_; }

private:
  template <class Call>
  void with_inner(const Point& at, const Call& call) const {
    const std::vector<double> y = moved_back(at.y, places_), ydot = moved_back(at.ydot, places_);
    call({at.t, y, ydot, at.branch, at.within});
  }

  const System& inner_;
  Places places_;
  Structure structure_;
  std::vector<int> map_;  // place of each value of the inner Jacobian
};

struct EpochOptions {
  double interval = 1;  ///< an epoch begins with the first step that ends at or after its multiples
  bool renumber = true;  ///< else the unknowns keep their order, and only the pattern is new
};

class RenumberedModel : public Model {
public:
  RenumberedModel(std::shared_ptr<const Model> inner, const EpochOptions& options, int epoch = 0)
      : inner_(std::move(inner)),
        options_(options),
        epoch_(epoch),
        system_(inner_->system(),
                places_of_epoch(inner_->system().structure().size, epoch, options.renumber),
                options.renumber ? 0 : epoch) {
    static_cast<ModelFacts&>(*this) = *inner_;
    if (inner_->wear_flux)
      wear_flux = [this](const Point& at) {
        const std::vector<double> y = moved_back(at.y, system_.places()),
                                  ydot = moved_back(at.ydot, system_.places());
        return inner_->wear_flux({at.t, y, ydot, at.branch, at.within});
      };
    if (inner_->exact)
      exact = [this](double t) {
        const auto exact = inner_->exact(t);
        return exact ? std::optional(outer(*exact)) : std::nullopt;
      };
    succeed = [this](const State& state) { return successor(state); };
  }

  const System& system() const override { return system_; }
  State start(Counters& counters) const override { return outer(inner_->start(counters)); }
  Observation observe(const State& state) const override { return inner_->observe(inner(state)); }
  std::vector<GridField> fields(const State& state) const override {
    return inner_->fields(inner(state));
  }
  std::optional<ContactSurface> contact(const State& state) const override {
    return inner_->contact(inner(state));
  }

  State inner(const State& state) const {
    return {state.t, moved_back(std::span<const double>(state.y), system_.places()),
            moved_back(std::span<const double>(state.ydot), system_.places()), state.branch};
  }
  State outer(const State& state) const {
    return {state.t, moved(state.y, system_.places()), moved(state.ydot, system_.places()),
            state.branch};
  }

private:
  std::optional<Succession> successor(const State& state) const {
    if (state.t < (epoch_ + 1) * options_.interval) return {};
    const int next = static_cast<int>(state.t / options_.interval);
    auto model = std::make_shared<RenumberedModel>(inner_, options_, next);
    State same = model->outer(inner(state));
    return Succession{std::move(model), std::move(same), !options_.renumber};
  }

  std::shared_ptr<const Model> inner_;
  EpochOptions options_;
  int epoch_;
  RenumberedSystem system_;
};

}  // namespace gnomon::testing
