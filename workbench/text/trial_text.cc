#include "workbench/text/trial_text.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/arm/mounted_arm.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/trial/measures/diagnosis_text.h"
#include "core/trial/measures/object_in_hand.h"
#include "datasets/plan/failed_trial.h"
#include "datasets/records/trace_table.h"
#include "datasets/session/explanation_store.h"
#include "datasets/session/find_trial.h"
#include "objects/catalogue.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/tables/text_table.h"

namespace graspbench {

namespace {

Json ToJson(const std::optional<FieldDifference>& difference) {
  if (!difference) return {};
  return {
      {"field", difference->field}, {"recorded", difference->recorded}, {"now", difference->now}};
}

std::string DescribeReplayed(const ReplayedTrial& trial) {
  if (!trial.is_recorded) return "has no record: the session has not finished it";
  if (!trial.difference) return "re-simulation matches the record";
  return fmt::format("{} differs: recorded {}, now {}{}", trial.difference->field,
                     trial.difference->recorded, trial.difference->now,
                     trial.is_damaged ? "; its line fails its checksum" : "");
}

std::string DescribePhysics(const ReplayConditions& conditions) {
  if (conditions.recorded_physics == 0) {
    return fmt::format("version {}; the session does not state its version", conditions.physics);
  }
  if (!conditions.is_other_physics())
    return fmt::format("version {}, the same", conditions.physics);
  return fmt::format("version {}, recorded with {}: results of these versions must not be mixed",
                     conditions.physics, conditions.recorded_physics);
}

std::string DescribeBuild(const ReplayConditions& conditions) {
  if (conditions.recorded_builds.empty()) return conditions.build + "; the recorded one is unknown";
  if (!conditions.is_other_build()) return conditions.build + ", the same";
  return conditions.build + ", recorded with " +
         fmt::format("{}", fmt::join(conditions.recorded_builds, ", "));
}

bool IsAsRecorded(const ReplayedTrial& trial) { return trial.is_recorded && !trial.difference; }

}  // namespace

std::string FormatReplay(const SessionReplay& replay, bool with_all) {
  std::string text;
  int num_same = 0;
  for (const ReplayedTrial& trial : replay.trials) {
    num_same += IsAsRecorded(trial);
    if (!with_all && IsAsRecorded(trial)) continue;
    text += fmt::format("{} {}, {}: {}\n", trial.planned.id, NameTrial(trial.planned),
                        NameOf(trial.outcome), DescribeReplayed(trial));
  }
  const ReplayConditions& conditions = replay.conditions;
  text += fmt::format("same     {} of {}\nphysics  {}\nbuild    {}\n", num_same,
                      FormatCount(static_cast<int64_t>(replay.trials.size()), "trial"),
                      DescribePhysics(conditions), DescribeBuild(conditions));
  if (conditions.num_changed > 0 && !conditions.is_other_physics()) {
    text += fmt::format("inputs   hand, object or grasp of {} changed since\n",
                        FormatCount(conditions.num_changed, "trial has", "trials have"));
  }
  return text;
}

Json MakeReplayJson(const SessionReplay& replay, const std::string& folder) {
  Json trials = Json::array();
  for (const ReplayedTrial& trial : replay.trials) {
    Json json = ToJson(trial.planned);
    json["name"] = NameTrial(trial.planned);
    json["outcome"] = NameOf(trial.outcome);
    json["recorded"] = trial.is_recorded;
    json["damaged"] = trial.is_damaged;
    json["difference"] = ToJson(trial.difference);
    trials.push_back(std::move(json));
  }
  const ReplayConditions& conditions = replay.conditions;
  const int num_trials = static_cast<int>(replay.trials.size());
  return {{"folder", folder},
          {"num_trials", num_trials},
          {"num_different", replay.CountDifferent()},
          {"num_missing", replay.CountMissing()},
          {"physics_version", conditions.physics},
          {"recorded_physics_version", conditions.recorded_physics},
          {"build", conditions.build},
          {"recorded_builds", conditions.recorded_builds},
          {"num_changed_inputs", conditions.num_changed},
          {"trials", trials}};
}

namespace {

/** Nothing where the grasp was given. */
std::string FormatSight(const TrialResult& result) {
  if (!result.sight_grasp) return "";
  std::string text = *result.sight_grasp;
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.id == text)
      text += ", " + taxon.name + ", chosen from the outline in the camera picture";
  }
  return "grasp    " + text + "\n";
}

