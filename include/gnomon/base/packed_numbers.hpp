// Values of several kinds as one list of numbers, without rounding, for checkpoints.
#pragma once

#include <gnomon/base/error.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// Appends a value, or values without their count.
inline void pack(std::vector<double>& numbers, double value) {
  numbers.push_back(value);
}
template <class T>
void pack(std::vector<double>& numbers, const std::vector<T>& values) {
  numbers.insert(numbers.end(), values.begin(), values.end());
}

/// Takes them back in the same order. Throws InputError where there are fewer numbers.
class Unpacker {
public:
  explicit Unpacker(std::span<const double> numbers) : rest_(numbers) {}

  double one() { return take(1)[0]; }
  template <class T>
  std::vector<T> many(std::size_t count) {
    const auto taken = take(count);
    return std::vector<T>(taken.begin(), taken.end());
  }
  std::span<const double> take(std::size_t count) {
    if (count > rest_.size()) throw InputError("the checkpoint does not belong to this scene");
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  std::span<const double> rest() const { return rest_; }

private:
  std::span<const double> rest_;
};

}  // namespace gnomon
