// Runs the programs of expressions: forwards for values and switching functions, and backwards for
// the gradient, which takes about as long as the value for any number of variables.

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/untrapped_arithmetic.hpp"
#include "expressions/expression_program.hpp"

namespace gnomon {

namespace {

/// The results of one evaluation, by slot; on the stack, not initialised beyond the slots that the
/// program needs.
struct Workspace {
  std::array<double, Expression::max_length> value;
  std::array<std::uint32_t, Expression::max_length> choice;  // alternative or piece taken
};

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

struct IgnoreSwitching {
  static constexpr bool wants_all = false;
  void operator()(std::size_t, double, bool) {}
};

/// Runs every instruction, also those of parts that are not taken.
struct WriteSwitching {
  static constexpr bool wants_all = true;
  std::span<const char> branches;
  std::span<double> values;
  void operator()(std::size_t kink, double value, bool taken) {
    if (!taken && !std::isfinite(value)) value = !branches.empty() && branches[kink] ? -1 : 1;
    values[kink] = value;
  }
};

template <class Switching>
class ForwardRun {
public:
  ForwardRun(const ExpressionProgram& program, std::span<const double> x,
             std::span<const char> branches, Workspace& work, Switching switching = {})
      : program_(program), branches_(branches), work_(work), switching_(switching) {
    assert(branches.empty() || branches.size() == program.kinks.size());
    auto slot = std::copy(program.constants.begin(), program.constants.end(), work.value.begin());
    for (const std::size_t variable : program.variables) {
      assert(variable < x.size());
      *slot++ = x[variable];
    }
  }

  double operator()();

private:
  double result_of(const Instruction& in);

  /// Whether the kink is active.
  bool active(std::size_t kink, double switching) {
    switching_(kink, switching, at_ >= taken_from_);
    return branches_.empty() ? switching <= 0 : branches_[kink] != 0;
  }
  bool undefined(double switching) const { return branches_.empty() && std::isnan(switching); }

  double first_or_second(const Instruction& instruction, double first, double second,
                         double switching) {
    const bool is_first = active(instruction.kink, switching);
    work_.choice[at_] = is_first;
    if (undefined(switching)) return no_value;
    return is_first ? first : second;
  }

  double compare(const Instruction& instruction, double switching, bool if_active) {
    const bool result = active(instruction.kink, switching) == if_active;
    return undefined(switching) ? no_value : result;
  }

  double look_up(const Instruction& instruction, double x) {
    const PiecewiseLinear& table = program_.tables[instruction.b];
    const auto breakpoints = table.breakpoints();
    if constexpr (Switching::wants_all)
      for (std::size_t i = 0; i < breakpoints.size(); ++i)
        active(instruction.kink + i, x - breakpoints[i]);
    std::size_t piece = 0;
    if (branches_.empty())
      piece = table.piece_at(x);
    else
      for (const char is_left : branches_.subspan(instruction.kink, breakpoints.size()))
        piece += is_left == 0;
    work_.choice[at_] = static_cast<std::uint32_t>(piece);
    return table.value(piece, x);
  }

  /// Continues at that instruction, or notes that the instructions before it are not taken.
  void skip_to(std::size_t target) {
    if constexpr (Switching::wants_all)
      taken_from_ = std::max(taken_from_, target);
    else
      at_ = target - 1;
  }