/** Nothing without a controller. */
std::string FormatController(const TrialResult& result) {
  if (!result.policy) return "";
  const PolicyRecord& policy = *result.policy;
  const std::string hand =
      policy.num_hand_cut
          ? fmt::format(", {} of the hand", FormatCount(*policy.num_hand_cut, "pose"))
          : "";
  return fmt::format("control  {}; object pose given: {}; clipped to limits: {}{}\n",
                     FormatCount(policy.num_questions, "time"), policy.object_pose,
                     FormatCount(policy.num_cut, "target"), hand);
}

/** Nothing without an arm. */
std::string FormatArm(const TrialSetup& setup, const TrialResult& result) {
  if (!setup.arm || !result.arm) return "";
  const std::string place = "arm      " + DescribeArmPlace(*setup.arm);
  const ArmRecord& arm = *result.arm;
  if (arm.q.size() == 0) {
    return place + ": no course" + (arm.joint.empty() ? "" : "; joint " + arm.joint) + "\n";
  }
  const std::string yields =
      arm.torque_joint.empty()
          ? ""
          : fmt::format("arm      gave way by {} mm, {} deg; joint {} at {} of its torque\n",
                        FormatFixed(MmFromM(arm.deflection), 2),
                        FormatFixed(DegFromRad(arm.deflection_angle), 2), arm.torque_joint,
                        FormatPercent(arm.torque_share));
  return place +
         fmt::format(
             "\narm      to the pre-grasp pose {} s, {} mm; placing and lift {} s, {} mm; joint {} "
             "{} deg from its limit; fastest joint at {} of its speed\n{}",
             FormatFixed(arm.reach_time, 2), FormatFixed(MmFromM(arm.reach_path), 0),
             FormatFixed(arm.straight_time, 2), FormatFixed(MmFromM(arm.straight_path), 0),
             arm.joint, FormatFixed(DegFromRad(arm.margin), 1), FormatPercent(arm.speed_share),
             yields);
}

std::string FormatJointErrors(const TrialSetup& setup) {
  const Eigen::VectorXd& error = setup.draw.joint_error;
  Eigen::Index worst = -1;
  for (Eigen::Index j = 0; j < error.size(); ++j) {
    if (setup.hand->joints[static_cast<size_t>(j)].is_prismatic) continue;
    if (worst < 0 || std::abs(error[j]) > std::abs(error[worst])) worst = j;
  }
  if (worst < 0) return "";
  return fmt::format("; joint error at most {} deg ({})",
                     FormatFixed(DegFromRad(std::abs(error[worst])), 2),
                     setup.hand->joints[static_cast<size_t>(worst)].name);
}

/** Times are those of the shell: since the start of placing. */
std::string FormatPhases(const TracedTrial& traced, const TrialSetup& setup) {
  const StrategyConfig& strategy = setup.strategy;
  const Phase first = traced.trace.empty() ? Phase::kPlacing : traced.trace.front().phase;
  std::string text = std::string(NameOf(first)) + " from 0.000 s";
  for (const PhaseStart& phase : traced.result.phases) {
    if (phase.name == NameOf(Phase::kDone)) continue;
    text += ", " + phase.name + " from " + FormatFixed(phase.time + traced.closure_start, 3) + " s";
  }
  text += ", end at " + FormatFixed(traced.result.simulated_time, 3) + " s";
  if (const GraspCourse& course = setup.grasp.course; course.is_set()) {
    return text + "; placing and closure follow a recorded course of " +
           FormatFixed(course.duration(), 3) + " s";
  }
  if (strategy.closure_lead == 0.0) return text;
  return text + "; closure starts before arrival by " + FormatFixed(strategy.closure_lead, 3) +
         " s (strategy.closure_lead_s)";
}

/** The largest sum of a digit's normal forces over the trial [N]. */
double FindLargestForce(const ExaminedTrial& trial, const std::string& id) {
  const Hand& hand = *trial.setup.hand;
  double largest = kUnset;
  for (size_t digit = 0; digit < hand.digits.size(); ++digit) {
    if (hand.digits[digit].id != id) continue;
    for (const TraceInstant& instant : trial.traced.trace) {
      largest = std::fmax(largest, CalcDigitForce(hand, instant, static_cast<int>(digit)));
    }
  }
  return largest;
}

/** First touches count up to lift-off only. */
std::string FormatFirstTouch(double time, double largest_force) {
  if (!std::isnan(time)) return FormatFixed(time, 3);
  return largest_force > 0.0 ? "after lift-off" : "never";
}

