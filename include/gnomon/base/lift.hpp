// Functions of numbers, given by their values and derivatives, as functions of a Scalar that may
// itself carry derivatives (automatic differentiation).
#pragma once

#include <gnomon/base/tensor.hpp>
#include <type_traits>

namespace gnomon {

/// The value of the number, without its derivatives.
template <class Scalar>
double plain(const Scalar& x) {
  if constexpr (std::is_same_v<Scalar, double>)
    return x;
  else
    return x.value();
}

template <int n, class Scalar>
Vector<n> plain(const Vector<n, Scalar>& x) {
  if constexpr (std::is_same_v<Scalar, double>)
    return x;
  else
    return x.unaryExpr([](const Scalar& entry) { return entry.value(); });
}

/// A function of x, given by its value and gradient at x; exact in value and first derivatives.
template <int n, class Scalar>
Scalar lift(double value, const Vector<n>& gradient, const Vector<n, Scalar>& x) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return value;
  } else {
    Scalar result(value);
    for (int i = 0; i < n; ++i) result += gradient[i] * (x[i] - x[i].value());
    return result;
  }
}

/// The same for a vector, with the matrix dvalue/dx.
template <int n, class Scalar>
Vector<n, Scalar> lift(const Vector<n>& value, const Tensor<n>& by_x, const Vector<n, Scalar>& x) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return value;
  } else {
    Vector<n, Scalar> result;
    for (int i = 0; i < n; ++i) result[i] = lift<n, Scalar>(value[i], by_x.row(i).transpose(), x);
    return result;
  }
}

}  // namespace gnomon
