#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/wear_laws/law_in_time.hpp>
#include <limits>
#include <numeric>

namespace gnomon {

namespace {

/// Pressures, depths and places at which a law is looked at.
std::vector<WearInput> typical_inputs(const WearRange& range) {
  constexpr std::size_t places = 3;
  std::vector<WearInput> inputs;
  const std::size_t stride = std::max<std::size_t>(1, range.initial.size() / places);
  for (const double pressure : {1.0, 3.0})
    for (const double depth : {0.0, 0.3})
      for (std::size_t k = 0; k < range.initial.size(); k += stride) {
        const double p = pressure * range.pressure;
        inputs.push_back({.pressure = p,
                          .speed = range.speed,
                          .depth = depth * range.depth,
                          .friction_power = range.friction * p * range.speed,
                          .mean_friction_power = range.friction * p * range.speed,
                          .moment = {},
                          .initial = range.initial[k]});
      }
  return inputs;
}

double parabola(double at_from, double at_middle, double at_to, double part) {
  return at_from * (1 - part) * (1 - 2 * part) + at_middle * 4 * part * (1 - part) +
         at_to * part * (2 * part - 1);
}

}  // namespace

LawInTime::LawInTime(const WearLaw& law, const WearRange& range)
    : law_(law),
      duration_(range.duration),
      nominal_speed_(range.nominal_speed),
      typical_(typical_inputs(range)) {
  begins_ = {0};
  if (!law.in_time()) return;
  ends_ = {0};
  for (const double time : law.breakpoints())
    if (time > 0 && time < duration_) ends_.push_back(time);
  ends_.push_back(duration_);
  for (std::size_t k = 0; k + 1 < ends_.size(); ++k) {
    const double from = ends_[k], length = ends_[k + 1] - from;
    const int count = std::max(1, static_cast<int>(std::ceil(parts * length / duration_)));
    for (int i = 0; i < count; ++i) {
      const double a = from + length * i / count,
                   b = i + 1 < count ? from + length * (i + 1) / count : ends_[k + 1];
      const double before = i > 0 ? pieces_.back().at_to : rate(a, from);
      const Piece part{a, b, before, rate((a + b) / 2, from), rate(b, from)};
      const std::size_t first = pieces_.size();
      refine(part, from, 0);
      fast_ += missed_by(part, first);
    }
    begins_.push_back(pieces_.size());
  }
  for (const Piece& piece : pieces_) {
    integral_ += piece.integral();
    const double size = 1e-12 * std::abs(piece.at_from);
    changes_ |= std::abs(piece.at_middle - piece.at_from) > size ||
                std::abs(piece.at_to - piece.at_from) > size;
  }
}

double LawInTime::Piece::at(double t) const {
  return parabola(at_from, at_middle, at_to, (t - from) / (to - from));
}

/// Integral of what the parabola of a part misses of its pieces, which are the last ones.
double LawInTime::missed_by(const Piece& part, std::size_t first) const {
  double missed = 0;
  for (std::size_t k = first; k < pieces_.size(); ++k) {
    const Piece& piece = pieces_[k];
    const double middle = (piece.from + piece.to) / 2;
    missed += (piece.to - piece.from) / 6 *
              (std::abs(piece.at_from - part.at(piece.from)) +
               4 * std::abs(piece.at_middle - part.at(middle)) +
               std::abs(piece.at_to - part.at(piece.to)));
  }
  return missed;
}

double LawInTime::unseen_part() const {
  constexpr int samples = 4000;
  constexpr double golden = 0.6180339887498949, clearly = 0.1;
  if (pieces_.empty()) return 0;
  double whole = 0, unseen = 0;
  for (int k = 1; k <= samples; ++k) {
    const double t = duration_ * (k * golden - std::floor(k * golden));
    const Piece& piece = *std::prev(std::ranges::upper_bound(pieces_, t, {}, &Piece::from));
    const double value = rate(t, *std::prev(std::ranges::upper_bound(ends_, t))),
                 off = std::abs(value - piece.at(t));
    whole += value;
    if (off > clearly * std::max({value, piece.at_from, piece.at_middle, piece.at_to}))
      unseen += off;
  }
  return whole > 0 ? unseen / whole : 0;
}

double LawInTime::rate(double t, double within) const {
  double sum = 0;
  for (WearInput at : typical_) {
    at.moment = {t, nominal_speed_ * t, within};
    try {
      sum += std::max(0.0, law_.rate(at).value);
    } catch (const RecoverableError&) {  // a depth that the run may not come to
    }
  }
  return sum;
}

/// Halves a piece until the parabola through its samples is near to its quarters; always once.
void LawInTime::refine(const Piece& piece, double within, int depth) {
  constexpr double near = 0.05;
  constexpr int most = 12;
  const double middle = (piece.from + piece.to) / 2;
  const double left = rate((piece.from + middle) / 2, within),
               right = rate((middle + piece.to) / 2, within);
  const Piece halves[] = {{piece.from, middle, piece.at_from, left, piece.at_middle},
                          {middle, piece.to, piece.at_middle, right, piece.at_to}};
  const double size = std::max({piece.at_from, piece.at_middle, piece.at_to, left, right});
  const auto off = [&](double value, double part) {
    return std::abs(value - parabola(piece.at_from, piece.at_middle, piece.at_to, part));
  };
  if (depth == most || std::max(off(left, 0.25), off(right, 0.75)) <= near * size) {
    pieces_.insert(pieces_.end(), std::begin(halves), std::end(halves));
    return;
  }
  for (const Piece& half : halves) refine(half, within, depth + 1);
}

/// Whether a parabola shows the rate in these pieces. What it misses is either little, or spread
/// over them, so that the stages of a step see it. The ends show a part of it: many methods look
/// nowhere else.
bool LawInTime::shows(std::size_t first, std::size_t last, double tolerance) const {
  constexpr double little = 0.1, spread = 0.15, of_middle = 0.1;
  if (last - first == 1) return true;
  const double from = pieces_[first].from, to = pieces_[last - 1].to, middle = (from + to) / 2;
  const auto there = std::upper_bound(pieces_.begin() + static_cast<std::ptrdiff_t>(first),
                                      pieces_.begin() + static_cast<std::ptrdiff_t>(last), middle,
                                      [](double t, const Piece& piece) { return t < piece.from; });
  const Piece& in = *std::prev(there);
  const double at_middle = in.at(middle),
               at_ends = std::max(pieces_[first].at_from, pieces_[last - 1].at_to);
  double least = std::numeric_limits<double>::infinity(), whole = 0, missed = 0, squares = 0;
  const auto take = [&](double t, double value, double weight) {
    const double off =
        std::abs(value - parabola(pieces_[first].at_from, at_middle, pieces_[last - 1].at_to,
                                  (t - from) / (to - from)));
    least = std::min(least, value);
    whole += weight * value;
    missed += weight * off;
    squares += weight * off * off;
  };
  for (std::size_t k = first; k < last; ++k) {
    const Piece& piece = pieces_[k];
    const double sixth = (piece.to - piece.from) / 6;
    take(piece.from, piece.at_from, sixth);
    take((piece.from + piece.to) / 2, piece.at_middle, 4 * sixth);
    take(piece.to, piece.at_to, sixth);
  }
  const double length = to - from;
  const double much = tolerance * integral_ * std::sqrt(length / duration_);
  if (whole > much && at_ends < of_middle * at_middle) return false;
  if (missed <= much) return true;
  return missed <= little * (whole - least * length) &&
         missed * missed >= spread * length * squares;
}

/// Halves of pieces, until a parabola shows each.
void LawInTime::split(std::size_t first, std::size_t last, double tolerance,
                      std::vector<std::size_t>& begins) const {
  if (shows(first, last, tolerance)) return begins.push_back(first);
  const std::size_t middle = (first + last) / 2;
  split(first, middle, tolerance, begins);
  split(middle, last, tolerance, begins);
}

std::optional<std::vector<double>> LawInTime::stops(double tolerance) const {
  constexpr std::size_t most = 5000;
  std::vector<double> found;
  if (!changes_) return found;
  for (std::size_t part = 0; part + 1 < begins_.size(); ++part) {
    std::vector<std::size_t> begins;
    split(begins_[part], begins_[part + 1], tolerance, begins);
    if (begins.size() > most) return {};
    std::size_t first = begins.front();  // neighbours that one parabola shows belong together
    for (std::size_t k = 1; k < begins.size(); ++k) {
      const std::size_t end = k + 1 < begins.size() ? begins[k + 1] : begins_[part + 1];
      if (shows(first, end, tolerance)) continue;
      found.push_back(pieces_[begins[k]].from);
      first = begins[k];
    }
  }
  return found;
}

double LawInTime::change_within(double period) const {
  constexpr int most = 100, samples = 16;
  if (!changes_ || integral_ == 0) return 0;
  const int periods = static_cast<int>(std::clamp(std::floor(duration_ / period), 1.0, 1.0 * most));
  double off = 0, sum = 0;
  for (int k = 0; k < periods; ++k) {
    const double begin = std::max(0.0, duration_ - period) * k / std::max(1, periods - 1);
    std::array<double, samples> values{};
    for (int i = 0; i < samples; ++i) {
      const double t = std::min(begin + (i + 0.5) / samples * period, duration_);
      values[i] = rate(t, *std::prev(std::ranges::upper_bound(ends_, t)));
    }
    const double mean = std::reduce(values.begin(), values.end()) / samples;
    for (const double value : values) off += std::abs(value - mean) / samples;
    sum += mean;
  }
  return sum > 0 ? off / sum : 0;
}

double LawInTime::missed_by_steps(double step) const {
  if (!changes_ || integral_ == 0 || step < duration_ / static_cast<double>(pieces_.size()))
    return 0;
  double missed = 0;
  for (std::size_t part = 0; part + 1 < begins_.size(); ++part) {
    const double begin = ends_[part], end = ends_[part + 1];
    Piece whole{begin, begin, 0, 0, 0};  // the step of a piece, by the middle of that
    for (std::size_t k = begins_[part]; k < begins_[part + 1]; ++k) {
      const Piece& piece = pieces_[k];
      const double middle = (piece.from + piece.to) / 2;
      while (whole.to < middle && whole.to < end) {
        const double from = whole.to,
                     to = std::min(step * (std::floor(from / step * (1 + 1e-12)) + 1), end);
        whole = {from, to, rate(from, begin), rate((from + to) / 2, begin), rate(to, begin)};
      }
      missed += std::abs(piece.at_middle - whole.at(middle)) * (piece.to - piece.from);
    }
  }
  return missed / integral_;
}

}  // namespace gnomon
