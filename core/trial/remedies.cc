#include "core/trial/remedies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"

namespace graspbench {
namespace {

constexpr double kPlaceboShift = 0.0002;      // [m]
const double kPlaceboTurn = RadFromDeg(0.2);  // [rad]
constexpr double kHeightChange = 0.008;       // [m]
constexpr size_t kNumFinalists = 3;
constexpr char kGraspPrefix[] = "grasp-";
constexpr char kFrictionPrefix[] = "friction-x";
constexpr const char* kFrictionFactors[] = {"1.1", "1.25", "1.5", "2"};

/** A remedy with the words for it. */
struct RemedyRow {
  const char* id;
  const char* words;
  bool is_usable;  ///< by a user; the others only explain
};
constexpr RemedyRow kRemedies[] = {
    {"grip-x2", "twice the grip", true},
    {"grip-x4", "four times the grip", true},
    {"firm", "a firm grip (--preset firm)", true},
    {"regulated", "a regulated grip (--preset people)", true},
    {"together", "digits that touch together", true},
    {"slower", "closing at half the speed", true},
    {"higher", "the hand 8 mm higher", true},
    {"lower", "the hand 8 mm lower", true},
    {"no-offset", "no offset of the object", false},
    {"no-joint-error", "no joint error", false},
    {"half-mass", "half the mass", false},
};

bool HasPrefix(const std::string& id, const char* prefix) { return id.rfind(prefix, 0) == 0; }

bool IsPosture(const TrialSetup& setup) {
  return setup.strategy.grip == RowOf(kGripModes, GripMode::kPosture).name;
}

bool IsApplicable(const RemedyRow& row, const FailedTrial& failed) {
  const std::string id = row.id;
  if (id == "grip-x2" || id == "grip-x4" || id == "firm") return !IsPosture(failed.setup);
  if (id == "regulated") return IsPosture(failed.setup);
  if (id == "together") {
    return failed.result.contacts.size() > 1 &&
           std::none_of(failed.result.contacts.begin(), failed.result.contacts.end(),
                        [](const DigitContact& contact) { return std::isnan(contact.time); });
  }
  return true;
}

void ScaleGrip(double factor, StrategyConfig& strategy) {
  if (strategy.grip == RowOf(kGripModes, GripMode::kMargin).name) strategy.grip_margin *= factor;
  strategy.grip_force *= factor;
}

void TouchTogether(const FailedTrial& failed, TrialSetup& setup) {
  double last = 0.0;
  for (const DigitContact& contact : failed.result.contacts) last = std::max(last, contact.time);
  setup.lateness.resize(setup.hand->digits.size(), 0.0);
  for (const DigitContact& contact : failed.result.contacts) {
    for (size_t digit = 0; digit < setup.hand->digits.size(); ++digit) {
      if (setup.hand->digits[digit].id != contact.digit.str()) continue;
      setup.lateness[digit] += last - contact.time;
    }
  }
}

void RaiseHand(double height, TrialSetup& setup) {
  setup.grasp.placement = CalcPlacement(*setup.hand, setup.grasp, *setup.object);
  setup.grasp.placement = MovePlacement(*setup.hand, setup.grasp, *setup.object, {0.0, 0.0, height},
                                        Eigen::Vector3d::Zero());
}

void ChangeObject(double mass, double friction, TrialSetup& setup) {
  auto object = std::make_shared<GraspObject>(*setup.object);
  object->mass_properties.mass *= mass;
  object->mass_properties.I_OOcm *= mass;
  object->surface.friction_static *= friction;
  object->surface.friction_dynamic *= friction;
  setup.object = object;
}

bool Holds(TrialRunner& runner, const TrialSetup& setup) {
  return IsSuccess(runner.Run(setup).outcome);
}

/** Runs remedies of one failed trial. */
class RemedyTrials {
 public:
  RemedyTrials(TrialRunner& runner, const FailedTrial& failed) : runner_(runner), failed_(failed) {}

  Explanation Find();

 private:
  bool HoldsWith(const std::string& id, const TrialDraw& draw);
  void RunOn(int num_draws, RemedyResult& remedy);
  void AddFriction();

