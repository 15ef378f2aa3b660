// The three-dimensional scenes on meshes that a test can afford.
#pragma once

#include "support/problem_run.hpp"

namespace gnomon::testing {

inline constexpr const char* ball_small = "ball_on_flat/small_deformation.toml";
inline constexpr const char* ball_finite = "ball_on_flat/finite_deformation.toml";
inline constexpr const char* groove_small = "ball_on_half_space/small_deformation.toml";
inline constexpr const char* groove_finite = "ball_on_half_space/finite_deformation.toml";

/// across, height and layers of the quarter of the ball.
inline Overrides ball_mesh(int across, int height, int layers) {
  return {"mesh.elements=[" + std::to_string(across) + ", " + std::to_string(height) + ", " +
          std::to_string(layers) + "]"};
}

/// Along, across and in depth of the block; `size` at the origin in all directions [mm].
inline Overrides block_mesh(int along, int across, int depth, double size) {
  const std::string s = std::to_string(size);
  return {"mesh.elements=[" + std::to_string(along) + ", " + std::to_string(across) + ", " +
              std::to_string(depth) + "]",
          "mesh.size=[" + s + ", " + s + ", " + s + "]", "mesh.fine=[0.0, 0.0, 0.0]"};
}

inline Overrides operator+(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace gnomon::testing
