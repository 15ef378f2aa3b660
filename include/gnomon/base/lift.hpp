// Functions of numbers, given by their values and derivatives, as functions of Scalars that may
// themselves carry derivatives (automatic differentiation).
#pragma once

#include <gnomon/base/tensor.hpp>
#include <type_traits>

namespace gnomon {

/// The value of a number, or of those of a vector, without derivatives.
template <class T>
auto plain(const T& x) {
  if constexpr (std::is_same_v<T, double>)
    return x;
  else if constexpr (requires { x.derivatives(); })
    return x.value();
  else
    return x.unaryExpr([](const typename T::Scalar& entry) { return plain(entry); }).eval();
}

/// A function of the vector z, a number or a vector, given by its value and derivative at z; exact
/// in value and first derivatives. Entries of z that carry no derivatives are constants.
template <class Value, class Derivative, class Z>
auto lift(const Value& value, const Derivative& by_z, const Z& z) {
  using Scalar = typename Z::Scalar;
  if constexpr (std::is_same_v<Scalar, double>) {
    return value;
  } else if constexpr (std::is_same_v<Value, double>) {
    Scalar result(value);
    for (Eigen::Index i = 0; i < z.size(); ++i)
      if (z[i].derivatives().size() > 0) result += by_z[i] * (z[i] - z[i].value());
    return result;
  } else {
    Eigen::Matrix<Scalar, Value::RowsAtCompileTime, 1> result;
    for (Eigen::Index i = 0; i < value.size(); ++i) result[i] = lift(value[i], by_z.row(i), z);
    return result;
  }
}

}  // namespace gnomon
