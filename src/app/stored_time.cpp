#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/number_text.hpp>
#include <optional>

#include "app/commands.hpp"

namespace gnomon::app {

namespace {

struct PrintedNumber {
  double value;
  double half_digit;  // half of one in its last digit
};

/// Without "t =" before it and "s" after it.
std::string number_in(std::string text) {
  const auto drop_spaces = [&] {
    const std::size_t first = text.find_first_not_of(' ');
    text = first == std::string::npos ? ""
                                      : text.substr(first, text.find_last_not_of(' ') + 1 - first);
  };
  drop_spaces();
  if (text.starts_with("t")) text.erase(0, 1), drop_spaces();
  if (text.starts_with("=")) text.erase(0, 1), drop_spaces();
  if (text.ends_with("s")) text.pop_back(), drop_spaces();
  if (text.starts_with("+")) text.erase(0, 1);
  return text;
}

/// One in its last digit: 0.01e2 of 3.57e2.
double last_digit(std::string number) {
  const std::size_t exponent = std::min(number.find_first_of("eE"), number.size());
  const std::size_t last = number.find_last_of("0123456789", exponent);
  for (std::size_t i = 0; i < exponent; ++i)
    if (number[i] >= '0' && number[i] <= '9') number[i] = i == last ? '1' : '0';
  return std::abs(*parsed_number<double>(number));
}

std::optional<PrintedNumber> read(const std::string& number) {
  const auto value = parsed_number<double>(number);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return PrintedNumber{*value, 0.5 * last_digit(number)};
}

std::string neighbours(const std::vector<double>& times, double t) {
  const auto above = std::lower_bound(times.begin(), times.end(), t);
  std::string next;
  if (above != times.begin()) next += fmt::format("{:.9g}", *(above - 1));
  if (above != times.begin() && above != times.end()) next += " and ";
  if (above != times.end()) next += fmt::format("{:.9g}", *above);
  return next;
}

}  // namespace

std::string check_time(const std::string& text) {
  if (read(number_in(text))) return {};
  return fmt::format("expected a time in seconds, as 350 or \"350 s\", got `{}`", text);
}

double stored_time(const std::vector<double>& times, const std::string& text,
                   const std::string& file) {
  const auto printed = read(number_in(text));
  if (!printed) throw InputError("--time: " + check_time(text));
  if (times.empty()) throw InputError(file + ": it has no stored step");
  const double nearest = *std::ranges::min_element(
      times, {}, [&](double time) { return std::abs(time - printed->value); });
  const double rounding = 1e-9 * std::abs(printed->value);
  if (std::abs(nearest - printed->value) <= printed->half_digit + rounding) return nearest;
  throw InputError(fmt::format("{}: it has no stored step at t = {}; next to it are t = {}", file,
                               number_in(text), neighbours(times, printed->value)));
}

}  // namespace gnomon::app