/** One row per digit: its first touch, and its slips and losses by the contacts themselves. */
std::string FormatDigits(const ExaminedTrial& trial) {
  const TrialResult& result = trial.traced.result;
  const double start = trial.traced.closure_start;
  TextTable table({"digit", "first touch [s]", "closure then", "smallest gap [mm]", "slips",
                   "losses", result.touch ? "largest true force [N]" : "largest force [N]"});
  for (size_t d = 0; d < result.contacts.size(); ++d) {
    const DigitContact& contact = result.contacts[d];
    const DigitTouch& touch = result.touches[d];
    const double largest = FindLargestForce(trial, contact.digit);
    const auto count = [&](ContactEventKind kind) {
      return std::to_string(std::count_if(
          result.contact_events.begin(), result.contact_events.end(),
          [&](const ContactEvent& e) { return e.kind == kind && e.digit == contact.digit.str(); }));
    };
    table.AddRow({contact.digit.str() + (contact.is_opposing ? " (opposes)" : ""),
                  FormatFirstTouch(contact.time + start, largest), FormatPercent(touch.closing),
                  FormatFixed(MmFromM(touch.smallest_gap), 1), count(ContactEventKind::kSlip),
                  count(ContactEventKind::kLost), FormatFixed(largest, 2)});
  }
  return table.Format();
}

/** Empty for a trial that was not lifted. */
std::string FormatSeat(const TrialResult& result) {
  const Seat seat = FindSeat(result);
  if (seat == Seat::kUnknown) return "";
  std::string text = fmt::format(
      "seat     {}: before lift-off the object (height {} mm) rose {} mm in the hand and slid {} "
      "mm",
      NameOf(seat), FormatFixed(MmFromM(result.object_height), 1),
      FormatFixed(MmFromM(result.closure_rise), 1), FormatFixed(MmFromM(result.closure_slide), 1));
  if (IsSuccess(result.outcome)) {
    text += fmt::format("; total grip {} N{}{}", FormatFixed(result.stability.hold.normal_force, 2),
                        result.touch ? " (true)" : "", IsCaged(result) ? ", caged" : "");
    if (result.opposition) {
      text += fmt::format(", {} opposition", RowOf(kOppositions, *result.opposition).name);
    }
  }
  return text + "\n";
}

/** The reference of a margin, if it is not the smallest force of these contacts. */
std::string DescribeMargin(const GripRecord& grip) {
  constexpr double kNothing = 1e-3;  // of the weight
  if (grip.told_friction == 0.0) return "";
  if (std::isnan(grip.smallest)) {
    return "no equilibrium exists for these contacts; the setpoint falls back to m g / (2 mu) per "
           "side\n";
  }
  if (grip.smallest > kNothing * grip.told_weight) return "";
  return "the opposing digit and the rest of the hand bear the weight alone; the other digits have "
         "the minimum setpoint\n";
}

/** Empty when stabilisation ended within the tolerance of the grip. */
std::string DescribeLift(const GripRecord& grip) {
  if (grip.was_in_band) return "";
  return std::isnan(grip.closed) ? "; object never lifted" : "; outside the tolerance at lift-off";
}

/** "limit (FFJ3)". */
std::string DescribeFault(const DigitGripRecord& digit) {
  return NameOf(digit.fault) + (digit.joint ? " (" + *digit.joint + ")" : "");
}

/** With sensed touch: the true total grip beside its setpoint. */
std::string DescribeTruth(const TrialResult& result) {
  const double truth = result.stability.hold.normal_force;
  if (!result.touch || !(result.grip->asked > 0.0) || std::isnan(truth)) return "";
  return fmt::format("true total grip in the hold {} N, {} times the setpoint\n",
                     FormatFixed(truth, 2), FormatFixed(truth / result.grip->asked, 2));
}

/** Setpoint and measured forces of a regulated grip. */
std::string FormatGrip(const TrialResult& result) {
  if (!result.grip) return "";
  const GripRecord& grip = *result.grip;
  const std::string felt = result.touch ? "estimated " : "";
  const std::string held =
      std::isnan(grip.held) ? "" : ", " + felt + FormatFixed(grip.held, 2) + " N in the hold";
  std::string text = fmt::format("grip     total setpoint {} N{}, filtered {}peak {} N{}\n",
                                 FormatFixed(grip.asked, 2), held, felt, FormatFixed(grip.peak, 2),
                                 DescribeLift(grip));
  TextTable table({"digit", "setpoint [N]", felt + "before lift-off [N]", felt + "in the hold [N]",
                   "closure", "limited by"});
  for (const DigitGripRecord& digit : grip.digits) {
    table.AddRow({digit.digit + (digit.opposes ? " (opposes)" : ""), FormatFixed(digit.asked, 2),
                  FormatFixed(digit.closed, 2), FormatFixed(digit.held, 2),
                  FormatPercent(digit.closing), DescribeFault(digit)});
  }
  if (!std::isnan(grip.rest_held)) {
    table.AddRow({"rest of the hand", FormatFixed(grip.rest_asked, 2), "",
                  FormatFixed(grip.rest_held, 2), "", ""});
  }
  return text + table.Format() + DescribeMargin(grip) + DescribeTruth(result);
}