  TrialRunner& runner_;
  const FailedTrial& failed_;
  Explanation found_;
};

bool RemedyTrials::HoldsWith(const std::string& id, const TrialDraw& draw) {
  TrialSetup setup = failed_.setup;
  setup.draw = draw;
  setup = ApplyRemedy(id, failed_, setup);
  if (setup.object == failed_.setup.object) return Holds(runner_, setup);
  TrialRunner own(setup.hand, setup.object);
  return Holds(own, setup);
}

/** On fresh draws that it has not run on, up to so many. */
void RemedyTrials::RunOn(int num_draws, RemedyResult& remedy) {
  for (; remedy.num_draws < num_draws; ++remedy.num_draws) {
    const auto draw = static_cast<size_t>(remedy.num_draws);
    const bool holds = HoldsWith(remedy.id, failed_.fresh[draw]);
    remedy.num_mended += holds && !found_.held[draw];
    remedy.num_broken += !holds && found_.held[draw];
  }
}

/** The least factor that holds. */
void RemedyTrials::AddFriction() {
  for (const char* factor : kFrictionFactors) {
    const std::string id = std::string(kFrictionPrefix) + factor;
    if (!HoldsWith(id, failed_.setup.draw)) continue;
    found_.remedies.push_back({id, true});
    return;
  }
}

Explanation RemedyTrials::Find() {
  GRASPBENCH_DEMAND(failed_.fresh.size() == kNumFreshDraws, std::to_string(failed_.fresh.size()));
  const TrialDraw& draw = failed_.setup.draw;
  TrialDraw beside = draw;
  beside.offset_x += kPlaceboShift;
  beside.offset_yaw += kPlaceboTurn;
  found_.is_on_edge = HoldsWith("", beside);
  for (const TrialDraw& fresh : failed_.fresh) found_.held.push_back(HoldsWith("", fresh));

  std::vector<std::string> usable, explaining;
  for (const RemedyRow& row : kRemedies) {
    if (IsApplicable(row, failed_)) (row.is_usable ? usable : explaining).push_back(row.id);
  }
  for (const Grasp& grasp : failed_.grasps) usable.push_back(kGraspPrefix + grasp.id);
  for (const std::string& id : usable) {
    found_.remedies.push_back({id, HoldsWith(id, draw)});
    RunOn(kNumFirstDraws, found_.remedies.back());
  }
  std::vector<int> gains;
  for (const RemedyResult& remedy : found_.remedies) gains.push_back(remedy.net_gain());
  std::sort(gains.rbegin(), gains.rend());
  const int least = gains.empty() ? 0 : gains[std::min(kNumFinalists, gains.size()) - 1];
  for (RemedyResult& remedy : found_.remedies) {
    if (remedy.net_gain() >= std::max(least, 1)) RunOn(kNumFreshDraws, remedy);
  }
  AddFriction();
  for (const std::string& id : explaining) found_.remedies.push_back({id, HoldsWith(id, draw)});
  return std::move(found_);
}

std::string FormatShare(int num, int num_all) { return fmt::format("{} of {}", num, num_all); }

std::string DescribeBest(const Explanation& explanation, const RemedyResult& best) {
  const int held = explanation.num_held() + best.net_gain();
  return fmt::format("{} holds {} fresh draws (mends {}, breaks {}){}", NameRemedy(best.id),
                     FormatShare(held, kNumFreshDraws), best.num_mended, best.num_broken,
                     best.holds ? "" : ", though not this one");
}

}  // namespace

std::string NameRemedy(const std::string& id) {
  if (HasPrefix(id, kGraspPrefix)) return "grasp " + id.substr(sizeof(kGraspPrefix) - 1);
  if (HasPrefix(id, kFrictionPrefix)) {
    return "friction times " + id.substr(sizeof(kFrictionPrefix) - 1);
  }
  for (const RemedyRow& row : kRemedies) {
    if (id == row.id) return row.words;
  }
  return id;  // of another version
}

int Explanation::num_held() const {
  return static_cast<int>(std::count(held.begin(), held.end(), 1));
}

const RemedyResult* Explanation::FindBest(bool is_grasp) const {
  const RemedyResult* best = nullptr;
  for (const RemedyResult& remedy : remedies) {
    if (remedy.num_draws < kNumFreshDraws || IsAnotherGrasp(remedy) != is_grasp) continue;
    if (remedy.net_gain() < kLeastNetGain) continue;
    if (!best || remedy.net_gain() > best->net_gain()) best = &remedy;
  }
  return best;
}

bool IsAnotherGrasp(const RemedyResult& remedy) { return HasPrefix(remedy.id, kGraspPrefix); }

TrialSetup ApplyRemedy(const std::string& id, const FailedTrial& failed, TrialSetup setup) {
  if (HasPrefix(id, kGraspPrefix)) {
    for (const Grasp& grasp : failed.grasps) {
      if (kGraspPrefix + grasp.id == id) setup.grasp = grasp;
    }
    setup.sight_grasps.clear();
    setup.sight.reset();
    return setup;
  }
  if (HasPrefix(id, kFrictionPrefix)) {
    ChangeObject(1.0, std::stod(id.substr(sizeof(kFrictionPrefix) - 1)), setup);
  } else if (id == "grip-x2") {
    ScaleGrip(2.0, setup.strategy);
  } else if (id == "grip-x4") {
    ScaleGrip(4.0, setup.strategy);
  } else if (id == "firm") {
    setup.strategy.grip = RowOf(kGripModes, GripMode::kPosture).name;
    setup.strategy.touch_speed = 1.0;
  } else if (id == "regulated") {
    setup.strategy.grip = RowOf(kGripModes, GripMode::kMargin).name;
    setup.strategy.touch_speed = 0.25;
  } else if (id == "together") {
    TouchTogether(failed, setup);
  } else if (id == "slower") {
    setup.strategy.closure_time *= 2.0;
  } else if (id == "higher") {
    RaiseHand(kHeightChange, setup);
  } else if (id == "lower") {
    RaiseHand(-kHeightChange, setup);
  } else if (id == "no-offset") {
    setup.draw.offset_x = setup.draw.offset_y = setup.draw.offset_yaw = 0.0;
  } else if (id == "no-joint-error") {
    setup.draw.joint_error.setZero();
  } else if (id == "half-mass") {
    ChangeObject(0.5, 1.0, setup);
  }
  return setup;
}

Explanation ExplainFailure(TrialRunner& runner, const FailedTrial& failed) {
  return RemedyTrials(runner, failed).Find();
}

std::string DescribeExplanation(const Explanation& explanation) {
  std::string text = explanation.is_on_edge
                         ? "On an edge: with the object 0.2 mm and 0.2 degrees aside it holds. "
                         : "";
  text += fmt::format("As it is, {} fresh draws of the condition hold. ",
                      FormatShare(explanation.num_held(), kNumFreshDraws));
  const RemedyResult* grasp = explanation.FindBest(true);
  const RemedyResult* same = explanation.FindBest(false);
  if (same) text += Capitalise(DescribeBest(explanation, *same)) + ". ";
  if (grasp) {
    text += (same ? "Another grasp: " : "With the same grasp nothing that was tried helps; ") +
            DescribeBest(explanation, *grasp) + ". ";
  }
  if (!same && !grasp) {
    text += fmt::format("Nothing that was tried gains {} or more of them. ", kLeastNetGain);
  }
  const bool is_grip_tried =
      std::any_of(explanation.remedies.begin(), explanation.remedies.end(),
                  [](const RemedyResult& remedy) { return remedy.id == "grip-x2"; });
  const bool grip_helps = std::any_of(
      explanation.remedies.begin(), explanation.remedies.end(), [](const RemedyResult& remedy) {
        return HasPrefix(remedy.id, "grip-") && (remedy.holds || remedy.net_gain() > 0);
      });
  if (is_grip_tried && !grip_helps) text += "More grip does not help. ";
  std::string explains;
  for (const RemedyResult& remedy : explanation.remedies) {
    if (remedy.num_draws > 0 || !remedy.holds) continue;
    explains += (explains.empty() ? "" : ", ") + NameRemedy(remedy.id);
  }
  text += explains.empty()
              ? "This draw holds neither with twice the friction nor with half the mass, nor "
                "without offset or joint error."
              : "What only explains: this draw also holds with " + explains + ".";
  return text;
}

}  // namespace graspbench
