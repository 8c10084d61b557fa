#include "core/trial/remedies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"

namespace graspbench {
namespace {

constexpr double kPlaceboShift = 0.0002;      // [m]
const double kPlaceboTurn = RadFromDeg(0.2);  // [rad]
constexpr double kHeightChange = 0.008;       // [m]
/** Number of remedies and of draws in each further round. */
constexpr struct {
  size_t num_remedies;
  int num_draws;
} kRounds[] = {{4, 10}, {1, kNumFreshDraws}};
constexpr char kGraspPrefix[] = "grasp-";
constexpr char kGripPrefix[] = "grip-";
constexpr char kFrictionPrefix[] = "friction-x";
constexpr const char* kFrictionFactors[] = {"1.1", "1.25", "1.5", "2"};

/** A remedy and its name in reports. */
struct RemedyRow {
  const char* id;
  const char* words;
  enum { kOften, kUsable, kExplains } use;  ///< often helpful, usable, or diagnostic
};
constexpr RemedyRow kRemedies[] = {
    {"grip-x2", "twice the grip (strategy.grip_margin and grip_force_n times 2)",
     RemedyRow::kUsable},
    {"grip-x4", "four times the grip (strategy.grip_margin and grip_force_n times 4)",
     RemedyRow::kOften},
    {"firm", "a firm grip (--preset firm)", RemedyRow::kOften},
    {"regulated", "a regulated grip (--preset people)", RemedyRow::kOften},
    {"together", "digits that touch together", RemedyRow::kUsable},
    {"slower", "closing at half the speed (strategy.closure_time_s times 2)", RemedyRow::kUsable},
    {"higher", "the hand 8 mm higher", RemedyRow::kUsable},
    {"lower", "the hand 8 mm lower", RemedyRow::kOften},
    {"no-offset", "no offset of the object", RemedyRow::kExplains},
    {"no-joint-error", "no joint error", RemedyRow::kExplains},
    {"half-mass", "half the mass", RemedyRow::kExplains},
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

/** Runs the remedies of one failed trial. */
class RemedyTrials {
 public:
  RemedyTrials(TrialRunner& runner, const FailedTrial& failed) : runner_(runner), failed_(failed) {}

  Explanation FindShortly();
  Explanation Find();

 private:
  void RunAsItIs(int num_draws);
  void RunFirst(const std::string& id);
  void RunFinalists(bool is_grasp);
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

/** Runs a remedy on further new draws, up to this number. */
void RemedyTrials::RunOn(int num_draws, RemedyResult& remedy) {
  for (; remedy.num_draws < num_draws; ++remedy.num_draws) {
    const auto draw = static_cast<size_t>(remedy.num_draws);
    const bool holds = HoldsWith(remedy.id, failed_.fresh[draw]);
    remedy.num_mended += holds && !found_.held[draw];
    remedy.num_broken += !holds && found_.held[draw];
  }
}

/** Adds the least friction factor that holds. */
void RemedyTrials::AddFriction() {
  for (const char* factor : kFrictionFactors) {
    const std::string id = std::string(kFrictionPrefix) + factor;
    if (!HoldsWith(id, failed_.setup.draw)) continue;
    found_.remedies.push_back({id, true});
    return;
  }
}

/** Runs the unchanged trial on new draws, and the placebo. */
void RemedyTrials::RunAsItIs(int num_draws) {
  TrialDraw beside = failed_.setup.draw;
  beside.offset_x += kPlaceboShift;
  beside.offset_yaw += kPlaceboTurn;
  found_.is_on_edge = HoldsWith("", beside);
  for (size_t i = 0; i < static_cast<size_t>(num_draws); ++i) {
    found_.held.push_back(HoldsWith("", failed_.fresh[i]));
  }
}

void RemedyTrials::RunFirst(const std::string& id) {
  found_.remedies.push_back({id, HoldsWith(id, failed_.setup.draw)});
  RunOn(kNumFirstDraws, found_.remedies.back());
}

/** Runs further rounds of other grasps or of the other remedies. Of equal net gains, those that
hold on the failed draw proceed. */
void RemedyTrials::RunFinalists(bool is_grasp) {
  std::vector<RemedyResult*> left;
  for (RemedyResult& remedy : found_.remedies) {
    if (IsAnotherGrasp(remedy) == is_grasp && remedy.net_gain() >= 0) left.push_back(&remedy);
  }
  for (const auto& round : kRounds) {
    std::stable_sort(left.begin(), left.end(), [](const RemedyResult* a, const RemedyResult* b) {
      return std::pair(a->net_gain(), a->holds) > std::pair(b->net_gain(), b->holds);
    });
    if (left.size() > round.num_remedies) left.resize(round.num_remedies);
    for (RemedyResult* remedy : left) RunOn(round.num_draws, *remedy);
  }
}

Explanation RemedyTrials::FindShortly() {
  RunAsItIs(kNumFirstDraws);
  for (const RemedyRow& row : kRemedies) {
    if (row.use == RemedyRow::kOften && IsApplicable(row, failed_)) RunFirst(row.id);
  }
  for (const Grasp& grasp : failed_.grasps) RunFirst(kGraspPrefix + grasp.id);
  return std::move(found_);
}

Explanation RemedyTrials::Find() {
  RunAsItIs(kNumFreshDraws);
  for (const RemedyRow& row : kRemedies) {
    if (row.use != RemedyRow::kExplains && IsApplicable(row, failed_)) RunFirst(row.id);
  }
  for (const Grasp& grasp : failed_.grasps) RunFirst(kGraspPrefix + grasp.id);
  for (const bool is_grasp : {false, true}) RunFinalists(is_grasp);
  AddFriction();
  for (const RemedyRow& row : kRemedies) {
    if (row.use != RemedyRow::kExplains) continue;
    found_.remedies.push_back({row.id, HoldsWith(row.id, failed_.setup.draw)});
  }
  return std::move(found_);
}

std::string FormatShare(int num, int num_all) { return fmt::format("{} of {}", num, num_all); }

std::string DescribeBest(const Explanation& explanation, const RemedyResult& best) {
  const int held = explanation.num_held() + best.net_gain();
  return fmt::format("{} holds {} fresh draws (improved {}, worsened {}){}", NameRemedy(best.id),
                     FormatShare(held, explanation.num_draws()), best.num_mended, best.num_broken,
                     best.holds ? "" : ", but not this draw");
}

}  // namespace

std::string NameRemedy(const std::string& id) {
  if (id == std::string(kGraspPrefix) + "rehearsed") {
    return "the rehearsed grasp (--grasp rehearsed)";
  }
  if (HasPrefix(id, kGraspPrefix)) return "grasp " + id.substr(sizeof(kGraspPrefix) - 1);
  if (HasPrefix(id, kFrictionPrefix)) {
    return "friction times " + id.substr(sizeof(kFrictionPrefix) - 1);
  }
  for (const RemedyRow& row : kRemedies) {
    if (id == row.id) return row.words;
  }
  return id;  // a remedy of another version
}

int Explanation::num_held() const {
  return static_cast<int>(std::count(held.begin(), held.end(), 1));
}

const RemedyResult* Explanation::FindBest(bool is_grasp) const {
  const RemedyResult* best = nullptr;
  for (const RemedyResult& remedy : remedies) {
    if (remedy.num_draws < std::max(num_draws(), 1)) continue;
    if (IsAnotherGrasp(remedy) != is_grasp) continue;
    if (remedy.net_gain() < CalcLeastNetGain(num_draws())) continue;
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

Explanation ExplainFailure(TrialRunner& runner, const FailedTrial& failed, ExplainDepth depth) {
  GRASPBENCH_DEMAND(failed.fresh.size() == kNumFreshDraws, std::to_string(failed.fresh.size()));
  RemedyTrials trials(runner, failed);
  return depth == ExplainDepth::kShort ? trials.FindShortly() : trials.Find();
}

std::string DescribeExplanation(const Explanation& explanation) {
  const std::string as_it_is =
      fmt::format("Without a remedy {} fresh draws of the condition hold. ",
                  FormatShare(explanation.num_held(), explanation.num_draws()));
  const std::string aside = "with the object shifted by 0.2 mm and 0.2 degrees it holds. ";
  const bool mostly_holds = 2 * explanation.num_held() >= explanation.num_draws();
  std::string text = !explanation.is_on_edge ? as_it_is
                     : mostly_holds          ? "Borderline: " + aside + as_it_is
                                             : as_it_is + "Borderline draw: " + aside;
  const RemedyResult* grasp = explanation.FindBest(true);
  const RemedyResult* same = explanation.FindBest(false);
  if (same) text += Capitalise(DescribeBest(explanation, *same)) + ". ";
  if (grasp) {
    text += (same ? "Another grasp: " : "No tested remedy with the same grasp helps; ") +
            DescribeBest(explanation, *grasp) + ". ";
  }
  if (!same && !grasp) {
    text += fmt::format("No tested remedy gains {} or more of them. ",
                        CalcLeastNetGain(explanation.num_draws()));
  }
  const bool is_grip_tried =
      std::any_of(explanation.remedies.begin(), explanation.remedies.end(),
                  [](const RemedyResult& remedy) { return HasPrefix(remedy.id, kGripPrefix); });
  const bool grip_helps = std::any_of(
      explanation.remedies.begin(), explanation.remedies.end(), [](const RemedyResult& remedy) {
        return HasPrefix(remedy.id, kGripPrefix) && (remedy.holds || remedy.net_gain() > 0);
      });
  if (is_grip_tried && !grip_helps) text += "More grip does not help. ";
  if (explanation.is_short()) return text + "Only a few remedies were tested.";
  std::string explains;
  for (const RemedyResult& remedy : explanation.remedies) {
    if (remedy.num_draws > 0 || !remedy.holds) continue;
    explains += (explains.empty() ? "" : ", ") + NameRemedy(remedy.id);
  }
  text += explains.empty() ? "For diagnosis: this draw fails even with twice the friction, with "
                             "half the mass, and without offset or joint error."
                           : "For diagnosis: this draw also holds with " + explains + ".";
  return text;
}

std::string SummariseExplanation(const Explanation& explanation) {
  const int all = explanation.num_draws();
  std::string text;
  for (const bool is_grasp : {false, true}) {
    const RemedyResult* best = explanation.FindBest(is_grasp);
    if (!best) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", NameRemedy(best->id),
                        FormatShare(explanation.num_held() + best->net_gain(), all));
  }
  return text.empty() ? "no tested remedy" : text;
}

}  // namespace graspbench