/** Compares this trial with the nearest success. */
std::string FormatBeside(const ExaminedTrial& trial) {
  const TrialRecord& other = *trial.nearest;
  TextTable table({"", NameTrial(trial.planned), NameTrial(other.plan)});
  const TrialResult& a = trial.traced.result;
  const TrialResult& b = other.result;
  const auto add = [&](const char* what, const auto& format) {
    table.AddRow({what, format(a), format(b)});
  };
  add("outcome", [](const TrialResult& r) { return std::string(NameOf(r.outcome)); });
  add("order of contact", [](const TrialResult& r) { return FindContactOrder(r).Format(); });
  add("GCT [ms]", [](const TrialResult& r) { return FormatFixed(MsFromS(r.timing.gct), 1); });
  add("GFT [ms]", [](const TrialResult& r) { return FormatFixed(MsFromS(r.timing.gft), 1); });
  add("GOT [ms]", [](const TrialResult& r) { return FormatFixed(MsFromS(r.timing.got), 1); });
  if (a.timing.contact_before_start || b.timing.contact_before_start) {
    add("these times", [](const TrialResult& r) {
      return std::string(r.timing.contact_before_start ? kNotComparable : "");
    });
  }
  add("grip before lift-off [N]",
      [](const TrialResult& r) { return FormatFixed(r.grip_force, 2); });
  add("sigma before lift-off [N]",
      [](const TrialResult& r) { return FormatFixed(r.stability.stabilisation.sigma, 2); });
  add("lifted by [mm]",
      [](const TrialResult& r) { return FormatFixed(MmFromM(r.lift_height), 1); });
  return table.Format();
}

std::string MakeShellLine(const ExaminedTrial& trial, const std::string& folder) {
  return "graspbench shell -c " +
         QuoteForShell("open " + QuoteForShell(folder) + " " + trial.planned.id);
}

}  // namespace

std::string FormatOutcome(const TrialResult& result) {
  return "outcome  " + std::string(NameOf(result.outcome)) +
         (result.reason.empty() ? "" : ": " + result.reason) + "\n";
}

std::string FormatComparison(const ExaminedTrial& trial) {
  if (!trial.recorded) return "not run yet in this session";
  if (!trial.difference) return "re-simulation matches the record";
  return fmt::format(
      "differs from its record in {}: recorded {}, now {}; the session was run by "
      "another build or on another machine",
      trial.difference->field, trial.difference->recorded, trial.difference->now);
}

std::string FormatObjectDraw(const TrialDraw& draw) {
  return fmt::format("x {} mm, y {} mm, yaw {} deg", FormatFixed(MmFromM(draw.offset_x), 1),
                     FormatFixed(MmFromM(draw.offset_y), 1),
                     FormatFixed(DegFromRad(draw.offset_yaw), 1));
}

namespace {

/** That of the session where its record is the same, or a new one. */
Explanation FindExplanation(const Session& session, const SessionInputs& inputs,
                            const ExaminedTrial& trial, TrialRunner& runner) {
  const Explanations known = LoadExplanations(session.folder);
  const auto stored = known.find(trial.planned.id);
  if (stored != known.end() && !stored->second.is_short() && !trial.difference) {
    return stored->second;
  }
  FailedTrial failed = MakeFailedTrial(session.config, inputs, trial.planned, trial.setup);
  failed.result = trial.traced.result;
  return ExplainFailure(runner, failed);
}

}  // namespace

