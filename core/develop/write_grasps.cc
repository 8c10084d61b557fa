#include "core/develop/write_grasps.h"

#include <fmt/core.h>

#include "core/base/units.h"
#include "core/develop/development_warnings.h"
#include "core/grasp/grasp_yaml.h"
#include "core/grasp/placement.h"

namespace graspbench {
namespace {

constexpr char kSection[] = "grasps:";
constexpr char kNone[] = "# grasps: none";
constexpr char kMade[] = "# Standard grasps made by graspbench hand develop";

bool StartsWith(const std::string& text, const std::string& head) {
  return text.compare(0, head.size(), head) == 0;
}

/** Whether a line belongs to the section of a top-level key. */
bool IsInside(const std::string& line) {
  return line.empty() || line[0] == ' ' || line[0] == '\t' || line[0] == '}';
}

}  // namespace

std::string DescribeDevelopment(const Hand& hand, const DevelopedGrasp& developed) {
  const PostureAim& aim = developed.proposed.aim;
  const std::string pads_apart =
      fmt::format("{:.0f}", MmFromM(CalcPreGraspWidth(hand, developed.grasp)));
  if (developed.proposed.is_own) {
    return fmt::format(
        "Begun from the grasp that the hand had under this name. Simulation: score {:.2f}, after "
        "changes {:.2f} (above 1: all held), pads now {} mm apart. Held {} of {} shapes not met "
        "before.",
        developed.proposed_score, developed.score, pads_apart, CountSuccesses(developed.check),
        developed.check.size());
  }
  return fmt::format(
      "Geometry: {} {:.0f} mm apart that face each other, {:.0f} mm below the palm, the thumb "
      "going {:.0f} % of the way, a grip of {:.0f} N. Simulation: score {:.2f}, after changes "
      "{:.2f} (above 1: all held), pads now {} mm apart. Held {} of {} shapes not met before.",
      aim.by_side ? "sides" : "pads", MmFromM(aim.opening), MmFromM(aim.reach),
      100.0 * aim.thumb_share, developed.proposed.grip, developed.proposed_score, developed.score,
      pads_apart, CountSuccesses(developed.check), developed.check.size());
}

std::string FormatGrasps(const Hand& hand, const DevelopConfig& config,
                         const std::vector<DevelopedGrasp>& developed) {
  std::string text = fmt::format(
      "{}: proposed by geometry, chosen and\n# improved in simulation on shapes made for it, none "
      "of them an object of the catalogue. Again:\n#   graspbench hand develop {}{} --budget {} "
      "--seed {} --out DIR\n# Degrees (of slides millimetres), driven joints of each digit from "
      "base to tip.\n{}\n",
      kMade, hand.id, config.any_coupling ? " --any-coupling" : "", config.budget, config.seed,
      kSection);
  for (const DevelopedGrasp& one : developed) {
    const Grasp& grasp = one.grasp;
    std::string digits;
    for (const std::string& id : grasp.digits) digits += (digits.empty() ? "" : ", ") + id;
    text += "  " + grasp.id + ":\n";
    for (const std::string& warning : ListDevelopmentWarnings(hand, one)) {
      text += "    # WARNING: " + warning + "\n";
    }
    text += fmt::format("    digits: [{}]\n    tilt_deg: {:.{}f}\n", digits, DegFromRad(grasp.tilt),
                        kGraspDecimals);
    if (grasp.palm_may_touch) text += "    palm_may_touch: true\n";
    if (grasp.seeks_palm) text += "    seeks_palm: true\n";
    if (grasp.palm_gap != kPalmGap) {
      text += fmt::format("    palm_gap_m: {:.{}f}\n", grasp.palm_gap, kGraspDecimals + 3);
    }
    if (!one.check.empty()) {
      text +=
          fmt::format("    held_share: {:.2f}\n", static_cast<double>(CountSuccesses(one.check)) /
                                                      static_cast<double>(one.check.size()));
    }
    if (const int num_held = CountSuccesses(one.check); num_held > 0) {
      text += fmt::format("    as_called_share: {:.2f}\n",
                          static_cast<double>(CountAsCalled(one.check)) / num_held);
    }
    text += "    pre_deg: " + FormatPosture(hand, grasp.q_pre, kGraspDecimals) +
            "\n    target_deg: " + FormatPosture(hand, grasp.q_target, kGraspDecimals) +
            "\n    changed: >-\n      " + DescribeDevelopment(hand, one) + "\n";
  }
  return text;
}

std::string ReplaceGrasps(const std::string& hand_yaml, const std::string& section) {
  std::string kept;
  bool is_inside = false, is_comment_of_ours = false;
  for (size_t start = 0; start < hand_yaml.size();) {
    const size_t end = std::min(hand_yaml.find('\n', start), hand_yaml.size());
    const std::string line = hand_yaml.substr(start, end - start);
    start = end + 1;
    is_comment_of_ours = StartsWith(line, kMade) || (is_comment_of_ours && StartsWith(line, "#"));
    is_inside = StartsWith(line, kSection) || (is_inside && IsInside(line));
    if (is_inside || is_comment_of_ours || StartsWith(line, kNone)) continue;
    kept += line + "\n";
  }
  while (kept.size() > 1 && kept[kept.size() - 1] == '\n' && kept[kept.size() - 2] == '\n') {
    kept.pop_back();
  }
  return kept + "\n" + section;
}

}  // namespace graspbench
