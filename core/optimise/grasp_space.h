#pragma once
/** @file
Degrees of freedom of a grasp that step 2 may change, as coordinates of a search:

    thumb       target angles of the opposing digit (Roethling 2007), the default
    hand-pose   pose of the hand: shifted by at most 17.5 mm along each axis of the world, rotated
                by at most 25 deg about the object's centre (placement.h, MovePlacement)
    all-digits  target angles of all grasping digits
    synergy     target angles of all grasping digits along the principal components of the hand's
                own standard postures (cf. Santello, Flanders and Soechting 1998 for human hands)
    closing     start of closing of each grasping digit, up to 0.22 s after the first

Every coordinate is measured in radians, so that one step size fits all: a shift of 40 mm counts as
one radian. Target angles stay within the joint limits and within 25 deg of the start's. Coupled
joints follow, a hand that was moved obeys the rules of placement, and pre-grasps stay unchanged.
The start point reproduces the grasp bit by bit. All spaces but `thumb` are proposed by
graspbench. */

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/optimise/methods/search.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

struct GraspCoordinate {
  std::string name;         ///< name of a joint, or of the moved quantity: "hand_x"
  const char* unit;         ///< unit in reports and tables: "rad" or "m"
  double per_radian = 1.0;  ///< size of a radian of the search, in that unit
};

class GraspSpace {
 public:
  virtual ~GraspSpace() = default;
  const SearchSpace& box() const { return box_; }
  const std::vector<GraspCoordinate>& coordinates() const { return coordinates_; }
  /** The start with these coordinates. @pre `genome` has as many entries as there are. */
  virtual Grasp MakeGrasp(const Eigen::VectorXd& genome) const = 0;

 protected:
  void AddCoordinate(const GraspCoordinate& coordinate, double lower, double start, double upper);

 private:
  SearchSpace box_;
  std::vector<GraspCoordinate> coordinates_;
};

/** Input of a search space; the references must outlive it. */
struct GraspSpaceStart {
  const Hand& hand;
  const GraspObject& object;
  const Grasp& grasp;  ///< has a placement
};

/** A search space with its name. */
struct GraspSpaceRow {
  const char* name;   ///< in files and options
  const char* words;  ///< "the thumb's target angles"
  std::unique_ptr<GraspSpace> (*make)(const GraspSpaceStart& start);
};

/** Name of the first space, the default. */
inline constexpr char kThumbSpace[] = "thumb";

/** Names of all spaces: "thumb", "hand-pose", ... */
const std::vector<std::string>& ListGraspSpaces();
/** @throws Error(kNotFound) with suggestions. */
const GraspSpaceRow& FindGraspSpace(const std::string& name);
/** @throws Error(kNotFound); Error(kUnsupported) for synergies of a hand with too few postures. */
std::unique_ptr<GraspSpace> MakeGraspSpace(const std::string& name, const GraspSpaceStart& start);

}  // namespace graspbench