  const ExpressionProgram& program_;
  std::span<const char> branches_;
  Workspace& work_;
  Switching switching_;
  std::size_t at_ = 0;          // instruction
  std::size_t taken_from_ = 0;  // instructions before are not taken
};

template <class Switching>
double ForwardRun<Switching>::operator()() {
  const std::size_t first = program_.first_result(), count = program_.instructions.size();
  for (at_ = 0; at_ < count; ++at_) {
    const std::size_t slot = first + at_;  // at_ may move on
    work_.value[slot] = result_of(program_.instructions[at_]);
  }
  return work_.value[program_.result];
}

template <class Switching>
double ForwardRun<Switching>::result_of(const Instruction& in) {
  const auto& value = work_.value;
  const double a = value[in.a];
  switch (in.operation) {
    case Operation::add:
      return a + value[in.b];
    case Operation::subtract:
      return a - value[in.b];
    case Operation::multiply:
      return a * value[in.b];
    case Operation::divide:
      return a / value[in.b];
    case Operation::negate:
      return -a;
    case Operation::power:
    case Operation::constant_power:
      return std::pow(a, value[in.b]);
    case Operation::exponential:
      return std::exp(a);
    case Operation::logarithm:
      return std::log(a);
    case Operation::square_root:
      return std::sqrt(a);
    case Operation::sine:
      return std::sin(a);
    case Operation::cosine:
      return std::cos(a);
    case Operation::absolute:
      return first_or_second(in, a, -a, -a);
    case Operation::maximum:
      return first_or_second(in, a, value[in.b], value[in.b] - a);
    case Operation::minimum:
      return first_or_second(in, a, value[in.b], a - value[in.b]);
    case Operation::table:
      return look_up(in, a);
    case Operation::at_most:
      return compare(in, a - value[in.b], true);
    case Operation::below:
      return compare(in, value[in.b] - a, false);
    case Operation::both:  // b need not have a value where a decides
      return a == 1 ? value[in.b] : a;
    case Operation::either:
      return a == 0 ? value[in.b] : a;
    case Operation::skip_if_false:
      if (a == 0) skip_to(in.b);
      return 0;
    case Operation::skip_if_true:
      if (a == 1) skip_to(in.b);
      return 0;
    case Operation::select:
      work_.choice[at_] = a == 1;
      return std::isnan(a) ? a : a == 1 ? value[in.b] : value[in.c];
  }
  return no_value;
}

/// d(a^b)/db.
double power_by_exponent(double a, double b, double power) {
  if (a == 0 && b > 0) return 0;  // the limit from above
  return power * std::log(a);
}

/// d(a^b)/da.
double power_by_base(double a, double b) {
  return b == 0 ? 0 : b * std::pow(a, b - 1);
}

/// What an instruction adds to the adjoints of its operands a, b and c, which are the derivatives
/// of the expression with respect to them. `own`: the adjoint of its result.
std::array<double, 3> shares_of(const ExpressionProgram& program, const Instruction& in,
                                const Workspace& work, std::size_t at, double own) {
  const double result = work.value[program.first_result() + at];
  const double a = work.value[in.a];
  const auto b = [&] { return work.value[in.b]; };
  const std::uint32_t choice = work.choice[at];
  switch (in.operation) {
    case Operation::add:
      return {own, own};
    case Operation::subtract:
      return {own, -own};
    case Operation::multiply:
      return {own * b(), own * a};
    case Operation::divide:
      return {own / b(), -own * result / b()};
    case Operation::negate:
      return {-own};
    case Operation::power:
      return {own * power_by_base(a, b()), own * power_by_exponent(a, b(), result)};
    case Operation::constant_power:
      return {own * power_by_base(a, b())};
    case Operation::exponential:
      return {own * result};
    case Operation::logarithm:
      return {own / a};
    case Operation::square_root:
      return {own / (2 * result)};
    case Operation::sine:
      return {own * std::cos(a)};
    case Operation::cosine:
      return {-own * std::sin(a)};
    case Operation::absolute:
      return {choice ? own : -own};
    case Operation::maximum:
    case Operation::minimum:
      return {choice ? own : 0, choice ? 0 : own};
    case Operation::table:
      return {own * program.tables[in.b].slope(choice)};
    case Operation::select:
      return {0, choice ? own : 0, choice ? 0 : own};
    default:
      return {};  // conditions have no derivatives
  }
}

}  // namespace

double evaluate(const ExpressionProgram& program, std::span<const double> x,
                std::span<const char> branches) {
  Workspace work;
  return ForwardRun<IgnoreSwitching>(program, x, branches, work)();
}

double evaluate_with_gradient(const ExpressionProgram& program, std::span<const double> x,
                              std::span<const char> branches, std::span<double> gradient) {
  Workspace work;
  const double value = ForwardRun<IgnoreSwitching>(program, x, branches, work)();
  std::array<double, Expression::max_length> adjoint;
  std::fill_n(adjoint.begin(), program.slots(), 0.0);
  adjoint[program.result] = 1;
  const std::size_t first = program.first_result();
  for (std::size_t i = program.instructions.size(); i-- > 0;) {
    // A part without influence may have an infinite derivative, or may not have been evaluated.
    if (adjoint[first + i] == 0) continue;
    const Instruction& in = program.instructions[i];
    const std::array<double, 3> shares = shares_of(program, in, work, i, adjoint[first + i]);
    for (std::size_t k = 0; k < operands_of(in.operation); ++k)
      adjoint[std::array{in.a, in.b, in.c}[k]] += shares[k];
  }
  std::fill(gradient.begin(), gradient.end(), 0.0);
  for (std::size_t i = 0; i < program.variables.size(); ++i)
    gradient[program.variables[i]] = adjoint[program.constants.size() + i];
  return value;
}

void evaluate_switching(const ExpressionProgram& program, std::span<const double> x,
                        std::span<const char> branches, std::span<double> values) {
  assert(values.size() == program.kinks.size());
  std::optional<UntrappedArithmetic> untrapped;  // for parts that are evaluated but not taken
  if (program.skips) untrapped.emplace();
  Workspace work;
  ForwardRun<WriteSwitching>(program, x, branches, work, {branches, values})();
}

}  // namespace gnomon
