#include "workbench/shell/grasp_cards.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/develop/hand_pads.h"
#include "core/quality/grasp_quality.h"
#include "core/trial/measures/stability_meter.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

const Eigen::VectorXd& FindPosture(ShellScene& scene, const std::string& posture) {
  const Grasp& grasp = scene.setup().grasp;
  if (posture == "pre") return grasp.q_pre;
  if (posture == "target") return grasp.q_target;
  return scene.course().world().state().q;
}

std::string FormatVector(const Eigen::Vector3d& v, int decimals) {
  return FormatFixed(v.x(), decimals) + ", " + FormatFixed(v.y(), decimals) + ", " +
         FormatFixed(v.z(), decimals);
}

}  // namespace

std::string FormatWrenchSpace(ShellScene& scene) {
  const TrialSetup& setup = scene.setup();
  const GraspInstant instant = StabilityMeter(setup).MakeInstant(scene.course().world());
  QualityRequest request;
  request.contacts = instant.grasp.contacts;
  request.torque_scale =
      request.convention.calc_torque_scale({instant.grasp.radius, setup.object->size});
  const std::vector<std::string> problems = ListProblems(request);
  if (!problems.empty()) return "no wrench space: " + problems.front() + "\n";
  const GraspQuality quality = CalcGraspQuality(request);
  TextTable table({"in the object's frame", "1 N shared by all", "1 N at each contact"});
  for (const TaskForce& task : quality.task_forces) {
    table.AddRow({task.direction, FormatSignificant(task.sum_limited, 3),
                  FormatSignificant(task.each_limited, 3)});
  }
  return fmt::format("epsilon  {}, volume {}, {}force closure, smallest singular value {}\n",
                     FormatFixed(quality.epsilon, 4), FormatSignificant(quality.volume, 3),
                     quality.force_closure ? "" : "no ",
                     FormatSignificant(quality.min_singular_value, 3)) +
         table.Format() + "forces in N, moments in N m; " + quality.description + "\n";
}

std::string FormatPads(ShellScene& scene, const std::string& posture) {
  const Hand& hand = *scene.setup().hand;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, FindPosture(scene, posture));
  std::vector<PadState> pads;
  const PadState* opposing = nullptr;
  pads.reserve(hand.digits.size());
  for (const Digit& digit : hand.digits) {
    pads.push_back(CalcPadState(hand, digit, X_HL));
    if (digit.is_thumb) opposing = &pads.back();
  }
  TextTable table(
      {"digit", "pad at x, y, z [mm]", "faces", "to the thumb's [mm]", "turned against it [deg]"});
  for (size_t d = 0; d < pads.size(); ++d) {
    const bool is_other = opposing && opposing != &pads[d];
    const double opening = is_other ? (pads[d].p_HPad - opposing->p_HPad).norm() : kUnset;
    const double turn =
        is_other ? std::acos(std::clamp(pads[d].nhat_H.dot(opposing->nhat_H), -1.0, 1.0)) : kUnset;
    table.AddRow({hand.digits[d].id, FormatVector(MmFromM(1.0) * pads[d].p_HPad, 1),
                  FormatVector(pads[d].nhat_H, 2), FormatFixed(MmFromM(opening), 1),
                  FormatFixed(DegFromRad(turn), 0)});
  }
  return table.Format() + "in the hand's frame; 180 deg: pad against pad\n";
}

}  // namespace graspbench
