#include "datasets/plan/fitted_grasps.h"

#include <fmt/core.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/files/kept.h"
#include "core/base/hash.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

constexpr char kFitKind[] = "gbfit001";

/** Gathers values as bytes. */
class ByteWriter {
 public:
  template <class... Values>
  void Add(const Values&... values) {
    (AddOne(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class Number>
  std::enable_if_t<std::is_arithmetic_v<Number> || std::is_enum_v<Number>> AddOne(Number number) {
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  template <class Numbers>
  void AddOne(const Eigen::PlainObjectBase<Numbers>& numbers) {
    Add(numbers.size());
    bytes_.append(reinterpret_cast<const char*>(numbers.data()),
                  static_cast<size_t>(numbers.size()) * sizeof(double));
  }
  void AddOne(const Pose& pose) { Add(pose.matrix()); }
  void AddOne(const std::string& text) {
    Add(text.size());
    bytes_ += text;
  }
  template <class Item>
  void AddOne(const std::vector<Item>& items) {
    Add(items.size());
    for (const Item& item : items) Add(item);
  }

  std::string bytes_;
};

/** Of what places a hand's links; its masses, drives and looks change no fit. */
void AddHand(const Hand& hand, ByteWriter& out) {
  out.Add(hand.content_hash, hand.palm_link, hand.coupling, hand.fixed_coupling_ratio,
          hand.joint_accuracy, hand.slide_accuracy, hand.p_HCentre, hand.palm_normal);
  for (const HandLink& link : hand.links) out.Add(link.parent, link.joint, link.X_PJ, link.axis);
  for (const HandJoint& joint : hand.joints) {
    out.Add(joint.link, joint.is_prismatic, joint.lower, joint.upper, joint.coupled_to,
            joint.is_mimic, joint.mimic_ratio, joint.mimic_offset);
  }
  for (const Digit& digit : hand.digits) {
    out.Add(digit.id, digit.is_thumb, digit.links, digit.distal_link, digit.p_LTip, digit.p_LPad);
  }
  for (const ContactSphere& sphere : hand.contact_spheres) {
    out.Add(sphere.link, sphere.p_LS, sphere.radius);
  }
}

void AddGrasp(const Grasp& grasp, ByteWriter& out) {
  out.Add(grasp.type, grasp.approach_distance, grasp.alpha, grasp.tilt, grasp.q_pre, grasp.q_target,
          grasp.digits, grasp.palm_may_touch, grasp.palm_gap, grasp.seeks_palm, grasp.approach,
          grasp.object, grasp.placement.has_value());
  if (!grasp.placement) return;
  out.Add(grasp.placement->X_WH, grasp.placement->approach_W, grasp.placement->closing_at_contact,
          grasp.placement->reaches_object);
}

void AddObject(const GraspObject& object, ByteWriter& out) {
  out.Add(CalcMeshHash(object.mesh), object.content_hash, object.size,
          object.mass_properties.p_OOcm, object.surface.friction_static, object.approach);
}

uint64_t CalcKey(const Hand& hand, const Grasp& grasp, const GraspObject& object) {
  ByteWriter out;
  out.Add(std::string(program_sources()));
  AddHand(hand, out);
  AddGrasp(grasp, out);
  AddObject(object, out);
  return CalcHash64(out.bytes());
}

/** All that a fit and its prediction say, in one order. */
template <class Visitor>
void VisitFit(FittedGrasp& fitted, Visitor&& visit) {
  visit(fitted.grasp.approach);
  for (double& q : fitted.grasp.q_pre) visit(q);
  GraspPrediction& prediction = fitted.prediction;
  visit(prediction.reach_miss);
  visit(prediction.room);
  visit(prediction.needed_room);
  visit(prediction.num_digits);
  visit(prediction.num_touching);
  visit(prediction.thumb_touches);
  visit(prediction.opposes);
  visit(prediction.lifts);
  visit(prediction.contact_height);
  visit(prediction.palm_is_near);
}

std::string FormatFit(FittedGrasp fitted) {
  std::string bytes;
  VisitFit(fitted, [&](auto value) {
    const auto number = static_cast<double>(value);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  });
  return bytes;
}

/** Nothing when these are not the numbers of a fit of this grasp. */
std::optional<FittedGrasp> ParseFit(const std::string& bytes, const Grasp& grasp) {
  constexpr double kLargest = 1e6;  // of any of them, in SI units
  FittedGrasp fitted = {grasp, {}};
  size_t at = 0;
  bool are_sound = true;
  VisitFit(fitted, [&](auto& value) {
    double number = kUnset;
    if (at + sizeof number <= bytes.size()) std::memcpy(&number, bytes.data() + at, sizeof number);
    at += sizeof number;
    if (std::abs(number) < kLargest) {
      value = static_cast<std::decay_t<decltype(value)>>(number);
    } else {
      are_sound = false;
    }
  });
  if (!are_sound || at != bytes.size()) return std::nullopt;
  return fitted;
}

FittedGrasp LoadOrFit(const Hand& hand, const Grasp& grasp,
                      const std::shared_ptr<const GraspObject>& object) {
  const uint64_t key = CalcKey(hand, grasp, *object);
  const std::filesystem::path path = FindCacheRoot() / "fits" / fmt::format("{:016x}", key);
  if (const auto kept = ReadKept(path, kFitKind, key)) {
    if (std::optional<FittedGrasp> fitted = ParseFit(*kept, grasp)) return std::move(*fitted);
  }
  const std::shared_ptr<const GraspObject> complete = CompleteObject(object);
  FittedGrasp fitted = {FitGrasp(hand, grasp, *complete), {}};
  fitted.prediction = PredictGrasp(hand, fitted.grasp, *complete);
  Keep(path, kFitKind, key, FormatFit(fitted));
  return fitted;
}

}  // namespace

const FittedGrasp& FittedGrasps::Find(const std::shared_ptr<const Hand>& hand, const Grasp& grasp,
                                      const std::shared_ptr<const GraspObject>& object) {
  const Key key = {hand, object, grasp.id};
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (const auto found = fitted_.find(key); found != fitted_.end()) return found->second;
  }
  FittedGrasp fitted = LoadOrFit(*hand, grasp, object);
  const std::lock_guard<std::mutex> lock(mutex_);
  return fitted_.emplace(key, std::move(fitted)).first->second;
}

}  // namespace graspbench
