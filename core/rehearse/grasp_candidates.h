#pragma once
/** @file
Grasps that a hand might try on one object, in the order of geometric promise (RankGrasp,
core/grasp/predict_grasp.h). Rounds of candidates, each dearer than the one before:

    rule        each standard grasp as the rule places it
    approach    each from the other side: from above where the rule comes from the side, and back
    yaw         turned about the vertical into the object's principal axes, its bounding box's other
                axis, and half way between; only those that reach the object and meet it by geometry
    variation   of what held longest so far: height, offset along the axis, opening of the
                pre-grasp, a turn by half a circle, small turns
    posture     of what held most: target angles of all grasping digits (core/optimise/grasp_space.h,
                "all-digits"), where a search is asked for

The principal axes are those of the object's inertia about the vertical. Proposed by graspbench; the
thesis (4.2) tries every grasp on every object and takes the best, without placement. */

#include <memory>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/grasp/placement.h"
#include "core/grasp/standard_grasp.h"
#include "core/optimise/grasp_space.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

struct GraspCandidate {
  std::string standard;  ///< id of the standard grasp
  /** kAutomatic: as the rule places it (FitGrasp), and nothing else is said. */
  Approach approach = Approach::kAutomatic;
  PlaceChange place;
  double opening = 0.0;  ///< of the pre-grasp, share of the way from target to pre-grasp once more
  /** Coordinates of the space "all-digits" [rad]; empty: the target of the standard grasp. */
  std::vector<double> posture = {};

  template <class V>
  static void ListFields(V&& field) {
    using C = GraspCandidate;
    field("grasp", &C::standard);
    field("approach", &C::approach);
    field("yaw_rad", &C::place, &PlaceChange::yaw);
    field("rise_m", &C::place, &PlaceChange::rise);
    field("along_m", &C::place, &PlaceChange::along);
    field("opening", &C::opening);
    field("posture_rad", &C::posture);
  }
};

/** By value, to the bit. */
bool operator==(const GraspCandidate& a, const GraspCandidate& b);
/** "g3, from above, turned by 90 deg, 12.0 mm lower"; by the rule: "g3, by rule". */
std::string Describe(const GraspCandidate& candidate);

inline Json ToJson(Approach approach) { return RowOf(kApproaches, approach).name; }
inline void ReadJson(const Json& json, Approach& approach) {
  approach = RowFromName(kApproaches, json.get<std::string>(), "approach").value;
}

/** The angle from O's x to the longer principal axis of the object seen from above, in
(-pi/2, pi/2] [rad]; 0 for what is as long as wide. */
double CalcPrincipalYaw(const GraspObject& object);

/** What hands can do with an object: the standard grasps of a hand, in the object's order. */
class CandidateMaker {
 public:
  /** @param grasps  standard grasps, without placement, in the order in which equals come.
  @pre the object has its distance field; all outlive this. */
  CandidateMaker(const Hand& hand, std::vector<Grasp> grasps, const GraspObject& object);

  std::vector<GraspCandidate> ListByRule() const;
  std::vector<GraspCandidate> ListByApproach() const;
  std::vector<GraspCandidate> ListByYaw() const;
  /** Of one candidate; not sorted, most promising kind of change first. */
  std::vector<GraspCandidate> ListVariations(const GraspCandidate& candidate) const;

  /** From a grasp of Make. @pre this and the grasp outlive it. */
  std::unique_ptr<GraspSpace> MakePostureSpace(const Grasp& grasp) const;
  /** Named by hand and object: of the search of a posture. */
  RandomStream MakePostureStream() const;

  /** The grasp with its placement, for this object alone; its id is that of the standard grasp. */
  Grasp Make(const GraspCandidate& candidate) const;

 private:
  const Grasp& Find(const std::string& id) const;
  /** The side from which the rule comes. */
  Approach FindRuleApproach(const Grasp& grasp) const;
  bool MayCome(Approach approach) const;
  /** Best first.
  @param must_meet  leaves out what does not reach the object or meet it. */
  std::vector<GraspCandidate> Sort(const std::vector<GraspCandidate>& candidates,
                                   bool must_meet) const;

  const Hand& hand_;
  std::vector<Grasp> grasps_;
  const GraspObject& object_;
};

}  // namespace graspbench
