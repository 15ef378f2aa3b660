// What a careful engineer would look up in a state to believe it: facts, which the room `checks`
// judges.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// A resultant force on the bodies; of a cycle its mean over the phases. In 2D per unit of
/// thickness, z is zero; of a body of revolution that of the whole circumference along the axis,
/// (0, z).
struct ResultantForce {
  std::string name;               ///< "loads", "supports", "springs", "contact", "friction"
  std::array<double, 3> force{};  ///< [force]
  /// About the origin of the coordinates, in 2D its z [force * length]; zero of bodies of
  /// revolution and of parts of a symmetric body.
  std::array<double, 3> torque{};
};

/// A point of the boundary.
struct BoundaryPoint {
  std::array<double, 3> position{};  ///< initial [length]
  double depth = 0;                  ///< how deep it lies in the counter-body [length]
};

/// The largest pressure, where a node beside an open one has it.
struct EdgePressure {
  std::array<double, 3> position{};  ///< of the node, initial [length]
  double pressure = 0;               ///< [stress]
  double inside = 0;                 ///< the largest of nodes among closed ones [stress]
};

/// Of a motion that reverses: how far the bodies slide, and how far friction drags a touching node
/// with it, both from one end of the cycle to the other.
struct ElasticDrag {
  double stroke = 0;  ///< the shortest of the touching nodes' partner [length]
  double drag = 0;    ///< the largest tangential displacement that reverses with it [length]
};

/// Of a body that turns about a fixed point and moves away from there: by which part the contact
/// slides too fast.
struct MovedAxis {
  std::string body;  ///< its name
  double way = 0;    ///< of the contact with it [length]
  double part = 0;   ///< negative: too slowly
};

/// Over a cycle: sliding by the places of bodies leaves out how contact, loads and friction move
/// them on from phase to phase, as it turns a rocker.
struct UnseenSliding {
  std::string body;  ///< its name; empty: the counter-body, or the body that it slides on
  double part = 0;   ///< of the sliding speed: mean of the sizes
};

/// Of a body that has small strains, which take its rotation for strains.
struct BodyTurn {
  std::string body;  ///< its name; empty where there is one
  double angle = 0;  ///< [rad]
};

/// What wear as a gap leaves out: the change of pressures, at the same depth of wear, if the mesh
/// had followed it. Root mean square over the nodes that are closed with their neighbours, as a
/// part of their pressures.
struct GapError {
  double pressure = 0;
  std::string failure{};  ///< why it is not known; empty: it is
};

struct Examination {
  /// They add up to zero within the tolerance of the equilibrium.
  std::vector<ResultantForce> forces;
  /// Of each support that has a name, "support_1": parts of "supports" and "springs".
  std::vector<ResultantForce> reactions{};
  /// Of pairs, instead of "contact" and "friction" in `forces`: all that one body exerts on the
  /// other, by name "\"pad\" on \"rail\"". Not of bodies whose contact is also that of other pairs.
  std::vector<ResultantForce> pairs{};
  /// The part of the loads that acts on nodes that supports hold, in the directions that they hold:
  /// it does nothing; as a part of all loads.
  double idle_load = 0;
  /// The deepest of the boundary that has no contact and lies inside the counter-body.
  std::optional<BoundaryPoint> intrusion{};
  std::optional<ElasticDrag> drag{};
  /// After the start, at which pressures are in equilibrium whatever the steps are.
  std::optional<EdgePressure> edge{};
  /// How deep the unloaded bodies lie in a counter-body that cannot give way, before it approaches
  /// [length].
  double overlap = 0;
  double pressed = 0;  ///< the same when it has approached, as at t = 0
  /// Contact forces, added up without regard to their directions, by what presses a free
  /// counter-body; 0 where none is free, one turns, or loads press on the bodies.
  double wedging = 0;
  /// The part of the wear at nodes whose shape is held, so that it is lost; of the body that loses
  /// most.
  double lost_wear = 0;
  /// Beside a rigid counter-body, the part of the contact force on boundary that does not wear.
  double unworn_force = 0;
  /// A surface whose contact reaches an end of the mesh of its track; empty: none.
  std::string touched_end{};
  /// Weight of what has worn off, which an acceleration still moves, as a part of the contact
  /// force.
  double stale_weight = 0;
  std::optional<BodyTurn> body_turn{};            ///< the largest one
  std::optional<MovedAxis> moved_axis{};          ///< of pairs, the one with the largest part
  std::optional<UnseenSliding> unseen_sliding{};  ///< likewise
  std::optional<GapError> gap_error{};            ///< where wear is a gap
  /// Where friction may stick: of CycleOfSlip.
  double stick_area = 0, slip_area = 0;
  bool rubs = true;  ///< there, friction changes over the cycle
  /// There, if friction changes over the cycle: width_of_slip_zone().
  std::optional<int> slip_zone{};
  /// There, the largest angle of a counter-body that a moment turns [rad].
  double turn = 0;
  /// In rolling: PowerOfRolling::upwind by dissipated, and without_friction.
  double upwind_power = 0, without_friction = 0;
  /// Of similar bodies, PowerOfRolling::dissipated by driving_power(); 1 where there is neither.
  double power_by_driving = 1;
  /// In rolling, the largest depth of a track by the radius whose circumference its path is.
  double worn_radius = 0;
  double deformation = 0;  ///< typical displacement: much less of a depth does not count [length]
  double force = 0;        ///< typical: a small part of it is rounding
  double size = 0;         ///< of the bodies, from corner to corner [length]
  bool touches = true;     ///< some contact node, in some phase
  double gap = 0;          ///< the smallest of a contact node [length]
  int few_nodes = 0;       ///< that touch, in some phase; 0 where they are more, or all of them
};

}  // namespace gnomon
