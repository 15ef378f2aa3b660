#include <gnomon/terms/sliding.hpp>

namespace gnomon {

template <int dim>
StreamingVelocityDerivative<dim>::StreamingVelocityDerivative(const ContactPatch<dim>& patch,
                                                              const PatchNodal<dim>& X,
                                                              const PatchNodal<dim>& x,
                                                              const Vector<dim>& streaming) {
  for (std::size_t p = 0; p < patch.nodes.size(); ++p) by_X[p].setZero(), by_x[p].setZero();
  for (const auto& corner : patch.corners) {
    const double weight = corner.initial_area / patch.initial_area;
    const auto T = corner_edges<dim, double>(corner, X);
    const auto t = corner_edges<dim, double>(corner, x);
    const Eigen::Matrix<double, dim - 1, dim - 1> G = (T.transpose() * T).inverse();
    const Eigen::Matrix<double, dim - 1, 1> c = G * (T.transpose() * streaming);
    const Vector<dim> off = streaming - T * c;  // the part that is not along the facet
    const Eigen::Matrix<double, dim, dim - 1> t_G = t * G;
    for (int j = 1; j < dim; ++j) {
      // dc = -G T' dT_j c_j + G e_j (dT_j . off)
      const Tensor<dim> by_edge =
          weight * (t_G.col(j - 1) * off.transpose() - c[j - 1] * t_G * T.transpose());
      by_X[corner.nodes[j]] += by_edge;
      by_X[corner.nodes[0]] -= by_edge;
      by_x[corner.nodes[j]] += weight * c[j - 1] * Tensor<dim>::Identity();
      by_x[corner.nodes[0]] -= weight * c[j - 1] * Tensor<dim>::Identity();
    }
  }
}

template struct StreamingVelocityDerivative<2>;
template struct StreamingVelocityDerivative<3>;

}  // namespace gnomon
