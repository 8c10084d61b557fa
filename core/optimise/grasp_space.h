#pragma once
/** @file
What of a grasp step 2 may change, as coordinates of a search:

    thumb       target angles of the opposing digit (Roethling 2007), the default
    hand-pose   where the hand stands: shifted by 17.5 mm at most along each axis of the world,
                turned by 25 deg at most about the object's centre (placement.h, MovePlacement)
    all-digits  target angles of all grasping digits
    synergy     target angles of all grasping digits along the principal components of the hand's
                own standard postures (Santello, Flanders and Soechting 1998 for people's hands)
    closing     when each grasping digit begins to close, up to 0.22 s after the first

Every coordinate counts in radians, so that one step fits all: a shift of 40 mm counts as one. No
target angle leaves its joint's limits or goes farther than 25 deg from the start's; coupled joints
follow; a hand that was moved keeps the rules of placing; pre-grasps stay. The start is the point of
the grasp as it is, to the bit. All but the thumb is proposed by graspbench. */

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
  std::string name;         ///< of a joint, or what is moved: "hand_x"
  const char* unit;         ///< of values for people and tables: "rad" or "m"
  double per_radian = 1.0;  ///< of that unit, to a radian of the search
};

class GraspSpace {
 public:
  virtual ~GraspSpace() = default;
  const SearchSpace& box() const { return box_; }
  const std::vector<GraspCoordinate>& coordinates() const { return coordinates_; }
  /** The start with the coordinates changed. @pre as many as there are. */
  virtual Grasp MakeGrasp(const Eigen::VectorXd& genome) const = 0;

 protected:
  void AddCoordinate(const GraspCoordinate& coordinate, double lower, double start, double upper);

 private:
  SearchSpace box_;
  std::vector<GraspCoordinate> coordinates_;
};

/** What a space is made from; the references must outlive it. */
struct GraspSpaceStart {
  const Hand& hand;
  const GraspObject& object;
  const Grasp& grasp;  ///< brings its placement
};

/** A space by its name. */
struct GraspSpaceRow {
  const char* name;   ///< in files and options
  const char* words;  ///< "the thumb's target angles"
  std::unique_ptr<GraspSpace> (*make)(const GraspSpaceStart& start);
};

/** The first of all. */
inline constexpr char kThumbSpace[] = "thumb";

/** "thumb", "hand-pose", ...: all. */
const std::vector<std::string>& ListGraspSpaces();
/** @throws Error(kNotFound) with suggestions. */
const GraspSpaceRow& FindGraspSpace(const std::string& name);
/** @throws Error(kNotFound); Error(kUnsupported) for synergies of a hand with too few postures. */
std::unique_ptr<GraspSpace> MakeGraspSpace(const std::string& name, const GraspSpaceStart& start);

}  // namespace graspbench
