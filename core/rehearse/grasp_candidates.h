#pragma once
/** @file
Candidate grasps of a hand for one object, in the order predicted by geometry (RankGrasp,
core/grasp/predict_grasp.h). The rounds of candidates become increasingly costly:

    rule        each standard grasp as placed by the rule
    approach    each from the other side: from above if the rule comes from the side, and vice versa
    yaw         rotated about the vertical into the object's principal axes, the other axis of its
                bounding box, and half way between; only those that reach and meet the object by
                geometry
    variation   of those that held longest so far: height, offset along the axis, opening of the
                pre-grasp, half a turn, small rotations
    posture     of the one that held most: target angles of all grasping digits
                (core/optimise/grasp_space.h, "all-digits"), if a search is requested

The principal axes are those of the object's inertia about the vertical. Proposed by graspbench; the
thesis (4.2) tests every grasp on every object and selects the best, without placement. */

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
  /** kAutomatic: placed by the rule (FitGrasp); `place` and `opening` are ignored. */
  Approach approach = Approach::kAutomatic;
  PlaceChange place;
  double opening = 0.0;  ///< of the pre-grasp: additional share of the path from target to
                         ///< pre-grasp
  /** Coordinates in the space "all-digits" [rad]; empty: the target of the standard grasp. */
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

/** Compares by value, bit by bit. */
bool operator==(const GraspCandidate& a, const GraspCandidate& b);
/** Formats "g3, from above, turned by 90 deg, 12.0 mm lower"; by the rule: "g3, by rule". */
std::string Describe(const GraspCandidate& candidate);

inline Json ToJson(Approach approach) { return RowOf(kApproaches, approach).name; }
inline void ReadJson(const Json& json, Approach& approach) {
  approach = RowFromName(kApproaches, json.get<std::string>(), "approach").value;
}

/** Angle from O's x axis to the longer principal axis of the object seen from above, in
(-pi/2, pi/2] [rad]; 0 if the object is as long as wide. */
double CalcPrincipalYaw(const GraspObject& object);

/** Makes candidates from the standard grasps of a hand for one object. */
class CandidateMaker {
 public:
  /** @param grasps  standard grasps, without placement; their order decides between equals.
  @pre the object has its distance field; the references outlive this object. */
  CandidateMaker(const Hand& hand, std::vector<Grasp> grasps, const GraspObject& object);

  std::vector<GraspCandidate> ListByRule() const;
  std::vector<GraspCandidate> ListByApproach() const;
  std::vector<GraspCandidate> ListByYaw() const;
  /** Variations of one candidate; not sorted, most promising kind of change first. */
  std::vector<GraspCandidate> ListVariations(const GraspCandidate& candidate) const;

  /** Search space around a grasp of Make. @pre this object and the grasp outlive it. */
  std::unique_ptr<GraspSpace> MakePostureSpace(const Grasp& grasp) const;
  /** Random numbers of a posture search, seeded by hand and object. */
  RandomStream MakePostureStream() const;

  /** Returns the grasp with its placement, for this object only, with the id of the standard
  grasp. */
  Grasp Make(const GraspCandidate& candidate) const;

 private:
  const Grasp& Find(const std::string& id) const;
  /** Approach that the rule chooses. */
  Approach FindRuleApproach(const Grasp& grasp) const;
  bool MayCome(Approach approach) const;
  /** Sorts candidates, best first.
  @param must_meet  drops those that do not reach the object or do not meet it. */
  std::vector<GraspCandidate> Sort(const std::vector<GraspCandidate>& candidates,
                                   bool must_meet) const;

  const Hand& hand_;
  std::vector<Grasp> grasps_;
  const GraspObject& object_;
};

}  // namespace graspbench
