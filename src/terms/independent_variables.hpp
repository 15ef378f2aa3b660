// Values as the independent variables of automatic differentiation.
#pragma once

#include <Eigen/Core>
#include <type_traits>
#include <unsupported/Eigen/AutoDiff>

namespace gnomon {

/// Makes so many independent variables, one after the other; of plain numbers, the values alone.
template <class Scalar>
class IndependentVariables {
public:
  explicit IndependentVariables(Eigen::Index count) : count_(static_cast<int>(count)) {}
  Scalar operator()(double value) {
    if constexpr (std::is_same_v<Scalar, double>)
      return value;
    else
      return {value, count_, at_++};
  }
  /// Row by row.
  template <class Values>
  auto operator()(const Eigen::MatrixBase<Values>& values) {
    Eigen::Matrix<Scalar, Values::RowsAtCompileTime, Values::ColsAtCompileTime, 0,
                  Values::MaxRowsAtCompileTime, Values::MaxColsAtCompileTime>
        result(values.rows(), values.cols());
    for (Eigen::Index k = 0; k < values.rows(); ++k)
      for (Eigen::Index i = 0; i < values.cols(); ++i) result(k, i) = (*this)(values(k, i));
    return result;
  }

private:
  int count_;
  int at_ = 0;
};

}  // namespace gnomon
