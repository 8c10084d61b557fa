#include "core/hand/import/read_foreign_urdf.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/hand/import/checks/joint_limits.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/read_urdf.h"

namespace graspbench {
namespace {

/** Converts a URDF, with repairs. */

class ForeignUrdfReader {
 public:
  ForeignUrdfReader(const Urdf& urdf, std::string file, std::optional<bool> in_degrees,
                    Diagnostics& problems)
      : urdf_(urdf), file_(std::move(file)), in_degrees_(in_degrees), problems_(problems) {}

  ForeignHand Read() {
    JudgeAngles();
    hand_.name = urdf_.name;
    for (const UrdfLink& link : urdf_.links) AddLink(link);
    for (const UrdfJoint& joint : urdf_.joints) AddJoint(joint);
    if (!AreErrorsLocal(hand_, problems_)) return {};
    ResolveMimics(mimics_, "<mimic>", file_, problems_, hand_);
    FixUnlimited(file_, problems_, hand_);
    TellEfforts();
    return std::move(hand_);
  }

 private:
  void AddLink(const UrdfLink& link) {
    ForeignLink& added = hand_.links.emplace_back();
    added.name = link.name;
    added.line = link.line;
    added.told = link.told;
    if (link.inertia) added.inertia = ForeignInertia{*link.inertia};
    for (const UrdfShape& shape : link.visuals) added.visuals.push_back({shape});
    for (const UrdfShape& shape : link.collisions) added.collisions.push_back({shape});
  }

  void AddJoint(const UrdfJoint& urdf) {
    ForeignJoint& joint = hand_.joints.emplace_back();
    joint.name = urdf.name;
    joint.line = urdf.line;
    joint.told = urdf.told;
    joint.parent = urdf.parent;
    joint.child = urdf.child;
    joint.X_PJ = urdf.X_PJ;
    joint.axis = urdf.axis;
    if (urdf.kind == UrdfJoint::Kind::kFixed) return;
    joint.kind = urdf.kind == UrdfJoint::Kind::kPrismatic ? ForeignJoint::Kind::kPrismatic
                                                          : ForeignJoint::Kind::kRevolute;
    AddLimits(urdf, joint);
    if (!urdf.mimic) return;
    mimics_.push_back({static_cast<int>(hand_.joints.size()) - 1, urdf.mimic->line,
                       urdf.mimic->joint, urdf.mimic->multiplier, urdf.mimic->offset});
  }

  void AddLimits(const UrdfJoint& urdf, ForeignJoint& joint) {
    const bool is_continuous = urdf.kind == UrdfJoint::Kind::kContinuous;
    const UrdfLimit limit = urdf.limit.value_or(UrdfLimit{0.0, 0.0, {}, urdf.line});
    const auto warn = [&](int line, const std::string& text) {
      joint.told.push_back(problems_.entries().size());
      problems_.Warn(file_, line, "joint \"" + joint.name + "\"" + text);
    };
    const size_t index = hand_.joints.size() - 1;
    joint.drive.effort = std::max(0.0, limit.effort.value_or(0.0));
    if (limit.effort && !urdf.mimic && *limit.effort <= 0.0) without_effort_.push_back(index);
    const double most_effort = joint.kind == ForeignJoint::Kind::kRevolute ? 200.0 : 5000.0;
    if (joint.drive.effort > most_effort) with_great_effort_.push_back(index);
    StatedLimits stated{"", limit.lower, limit.upper};
    if (!urdf.limit || is_continuous) stated.missing = "<limit>";
    if (std::isnan(limit.lower)) stated.missing = "lower limit to be read";
    if (std::isnan(limit.upper)) stated.missing = "upper limit to be read";
    if (joint.kind == ForeignJoint::Kind::kRevolute) {
      const double largest = std::max(std::abs(stated.lower), std::abs(stated.upper));
      const bool in_degrees = in_degrees_.value_or(largest > kWholeTurn && largest <= 360.0);
      if (in_degrees) {
        stated.lower = RadFromDeg(stated.lower);
        stated.upper = RadFromDeg(stated.upper);
      }
      if (in_degrees && !in_degrees_ && !is_continuous) {
        warn(limit.line,
             ": a limit of " + FormatSignificant(largest, 3) +
                 " would be more than one turn; this joint's limits are taken as degrees "
                 "(--angle says otherwise)");
      }
      const double range = stated.upper - stated.lower;
      if (!in_degrees && !in_degrees_ && !is_continuous && range > kWholeTurn) {
        warn(limit.line,
             ": its limits are " + FormatSignificant(DegFromRad(range), 3) +
                 " deg apart, more than one turn; if they are degrees, say --angle deg");
      }
    }
    const std::string repaired = SetLimits(stated, joint);
    if (is_continuous) {
      joint.no_limits.clear();
      warn(joint.line,
           " is continuous, it turns without end; its limits are taken as half a turn each way");
    } else if (!repaired.empty()) {
      warn(limit.line, repaired);
    }
  }

