// A formula that a scene gives as text, such as a wear rate "k * p * v": parsed once, then
// evaluated with its exact gradient at every contact node in every iteration.
//
// Numbers (2, 0.5, 2e-9), names, + - * / ^ and parentheses, with the precedence of mathematics:
// -x^2 is -(x^2), and x^y^z is x^(y^z). Functions: exp log sqrt sin cos abs pow(a, b), min and max
// of two or more, if(condition, a, b); a table is called as a function of one argument. A condition
// compares by < <= > >= and joins comparisons by `and` and `or`, of which `and` binds tighter.
#pragma once

#include <cstddef>
#include <gnomon/base/error.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// An expression, or what it is built upon, is wrong. The message begins with the place in the
/// expression, "column 7: ", or "line 2, column 7: " in a text of several lines.
struct ExpressionError : InputError {
  using InputError::InputError;
};

/// The piecewise linear function through given points, constant beyond its ends. Two points at one
/// x are a jump. Breakpoints are the places where its slope changes, or where it jumps; pieces are
/// numbered from the left, and there is one more piece than there are breakpoints.
class PiecewiseLinear {
public:
  /// Throws ExpressionError unless there are as many x as y, at least one, all finite, with x
  /// ascending, at most two of them equal, and finite slopes.
  PiecewiseLinear(const std::vector<double>& x, const std::vector<double>& y);

  std::span<const double> breakpoints() const { return breakpoints_; }  ///< ascending
  std::size_t piece_at(double x) const;  ///< a breakpoint belongs to the piece on its left
  /// The value of one piece, continued beyond its ends.
  double value(std::size_t piece, double x) const {
    return pieces_[piece].y + pieces_[piece].slope * (x - pieces_[piece].x);
  }
  double slope(std::size_t piece) const { return pieces_[piece].slope; }
  bool jumps_at(std::size_t breakpoint) const {
    return value(breakpoint, breakpoints_[breakpoint]) !=
           value(breakpoint + 1, breakpoints_[breakpoint]);
  }

private:
  struct Piece {
    double x, y, slope;  // through the point (x, y)
  };
  std::vector<double> breakpoints_;
  std::vector<Piece> pieces_;
};

/// What an expression may refer to. Names are distinct, consist of letters, digits and underscores,
/// do not begin with a digit, and are none of the language's own (exp, and, ...).
struct ExpressionNames {
  std::vector<std::string> variables;  ///< at most 64, in the order of the x of Expression::value
  std::map<std::string, double> constants = {{"pi", std::numbers::pi}};  ///< finite
  std::map<std::string, PiecewiseLinear> tables;
};

/// "variables p, v; constants k; functions exp, ...", for messages.
std::string describe_expression_names(const ExpressionNames& names);

/// Whether the name has a meaning already: as one of `names`, or in the language.
bool is_taken_in_expressions(const std::string& name, const ExpressionNames& names);

struct ExpressionProgram;

/// A parsed expression. It never changes, may be used by several threads at once, and copies share
/// what they hold.
///
/// It is smooth except at its kinks. Each kink has a switching function of x, and is *active* where
/// that is <= 0:
///
///     max(a, b)   b - a     active: a           min(a, b)   a - b     active: a
///     abs(a)      -a        active: a           table(a)    a - x_i   active: left of x_i
///     a <= b      a - b     active: true        a < b       b - a     active: false
///
/// and >=, > likewise with a and b exchanged. max and min of n arguments have n - 1 kinks, where a
/// stands for the result so far. Parts without variables are evaluated when the text is parsed, and
/// have none. Kinks are numbered as the parts they belong to end in the text, the breakpoints of a
/// table from the left.
///
/// `branches` of the functions below chooses a smooth branch of the expression: one entry per kink,
/// not 0 where it is active. That branch is evaluated wherever x lies, continued beyond its border:
/// max(a, b) stays with a, a table stays on its piece. (If the entries of a table contradict each
/// other, the number of active ones determines the piece.)
/// An empty span means the branch that x lies in.
/// No exception is thrown where the expression has no finite value or derivative, as log(-1) or the
/// slope of sqrt at 0: the results are then not finite.
/// An undefined comparison makes the value NaN.
class Expression {
public:
  /// Most bytes of a text.
  static constexpr std::size_t max_length = 1000;
  /// Most levels of parentheses, calls, signs and exponents within each other.
  static constexpr int max_nesting = 64;

  /// Throws ExpressionError for a text that is not an expression of these names, and for names that
  /// are not as described at ExpressionNames.
  Expression(std::string text, const ExpressionNames& names);

  const std::string& text() const { return text_; }
  std::size_t variables() const { return variables_; }  ///< number of names that it was parsed with
  /// Whether the variable occurs in it, also in a condition.
  bool depends_on(std::size_t variable) const;
  std::size_t kinks() const;
  /// Whether the variable occurs in the switching function of the kink.
  bool kink_depends_on(std::size_t kink, std::size_t variable) const;
  /// Whether the value may jump at the kink: at a comparison, and where a table jumps.
  bool kink_may_jump(std::size_t kink) const;

  double value(std::span<const double> x, std::span<const char> branches = {}) const;

  /// Also writes the derivatives with respect to all variables; they are 0 for those that do not
  /// occur.
  double value_and_gradient(std::span<const double> x, std::span<double> gradient,
                            std::span<const char> branches = {}) const;

  /// Writes the switching function of every kink, evaluated on the given branch and so smooth
  /// across 0. A kink that does not influence the value, because it is in a part of `if`, `and` or
  /// `or` that is not taken, may have no finite switching function. Its value is then 1, or -1 if
  /// it is active in `branches`, so that it does not appear to switch.
  void switching(std::span<const double> x, std::span<double> values,
                 std::span<const char> branches = {}) const;

private:
  std::string text_;
  std::size_t variables_;
  std::shared_ptr<const ExpressionProgram> program_;
};

}  // namespace gnomon
