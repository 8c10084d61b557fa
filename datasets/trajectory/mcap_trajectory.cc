#include <foxglove.pb.h>
#include <google/protobuf/descriptor.pb.h>
#include <trial.pb.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/base/version.h"
#include "datasets/session/find_trial.h"
#include "datasets/trajectory/mcap_file.h"
#include "datasets/trajectory/trajectory_form.h"

namespace graspbench {
namespace {

namespace pb = google::protobuf;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kArrowLength = 0.01;  // of a force of 1 N [m]

/** The schema as MCAP wants it: its file and all that this one imports, those first. */
void AddFile(const pb::FileDescriptor& file, std::set<std::string>& known,
             pb::FileDescriptorSet& set) {
  if (!known.insert(file.name()).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) AddFile(*file.dependency(i), known, set);
  file.CopyTo(set.add_file());
}

template <class Message>
uint16_t AddMessageChannel(const std::string& topic, McapFile& file) {
  pb::FileDescriptorSet set;
  std::set<std::string> known;
  AddFile(*Message::descriptor()->file(), known, set);
  const uint16_t schema =
      file.AddSchema(Message::descriptor()->full_name(), "protobuf", set.SerializeAsString());
  return file.AddChannel(schema, topic, "protobuf");
}

uint64_t ToNanoseconds(double time) { return static_cast<uint64_t>(std::llround(time * 1e9)); }

void SetTime(double time, pb::Timestamp& stamp) {
  const uint64_t nanoseconds = ToNanoseconds(time);
  stamp.set_seconds(static_cast<int64_t>(nanoseconds / 1000000000));
  stamp.set_nanos(static_cast<int32_t>(nanoseconds % 1000000000));
}

/** Digits below what any physics means would be most of a compressed file. */
double RoundOff(double value) {
  return std::isfinite(value) ? std::ldexp(std::nearbyint(std::ldexp(value, 32)), -32) : value;
}

template <class Message>
void SetVector(const Vector3d& v, Message& message) {
  message.set_x(RoundOff(v.x()));
  message.set_y(RoundOff(v.y()));
  message.set_z(RoundOff(v.z()));
}

void SetQuaternion(const Quaterniond& q, foxglove::Quaternion& message) {
  message.set_x(RoundOff(q.x()));
  message.set_y(RoundOff(q.y()));
  message.set_z(RoundOff(q.z()));
  message.set_w(RoundOff(q.w()));
}

/** Frames of the scene with their parents; one that stands still is told once, at the start. */
class FrameTree {
 public:
  explicit FrameTree(const TrialTrajectory& trajectory) : hand_(*trajectory.hand) {
    frames_.push_back({"world", "hand"});
    frames_.push_back({"world", "object"});
    for (const HandLink& link : hand_.links) {
      const std::string parent =
          link.parent < 0 ? "hand" : "hand/" + hand_.links[static_cast<size_t>(link.parent)].name;
      frames_.push_back({parent, "hand/" + link.name});
    }
    if (const Arm* arm = FindTracedArm(trajectory.traced)) {
      arm_ = trajectory.traced.arm.get();
      frames_.push_back({"world", "arm"});
      for (const ArmJoint& joint : arm->joints) {
        frames_.push_back({frames_.back().second, "arm/" + joint.name});
      }
    }
    const std::vector<Pose> first = FindPoses(trajectory.traced.trace.front());
    moves_.resize(frames_.size(), false);
    for (const TraceInstant& instant : trajectory.traced.trace) {
      const std::vector<Pose> poses = FindPoses(instant);
      for (size_t i = 0; i < poses.size(); ++i) {
        moves_[i] = moves_[i] || poses[i].matrix() != first[i].matrix();
      }
    }
  }

  foxglove::FrameTransforms Make(const TraceInstant& instant, bool with_still) const {
    foxglove::FrameTransforms message;
    const std::vector<Pose> poses = FindPoses(instant);
    for (size_t i = 0; i < poses.size(); ++i) {
      if (!moves_[i] && !with_still) continue;
      foxglove::FrameTransform& frame = *message.add_transforms();
      SetTime(instant.time, *frame.mutable_timestamp());
      frame.set_parent_frame_id(frames_[i].first);
      frame.set_child_frame_id(frames_[i].second);
      SetVector(poses[i].translation(), *frame.mutable_translation());
      SetQuaternion(Quaterniond(poses[i].linear()).normalized(), *frame.mutable_rotation());
    }
    return message;
  }