  /** Decides from the limits beyond a full turn whether the file is in degrees. */
  void JudgeAngles() {
    if (in_degrees_) return;
    int num_beyond = 0, num_within = 0;
    double largest = 0.0;
    for (const UrdfJoint& joint : urdf_.joints) {
      if (joint.kind != UrdfJoint::Kind::kRevolute || !joint.limit) continue;
      const double most =
          std::max({0.0, std::abs(joint.limit->lower), std::abs(joint.limit->upper)});
      num_beyond += most > kWholeTurn;
      num_within += most > 0.0 && most <= kWholeTurn;
      largest = std::max(largest, most);
    }
    if (num_beyond < 2 || num_beyond <= num_within || largest > 360.0) return;
    in_degrees_ = true;
    problems_.Warn(file_, urdf_.line,
                   "limits of " + std::to_string(num_beyond) + " of " +
                       FormatCount(num_beyond + num_within, "joint") +
                       " would be more than one turn, up to " + FormatSignificant(largest, 3) +
                       "; all are taken as degrees, though URDF has radians (--angle says "
                       "otherwise)");
  }

  void TellEfforts() {
    const auto tell = [&](const std::vector<size_t>& indices, const std::string& what) {
      if (indices.empty()) return;
      std::vector<std::string> joints;
      for (const size_t j : indices) {
        joints.push_back(hand_.joints[j].name);
        hand_.joints[j].told.push_back(problems_.entries().size());
      }
      problems_.Warn(file_, 0,
                     "effort of " + FormatCount(static_cast<int64_t>(joints.size()), "joint") +
                         " (" + JoinSome(joints) + ") " + what + "; their drives are guessed");
    };
    tell(without_effort_, "is 0 or less: a drive without torque moves nothing");
    tell(with_great_effort_, "is above 200 N m or 5000 N, more than a finger bears");
  }

  const Urdf& urdf_;
  std::string file_;
  std::optional<bool> in_degrees_;  // unit of joint limits; nullopt: decided per joint
  Diagnostics& problems_;
  ForeignHand hand_;
  std::vector<NamedMimic> mimics_;
  std::vector<size_t> without_effort_, with_great_effort_;  // indices of joints
};

}  // namespace

ForeignHand ReadForeignUrdf(const std::string& text, const std::string& file, Diagnostics& problems,
                            std::optional<bool> in_degrees) {
  const Urdf urdf = ReadUrdf(text, file, {}, problems);
  const bool is_tree = std::all_of(urdf.joints.begin(), urdf.joints.end(), [](const UrdfJoint& j) {
    return std::min(j.parent, j.child) >= 0;
  });
  if (!is_tree) return {};
  return ForeignUrdfReader(urdf, file, in_degrees, problems).Read();
}

}  // namespace graspbench
