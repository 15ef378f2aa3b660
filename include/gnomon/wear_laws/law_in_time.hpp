// What a wear law does in time by itself, whatever the state of the surface. It is known before a
// run, so that no step need pass over it.
#pragma once

#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// The sum of the rates of a law at typical inputs, as a function of time, sampled over a run. What
/// lasts `resolution` or longer is found, also where it is far from the next sample in value.
class LawInTime {
public:
  LawInTime(const WearLaw& law, const WearRange& range);

  /// Whether it changes with time at all, beside the jumps at breakpoints.
  bool changes() const { return changes_; }
  double resolution() const { return duration_ / parts; }  ///< [time]
  /// Times between which a parabola through both ends and the middle shows what the rate does, up
  /// to a small part of it or to `tolerance` of its integral over the run, and its ends a part of
  /// that. Nothing where a smooth part takes more than 5000 of them.
  std::optional<std::vector<double>> stops(double tolerance) const;
  /// How much it changes within `resolution`, and how much of it samples at irregular times see
  /// that those of this class do not: means of the differences over the mean rate.
  double fast_part() const { return integral_ > 0 ? fast_ / integral_ : 0; }
  double unseen_part() const;
  /// How much it changes within a cycle of this period, the mean over the run, as a part of its
  /// mean.
  double change_within(double period) const;
  /// What lies off the parabolas through the ends and the middle of these steps, which also end at
  /// breakpoints, as a part of the integral. Of steps with a larger part, what a method sees
  /// depends on where its stages lie.
  double missed_by_steps(double step) const;

private:
  static constexpr int parts = 2000;
  /// A part of the run between two samples, with a third one in the middle.
  struct Piece {
    double from, to, at_from, at_middle, at_to;
    double integral() const { return (to - from) * (at_from + 4 * at_middle + at_to) / 6; }
    /// The parabola through the samples.
    double at(double t) const;
  };
  double rate(double t, double within) const;
  void refine(const Piece& piece, double within, int depth);
  double missed_by(const Piece& part, std::size_t first) const;
  bool shows(std::size_t first, std::size_t last, double tolerance) const;
  void split(std::size_t first, std::size_t last, double tolerance,
             std::vector<std::size_t>& begins) const;

  const WearLaw& law_;
  double duration_, nominal_speed_;
  std::vector<WearInput> typical_;
  std::vector<double> ends_;         // of the smooth parts in time, from 0
  std::vector<Piece> pieces_;        // ascending
  std::vector<std::size_t> begins_;  // of the smooth parts in pieces_; last: their number
  double integral_ = 0, fast_ = 0;
  bool changes_ = false;
};

}  // namespace gnomon