 private:
  /** X_W hand and object, X_P of the links in their parents; of the arm alike. */
  std::vector<Pose> FindPoses(const TraceInstant& instant) const {
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, instant.q);
    std::vector<Pose> poses = {instant.X_WH, instant.X_WO};
    for (size_t i = 0; i < X_HL.size(); ++i) {
      const int parent = hand_.links[i].parent;
      const bool is_fixed = parent >= 0 && hand_.links[i].joint < 0;
      poses.push_back(is_fixed     ? hand_.links[i].X_PJ
                      : parent < 0 ? X_HL[i]
                                   : X_HL[static_cast<size_t>(parent)].inverse() * X_HL[i]);
    }
    if (!arm_) return poses;
    const std::vector<Pose> X_BL = CalcArmPoses(*arm_->arm, instant.q_arm);
    poses.push_back(arm_->X_WB);
    for (size_t i = 1; i < X_BL.size(); ++i) poses.push_back(X_BL[i - 1].inverse() * X_BL[i]);
    return poses;
  }

  const Hand& hand_;
  const MountedArm* arm_ = nullptr;
  std::vector<std::pair<std::string, std::string>> frames_;  // parent, child
  std::vector<bool> moves_;
};

messages::JointSample MakeJoints(const TrialTrajectory& trajectory, const TraceInstant& instant) {
  const Hand& hand = *trajectory.hand;
  messages::JointSample message;
  SetTime(instant.time, *message.mutable_timestamp());
  for (int j = 0; j < hand.num_joints(); ++j) {
    messages::JointSample::Joint& joint = *message.add_joints();
    joint.set_name(hand.joints[static_cast<size_t>(j)].name);
    joint.set_position(RoundOff(instant.q[j]));
    const bool has_drive = hand.joints[static_cast<size_t>(j)].coupled_to < 0;
    if (has_drive && instant.q_asked.size() > 0) joint.set_asked(RoundOff(instant.q_asked[j]));
  }
  const Arm* arm = FindTracedArm(trajectory.traced);
  for (int j = 0; arm && j < arm->num_joints(); ++j) {
    messages::JointSample::Joint& joint = *message.add_joints();
    joint.set_name("arm/" + arm->joints[static_cast<size_t>(j)].name);
    joint.set_position(RoundOff(instant.q_arm[j]));
  }
  return message;
}

messages::ContactSample MakeContacts(const Hand& hand, const TraceInstant& instant) {
  messages::ContactSample message;
  SetTime(instant.time, *message.mutable_timestamp());
  message.set_grip_force(RoundOff(instant.grip_force));
  message.set_table_force(RoundOff(instant.table_force));
  for (const HandContact& touch : instant.contacts) {
    messages::ContactSample::Contact& contact = *message.add_contacts();
    const int digit = hand.FindDigitOfLink(touch.link);
    contact.set_link(hand.links[static_cast<size_t>(touch.link)].name);
    contact.set_digit(digit < 0 ? "palm" : hand.digits[static_cast<size_t>(digit)].id);
    SetVector(touch.p_WC, *contact.mutable_position());
    SetVector(touch.nhat_W, *contact.mutable_normal());
    contact.set_normal_force(RoundOff(touch.normal_force));
    SetVector(touch.friction_W, *contact.mutable_friction());
    contact.set_spin_moment(RoundOff(touch.spin_moment));
    contact.set_slip_speed(RoundOff(touch.slip_speed));
    contact.set_mu(touch.mu);
    contact.set_state(DescribeState(touch));
  }
  return message;
}

messages::TaxelLayout MakeTaxelLayout(const Hand& hand, double time) {
  messages::TaxelLayout message;
  SetTime(time, *message.mutable_timestamp());
  for (const TrajectoryTaxel& taxel : ListTaxels(hand)) {
    messages::TaxelLayout::Element& element = *message.add_elements();
    const TactileElement& of = taxel.element();
    const int digit = hand.FindDigitOfLink(of.link);
    element.set_link(hand.links[static_cast<size_t>(of.link)].name);
    element.set_digit(digit < 0 ? "palm" : hand.digits[static_cast<size_t>(digit)].id);
    SetVector(of.p_LE, *element.mutable_position());
    SetVector(of.normal_L, *element.mutable_normal());
    element.set_area(of.area);
  }
  return message;
}

messages::TaxelSample MakeTaxels(const TrialTrajectory& trajectory, const TraceInstant& instant) {
  messages::TaxelSample message;
  SetTime(instant.time, *message.mutable_timestamp());
  for (const double force : CalcTaxelForces(trajectory, instant)) {
    message.add_forces(RoundOff(force));
  }
  return message;
}

/** The forces of the hand on the object as arrows; red where a contact slides. */
foxglove::SceneUpdate MakeArrows(const TraceInstant& instant) {
  foxglove::SceneUpdate message;
  foxglove::SceneEntity& entity = *message.add_entities();
  SetTime(instant.time, *entity.mutable_timestamp());
  entity.set_frame_id("world");
  entity.set_id("contact forces");
  for (const HandContact& contact : instant.contacts) {
    const Vector3d force = contact.normal_force * contact.nhat_W + contact.friction_W;
    foxglove::ArrowPrimitive& arrow = *entity.add_arrows();
    SetVector(contact.p_WC, *arrow.mutable_pose()->mutable_position());
    SetQuaternion(Quaterniond::FromTwoVectors(Vector3d::UnitX(), force),
                  *arrow.mutable_pose()->mutable_orientation());
    arrow.set_shaft_length(RoundOff(kArrowLength * force.norm()));
    arrow.set_shaft_diameter(0.002);
    arrow.set_head_length(0.006);
    arrow.set_head_diameter(0.004);
    foxglove::Color& colour = *arrow.mutable_color();
    colour.set_r(IsSliding(contact) ? 0.8 : 0.1);
    colour.set_g(IsSliding(contact) ? 0.1 : 0.6);
    colour.set_b(0.1);
    colour.set_a(1.0);
  }
  return message;
}

messages::Event MakeEvent(const TrajectoryEvent& event) {
  messages::Event message;
  SetTime(event.time, *message.mutable_timestamp());
  message.set_kind(event.kind);
  message.set_phase(event.phase);
  message.set_digit(event.digit);
  message.set_link(event.link);
  if (std::isfinite(event.impulse)) message.set_impulse(event.impulse);
  return message;
}

std::map<std::string, std::string> DescribeOrigin(const TrialTrajectory& trajectory) {
  const PlannedTrial& planned = trajectory.planned;
  const TrialResult& result = trajectory.traced.result;
  return {{"trial_id", planned.id},
          {"trial", NameTrial(planned)},
          {"hand", planned.hand},
          {"object", planned.object},
          {"grasp", planned.grasp},
          {"outcome", NameOf(result.outcome)},
          {"reason", result.reason},
          {"closure_start_s", FormatJson(JsonNumber(trajectory.traced.closure_start))},
          {"rate_hz", FormatJson(JsonNumber(trajectory.rate))},
          {"record_sha256", trajectory.record_sha256},
          {"program", "graspbench " + std::string(program_version())},
          {"physics_version", std::to_string(kPhysicsVersion)}};
}

std::vector<TrajectoryFile> MakeMcapFiles(const TrialTrajectory& trajectory) {
  McapFile file("graspbench " + std::string(program_version()));
  const uint16_t frames = AddMessageChannel<foxglove::FrameTransforms>("/tf", file);
  const uint16_t joints = AddMessageChannel<messages::JointSample>("/joints", file);
  const uint16_t contacts = AddMessageChannel<messages::ContactSample>("/contacts", file);
  const uint16_t arrows = AddMessageChannel<foxglove::SceneUpdate>("/contact_forces", file);
  const uint16_t events = AddMessageChannel<messages::Event>("/events", file);
  const bool has_skin = trajectory.hand->skin != nullptr;
  const uint16_t layout =
      has_skin ? AddMessageChannel<messages::TaxelLayout>("/taxel_layout", file) : uint16_t{0};
  const uint16_t taxels =
      has_skin ? AddMessageChannel<messages::TaxelSample>("/taxels", file) : uint16_t{0};
  file.AddMetadata("trial", DescribeOrigin(trajectory));
  const FrameTree tree(trajectory);
  const std::vector<TrajectoryEvent> list = ListTrajectoryEvents(trajectory);
  auto event = list.begin();
  const auto add_events_until = [&](double time) {
    for (; event != list.end() && event->time <= time; ++event) {
      file.AddMessage(events, ToNanoseconds(event->time), MakeEvent(*event).SerializeAsString());
    }
  };
  for (const TraceInstant& instant : trajectory.traced.trace) {
    add_events_until(instant.time);
    const uint64_t time = ToNanoseconds(instant.time);
    const bool is_first = &instant == &trajectory.traced.trace.front();
    file.AddMessage(frames, time, tree.Make(instant, is_first).SerializeAsString());
    file.AddMessage(joints, time, MakeJoints(trajectory, instant).SerializeAsString());
    file.AddMessage(contacts, time, MakeContacts(*trajectory.hand, instant).SerializeAsString());
    if (has_skin && is_first) {
      file.AddMessage(layout, time,
                      MakeTaxelLayout(*trajectory.hand, instant.time).SerializeAsString());
    }
    if (has_skin) {
      file.AddMessage(taxels, time, MakeTaxels(trajectory, instant).SerializeAsString());
    }
    file.AddMessage(arrows, time, MakeArrows(instant).SerializeAsString());
  }
  add_events_until(std::numeric_limits<double>::infinity());
  return {{".mcap", file.Finish()}};
}

}  // namespace

TrajectoryForm MakeMcapTrajectoryForm() {
  return {"mcap", "messages in time to 10 digits, for Foxglove, Lichtblick and Rerun",
          &MakeMcapFiles, nullptr};
}

}  // namespace graspbench
