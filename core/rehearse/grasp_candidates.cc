#include "core/rehearse/grasp_candidates.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/predict_grasp.h"

namespace graspbench {
namespace {

const double kSameYaw = RadFromDeg(10.0);  ///< smaller differences of angles are ignored
constexpr char kPostureSpace[] = "all-digits";
constexpr double kRound = 0.05;       ///< share of the moments: below it the object is as long as
                                      ///< wide
constexpr double kRiseShare = 0.2;    ///< share of the object's height
constexpr double kLeastRise = 0.006;  ///< [m]
constexpr double kAlongShare = 0.2;   ///< share of the object's length in the rotated axes
constexpr double kMoreOpening = 0.3;  ///< see GraspCandidate::opening
const double kSmallTurn = RadFromDeg(20.0);

/** In (-pi, pi]. */
double Wrap(double angle) { return std::remainder(angle, 2.0 * kPi); }

}  // namespace

bool operator==(const GraspCandidate& a, const GraspCandidate& b) {
  const auto tie = [](const GraspCandidate& c) {
    return std::tie(c.standard, c.approach, c.place.yaw, c.place.rise, c.place.along, c.opening,
                    c.posture);
  };
  return tie(a) == tie(b);
}

std::string Describe(const GraspCandidate& candidate) {
  const char* searched = candidate.posture.empty() ? "" : ", posture searched";
  if (candidate.approach == Approach::kAutomatic) {
    return candidate.standard + ", by rule" + searched;
  }
  const PlaceChange& place = candidate.place;
  std::string text = candidate.standard + ", from " +
                     (candidate.approach == Approach::kSide ? "the side" : "above");
  if (place.yaw != 0.0) {
    text += ", turned by " + FormatFixed(DegFromRad(place.yaw), 0) + " deg";
  }
  if (place.rise != 0.0) {
    text += ", " + FormatFixed(MmFromM(std::abs(place.rise)), 1) +
            (place.rise > 0.0 ? " mm higher" : " mm lower");
  }
  if (place.along != 0.0) {
    text += ", " + FormatFixed(MmFromM(place.along), 1) + " mm along";
  }
  if (candidate.opening > 0.0) {
    text += ", opened by " + FormatFixed(100.0 * candidate.opening, 0) + " %";
  }
  return text + searched;
}

double CalcPrincipalYaw(const GraspObject& object) {
  const Eigen::Matrix3d& I = object.mass_properties.I_OOcm;
  // Of the mass distribution: integrals of x^2 - y^2 and of 2 x y.
  const double difference = I(1, 1) - I(0, 0), mixed = -2.0 * I(0, 1);
  if (std::hypot(difference, mixed) <= kRound * I(2, 2)) return 0.0;
  return 0.5 * std::atan2(mixed, difference);
}

CandidateMaker::CandidateMaker(const Hand& hand, std::vector<Grasp> grasps,
                               const GraspObject& object)
    : hand_(hand), grasps_(std::move(grasps)), object_(object) {}

const Grasp& CandidateMaker::Find(const std::string& id) const {
  const auto found = std::find_if(grasps_.begin(), grasps_.end(),
                                  [&](const Grasp& grasp) { return grasp.id == id; });
  GRASPBENCH_DEMAND(found != grasps_.end(), id);
  return *found;
}

Approach CandidateMaker::FindRuleApproach(const Grasp& grasp) const {
  const Placement placement = CalcPlacement(hand_, FitGrasp(hand_, grasp, object_), object_);
  return std::abs(placement.approach_W.z()) < 0.5 ? Approach::kSide : Approach::kAbove;
}

bool CandidateMaker::MayCome(Approach approach) const {
  return object_.approach == Approach::kAutomatic || object_.approach == approach;
}

Grasp CandidateMaker::Make(const GraspCandidate& candidate) const {
  Grasp grasp = Find(candidate.standard);
  if (candidate.approach == Approach::kAutomatic) {
    grasp = FitGrasp(hand_, grasp, object_);
    grasp.placement = CalcPlacement(hand_, grasp, object_);
  } else {
    grasp.approach = candidate.approach;
    grasp = FitGraspAt(hand_, grasp, object_, candidate.place, candidate.opening);
  }
  grasp.object = object_.id;
  if (candidate.posture.empty()) return grasp;
  return MakePostureSpace(grasp)->MakeGrasp(Eigen::Map<const Eigen::VectorXd>(
      candidate.posture.data(), static_cast<Eigen::Index>(candidate.posture.size())));
}

std::unique_ptr<GraspSpace> CandidateMaker::MakePostureSpace(const Grasp& grasp) const {
  return MakeGraspSpace(kPostureSpace, {hand_, object_, grasp});
}

RandomStream CandidateMaker::MakePostureStream() const {
  return RandomStream(FormatJson({hand_.id, object_.id}), "posture of rehearsal");
}

std::vector<GraspCandidate> CandidateMaker::Sort(const std::vector<GraspCandidate>& candidates,
                                                 bool must_meet) const {
  std::vector<std::pair<GraspRank, GraspCandidate>> ranked;
  for (const GraspCandidate& candidate : candidates) {
    const Grasp grasp = Make(candidate);
    const GraspPrediction prediction = PredictGrasp(hand_, grasp, object_);
    if (must_meet && !(prediction.reaches() && prediction.meets())) continue;
    ranked.emplace_back(RankGrasp(grasp, prediction), candidate);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<GraspCandidate> sorted;
  for (auto& [rank, candidate] : ranked) sorted.push_back(std::move(candidate));
  return sorted;
}

std::vector<GraspCandidate> CandidateMaker::ListByRule() const {
  std::vector<GraspCandidate> candidates;
  for (const Grasp& grasp : grasps_) {
    candidates.push_back({grasp.id, Approach::kAutomatic, {}, 0.0});
  }
  return Sort(candidates, false);
}

std::vector<GraspCandidate> CandidateMaker::ListByApproach() const {
  std::vector<GraspCandidate> candidates;
  for (const Grasp& grasp : grasps_) {
    const Approach other =
        FindRuleApproach(grasp) == Approach::kSide ? Approach::kAbove : Approach::kSide;
    if (MayCome(other)) candidates.push_back({grasp.id, other, {}, 0.0});
  }
  return Sort(candidates, true);
}

std::vector<GraspCandidate> CandidateMaker::ListByYaw() const {
  std::vector<double> yaws = {0.0};  // both approaches were tested there
  const double principal = CalcPrincipalYaw(object_), right = 0.5 * kPi;
  for (const double yaw :
       {principal, principal + right, right, principal + 0.5 * right, principal - 0.5 * right}) {
    const bool is_new = std::none_of(yaws.begin(), yaws.end(), [&](double known) {
      return std::abs(Wrap(yaw - known)) < kSameYaw;
    });
    if (is_new) yaws.push_back(yaw);
  }
  std::vector<GraspCandidate> candidates;
  for (const Grasp& grasp : grasps_) {
    for (const Approach approach : {Approach::kAbove, Approach::kSide}) {
      if (!MayCome(approach)) continue;
      for (size_t i = 1; i < yaws.size(); ++i) {
        candidates.push_back({grasp.id, approach, {yaws[i], 0.0, 0.0}, 0.0});
      }
    }
  }
  return Sort(candidates, true);
}

std::vector<GraspCandidate> CandidateMaker::ListVariations(const GraspCandidate& candidate) const {
  GraspCandidate start = candidate;
  if (start.approach == Approach::kAutomatic) {
    start.approach = FindRuleApproach(Find(candidate.standard));
  }
  const double rise = std::max(kLeastRise, kRiseShare * object_.size.z());
  const double cosine = std::cos(start.place.yaw), sine = std::sin(start.place.yaw);
  Eigen::AlignedBox<double, 1> length;
  for (const Eigen::Vector3d& p : object_.mesh.vertices) {
    length.extend(Eigen::Matrix<double, 1, 1>(cosine * p.x() + sine * p.y()));
  }
  const double along = kAlongShare * length.sizes()[0];
  std::vector<GraspCandidate> varied;
  const auto add = [&](double yaw, double up, double aside, double opening) {
    GraspCandidate one = start;
    one.place.yaw = Wrap(one.place.yaw + yaw);
    one.place.rise += up;
    one.place.along += aside;
    one.opening += opening;
    varied.push_back(one);
  };
  add(0.0, -rise, 0.0, 0.0);
  add(0.0, rise, 0.0, 0.0);
  add(0.0, 0.0, along, 0.0);
  add(0.0, 0.0, -along, 0.0);
  add(0.0, 0.0, 0.0, kMoreOpening);
  add(kPi, 0.0, 0.0, 0.0);
  add(kSmallTurn, 0.0, 0.0, 0.0);
  add(-kSmallTurn, 0.0, 0.0, 0.0);
  return varied;
}

}  // namespace graspbench