ExaminedTrial ExamineTrial(const Session& session, const PlannedTrial& planned, double interval) {
  const SessionInputs inputs = LoadTrialInputs(session, planned);
  ExaminedTrial trial;
  trial.planned = planned;
  trial.setup = MakeRecordedSetup(session, inputs, planned);
  trial.setup.object = CompleteObject(trial.setup.object);
  TrialRunner runner(trial.setup.hand, trial.setup.object);
  trial.traced = TraceTrial(runner, trial.setup, interval);
  if (const TrialRecord* record = FindRecord(session, planned)) {
    trial.recorded = LoadWhole(session, *record).result;
    trial.difference = FindFirstDifference(*trial.recorded, trial.traced.result);
  }
  if (trial.traced.result.diagnosis && !trial.traced.result.policy) {
    trial.explanation = FindExplanation(session, inputs, trial, runner);
  }
  const NearestSuccess nearest =
      FindNearestSuccess(session, planned, 0.5 * trial.setup.object->size.x());
  if (nearest.record) {
    trial.nearest = LoadWhole(session, *nearest.record);
    trial.nearest_distance = nearest.distance;
  }
  return trial;
}

namespace {

/** Nothing of a rigid object. */
std::string FormatSoftness(const GraspObject& object) {
  if (!object.compressible) return "";
  return "soft     compressed to " + DescribeCompression(object) + "\n";
}

}  // namespace

std::string FormatTrial(const ExaminedTrial& trial, const std::string& folder) {
  const TrialResult& result = trial.traced.result;
  std::string text =
      fmt::format("trial    {} ({}): {}, {}, {}\n", trial.planned.id, NameTrial(trial.planned),
                  trial.setup.hand->name, trial.setup.object->name, trial.planned.grasp) +
      FormatSoftness(*trial.setup.object) + FormatSight(result) + FormatController(result) +
      FormatArm(trial.setup, result) + FormatOutcome(result) + "draw     " +
      FormatObjectDraw(trial.setup.draw) + FormatJointErrors(trial.setup) + "\n" + "phases   " +
      FormatPhases(trial.traced, trial.setup) + "\n";
  if (result.num_steps > 0) {  // else it ended before it began, for instance out of an arm's reach
    if (!result.contacts.empty()) text += FormatDigits(trial);
    text += FormatSeat(result) + FormatGrip(result);
  }
  if (result.diagnosis) text += "why      " + DescribeDiagnosis(result) + "\n";
  if (trial.explanation) text += "remedies " + DescribeExplanation(*trial.explanation) + "\n";
  if (trial.nearest && !IsSuccess(result.outcome)) {
    text += fmt::format("nearest  success: {}, object {} mm away\n", NameTrial(trial.nearest->plan),
                        FormatFixed(MmFromM(trial.nearest_distance), 1)) +
            FormatBeside(trial);
  } else if (!IsSuccess(result.outcome)) {
    text += "nearest  no success in this condition\n";
  }
  return text + "replay   " + FormatComparison(trial) + "\n" + "open     " +
         MakeShellLine(trial, folder) + "\n";
}

Json MakeTrialJson(const ExaminedTrial& trial, const std::string& folder) {
  const TrialDraw& draw = trial.setup.draw;
  Json json = ToJson(trial.planned);
  json["name"] = NameTrial(trial.planned);
  json["draw"] = Json{{"x_m", draw.offset_x},
                      {"y_m", draw.offset_y},
                      {"yaw_rad", draw.offset_yaw},
                      {"joint_error_rad", JsonAngles(draw.joint_error)}};
  json["times_since"] = "start of closure; of snapshots and diagnosis: start of placing";
  json["closure_start_s"] = JsonNumber(trial.traced.closure_start);
  json["result"] = ToJson(trial.traced.result);
  const Seat seat = FindSeat(trial.traced.result);
  json["seat"] = seat == Seat::kUnknown ? Json() : Json(NameOf(seat));
  json["caged"] = IsCaged(trial.traced.result);
  const std::optional<Diagnosis>& diagnosis = trial.traced.result.diagnosis;
  json["diagnosis"] = diagnosis ? RecordToJson(*diagnosis) : Json();
  if (diagnosis) json["diagnosis"]["text"] = DescribeDiagnosis(trial.traced.result);
  json["explanation"] = trial.explanation ? RecordToJson(*trial.explanation) : Json();
  if (trial.explanation) json["explanation"]["text"] = DescribeExplanation(*trial.explanation);
  json["nearest_success"] = trial.nearest ? Json{{"trial_id", trial.nearest->plan.id},
                                                 {"name", NameTrial(trial.nearest->plan)},
                                                 {"distance_m", trial.nearest_distance}}
                                          : Json();
  json["recorded"] = trial.recorded.has_value();
  json["difference"] = ToJson(trial.difference);
  json["open"] = MakeShellLine(trial, folder);
  return json;
}

}  // namespace graspbench
