#pragma once
/** @file
Joint angles of a data glove as fingertips, through the kinematics of a hand model (core/hand): the
model's bones stand for the person's, so that places are as good as the two hands are alike.

A glove does not know where the hand is. A reach needs the pose of its root in the laboratory, too,
from a tracker on the back of the hand:

    glove:
      hand: shadow                     # a model's id, or a folder with hand.urdf and hand.yaml
      angle_unit: deg                  # deg (default) or rad
      joints: {FFJ3: index_mcp, ..}    # of the model, each with its column; others are straight
      base: [x, y, z]                  # columns: the model's root in the laboratory, in `unit`
      base_quaternion: [qx, qy, qz, qw]  # columns: laboratory from root

Points are `<digit>_tip`, the middle of the digit's pad, and wrist, the root. */

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace graspbench {

struct Hand;

struct GloveMapping {
  std::string hand;
  bool is_in_degrees = true;
  std::vector<std::pair<std::string, std::string>> joints;  ///< of the model, column
  std::vector<std::string> base;                            ///< columns x, y, z
  std::vector<std::string> quaternion;                      ///< columns x, y, z, w

  bool IsNamed() const { return !hand.empty(); }
  /** All of them: the joints', then base, then quaternion. */
  std::vector<std::string> ListColumns() const;
};

class GloveModel {
 public:
  /** @throws Error as LoadHand; Error(kFormat) for a joint that the model lacks or that another one
  moves, with those it has. */
  explicit GloveModel(const GloveMapping& mapping);

  /** In the order of CalcPoints. */
  const std::vector<std::string>& labels() const { return labels_; }
  /** "12 of 24 joints are named, the others straight or coupled" and whose bones they are. */
  std::string Describe() const;
  /** @param cells  numbers of GloveMapping::ListColumns().
  @returns points in the laboratory [unit of the base]; empty when a number is missing or the
  quaternion is none. @param metres_per_unit  of the base. */
  std::vector<Eigen::Vector3d> CalcPoints(const std::vector<double>& cells,
                                          double metres_per_unit) const;

 private:
  std::shared_ptr<const Hand> hand_;
  std::vector<int> joints_;
  double factor_ = 1.0;  // [rad] of an angle
  std::vector<std::string> labels_;
};

}  // namespace graspbench
