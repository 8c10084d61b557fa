#include "datasets/records/trial_table.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/trial/judge/judge.h"
#include "core/trial/measures/diagnosis_text.h"
#include "core/trial/measures/object_in_hand.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/grasp_choice.h"

namespace graspbench {
namespace {

using Value = std::function<Json(const TrialRecord&)>;

auto TakeTiming(double ContactTiming::*field) {
  return [field](const TrialRecord& record) { return record.result.timing.*field; };
}

auto TakePart(StabilityPart Stability::*part, double StabilityPart::*field) {
  return [part, field](const TrialRecord& record) { return record.result.stability.*part.*field; };
}

/** A value of the judgement; null for a trial that was not judged. */
template <class Take>
Value TakeJudgement(Take take) {
  return [take](const TrialRecord& record) {
    return record.judgement ? Json(take(*record.judgement)) : Json();
  };
}

std::string FindWeakestForce(const Judgement& judgement) {
  const BreakingLoad* weakest = nullptr;
  for (const BreakingLoad& load : judgement.loads) {
    if (load.is_force() && (!weakest || load.load < weakest->load)) weakest = &load;
  }
  return weakest ? weakest->direction : "";
}

std::string ListMechanisms() {
  std::string text;
  for (const NamedValue<Mechanism>& row : kMechanisms) {
    text += (text.empty() ? "" : ", ") + std::string(row.name);
  }
  return text;
}

/** "FF: limit (FFJ3); TH: balance". */
std::string DescribeGripFaults(const GripRecord& grip) {
  std::string text;
  for (const DigitGripRecord& digit : grip.digits) {
    if (digit.fault == GripFault::kNone) continue;
    text += (text.empty() ? "" : "; ") + digit.digit + ": " + NameOf(digit.fault);
    if (digit.joint) text += " (" + *digit.joint + ")";
  }
  return text;
}

/** Of a failure that hand and object were in; missing else. */
void AddDiagnosisColumns(std::vector<CsvColumn<TrialRecord>>& columns) {
  const auto take = [](auto value) {
    return [value](const TrialRecord& record) {
      return record.result.diagnosis ? Json(value(*record.result.diagnosis)) : Json();
    };
  };
  const auto text = [](const std::string& value) { return value.empty() ? Json() : Json(value); };
  columns.push_back({"mechanism", "string", "", "of the failure: " + ListMechanisms(),
                     take([](const Diagnosis& d) { return Json(NameOf(d.mechanism)); })});
  columns.push_back({"mechanism_part", "string", "",
                     "digit, or palm, that did not touch, pushed or gave way; of what was squeezed "
                     "out with the most normal work, of what sagged or slid with the most friction "
                     "work; missing: none",
                     take([text](const Diagnosis& d) { return text(d.part); })});
  columns.push_back({"mechanism_phase", "string", "", "phase in which the object was lost",
                     take([text](const Diagnosis& d) { return text(d.phase); })});
  columns.push_back({"mechanism_time_s", "number", "s",
                     "time of the loss since the start of placing; for a push, its start",
                     take([](const Diagnosis& d) { return JsonNumber(d.time); })});
  columns.push_back({"loss_turn_rad", "number", "rad",
                     "rotation of the object in the hand until the loss, since two parts of the "
                     "hand first opposed each other; for a lifted object since lift-off",
                     take([](const Diagnosis& d) { return JsonNumber(d.turn); })});
  columns.push_back({"normal_work_j", "number", "J",
                     "work of the hand's normal forces on the object in the last 150 ms of "
                     "opposition, relative to the hand",
                     take([](const Diagnosis& d) { return Json(d.CalcNormalWork()); })});
  columns.push_back(
      {"friction_work_j", "number", "J",
       "work of the hand's friction forces on the object in the window of normal_work_j",
       take([](const Diagnosis& d) { return Json(d.CalcFrictionWork()); })});
  columns.push_back({"gravity_work_j", "number", "J",
                     "work of gravity on the object in the window of normal_work_j",
                     take([](const Diagnosis& d) { return Json(d.gravity_work); })});
  columns.push_back({"diagnosis", "string", "", "how the object was lost, in words",
                     [](const TrialRecord& record) {
                       return record.result.diagnosis ? Json(DescribeDiagnosis(record.result))
                                                      : Json();
                     }});
}

/** Of a trial that regulates its grip; missing else. */
void AddGripColumns(std::vector<CsvColumn<TrialRecord>>& columns) {
  const auto take = [](double GripRecord::*force) {
    return [force](const TrialRecord& record) {
      return record.result.grip ? (*record.result.grip).*force : kUnset;
    };
  };
  columns.push_back({"grip_asked_n", "N", "setpoint of the total grip force, mean of the hold",
                     take(&GripRecord::asked)});
  columns.push_back({"grip_held_n", "N",
                     "filtered total grip force, mean of the hold: true with touch exact, "
                     "estimated from elements and drive torques with touch sensed",
                     take(&GripRecord::held)});
  columns.push_back({"grip_faults", "string", "",
                     "digits that deviate from their setpoint by more than 20 %, each with the "
                     "reason and its joint",
                     [](const TrialRecord& record) {
                       return record.result.grip ? Json(DescribeGripFaults(*record.result.grip))
                                                 : Json();
                     }});
  columns.push_back({"grip_excess", "",
                     "with touch sensed: hold_force_n over grip_asked_n; above 1.5 the hand "
                     "underestimated its force, and grip_faults names the digits",
                     [](const TrialRecord& record) {
                       const TrialResult& result = record.result;
                       if (!result.touch || !result.grip || !(result.grip->asked > 0.0)) {
                         return kUnset;
                       }
                       return result.stability.hold.normal_force / result.grip->asked;
                     }});
}

void AddJudgementColumns(std::vector<TrialColumn>& columns) {
  std::vector<TrialColumn> fields;
  AddFieldColumns<Judgement>(
      [](const TrialRecord& record) -> const Judgement& { return *record.judgement; }, fields);
  for (TrialColumn& column : fields) {
    column.value = [take = column.value](const TrialRecord& record) {
      return record.judgement ? take(record) : Json();
    };
  }
  fields.insert(fields.begin() + 1,  // behind the force that it belongs to
                {"breaking_direction", "string", "", "that pull's direction in the palm's frame",
                 TakeJudgement(FindWeakestForce)});
  columns.insert(columns.end(), fields.begin(), fields.end());
  for (const QualityConvention& convention : ListQualityConventions()) {
    const std::string id = convention.id;
    std::string edges = std::to_string(convention.num_edges) + " edges";
    if (convention.num_edges > 4) edges += " (4 with more than 8 contacts)";
    columns.push_back({NameEpsilonColumn(convention), "number", "",
                       "at the end of the hold, convention " + id + ", " + edges,
                       TakeJudgement([id](const Judgement& judgement) {
                         for (const ConventionEpsilon& epsilon : judgement.epsilons) {
                           if (epsilon.convention == id) return JsonNumber(epsilon.epsilon);
                         }
                         return Json();
                       })});
  }
  for (const VerdictRule& rule : ListVerdictRules()) {
    const std::string id = rule.id;
    const auto find = [id](const Judgement& judgement) {
      for (const Verdict& verdict : judgement.verdicts) {
        if (verdict.rule == id) return verdict;
      }
      return Verdict();
    };
    columns.push_back({"verdict_" + id, "boolean", "", std::string(rule.name) + ": " + rule.rule,
                       TakeJudgement([find](const Judgement& judgement) {
                         return Json(find(judgement).passed ? 1 : 0);
                       })});
    columns.push_back({"score_" + id, "number", "", std::string(rule.name) + ": " + rule.score,
                       TakeJudgement([find](const Judgement& judgement) {
                         return JsonNumber(find(judgement).score);
                       })});
  }
}

std::vector<std::string> ListDigits(const std::vector<TrialRecord>& records) {
  std::vector<std::string> digits = {"TH", "FF", "MF", "RF", "LF"};
  std::set<std::string> others;
  for (const TrialRecord& record : records) {
    for (const DigitContact& contact : record.result.contacts) others.insert(contact.digit);
  }
  for (const std::string& digit : digits) others.erase(digit);
  digits.insert(digits.end(), others.begin(), others.end());
  return digits;
}

/** Looks up a number of the digit's contact and touch; NaN when it takes no part. */
template <class Take>
auto TakeOfDigit(const std::string& digit, Take take) {
  return [digit, take](const TrialRecord& record) -> double {
    const TrialResult& result = record.result;
    for (size_t i = 0; i < result.contacts.size(); ++i) {
      if (result.contacts[i].digit == digit) return take(result.contacts[i], result.touches[i]);
    }
    return kUnset;
  };
}

void AddDigitColumns(const std::string& digit, std::vector<TrialColumn>& columns) {
  columns.push_back({"t_" + digit + "_s", "s",
                     "first contact of digit " + digit +
                         ", since the start of closure; missing if it had not touched by lift-off "
                         "or does not grasp",
                     TakeOfDigit(digit, [](const DigitContact& contact, const DigitTouch&) {
                       return contact.time;
                     })});
  columns.push_back(
      {"closing_" + digit, "", "closure command at that contact: 0 pre-grasp, 1 target posture",
       TakeOfDigit(digit,
                   [](const DigitContact&, const DigitTouch& touch) { return touch.closing; })});
  columns.push_back(
      {"gap_" + digit + "_m", "m",
       "smallest distance of digit " + digit + " to the object up to lift-off; 0 when it touched",
       TakeOfDigit(digit, [](const DigitContact&, const DigitTouch& touch) {
         return touch.smallest_gap;
       })});
}

/** Columns of what a trial's stability is made of. */
std::vector<TrialColumn> ListStabilityColumns() {
  return {
      {"sigma", "N",
       "stability: smallest pull along the palm axes that the measured contact forces resist in "
       "the hold; 0 if the object was lost",
       [](const TrialRecord& record) { return record.result.stability.sigma; }},
      {"sigma_stabilisation", "N", "sigma before lift-off, whatever the outcome",
       TakePart(&Stability::stabilisation, &StabilityPart::sigma)},
      {"sigma_lift", "N", "sigma over lift-off", TakePart(&Stability::lift, &StabilityPart::sigma)},
      {"sigma_proposed", "",
       "earlier proposal: epsilon times grip force over weight, reduced for slip and missing "
       "opposition, before lift-off",
       [](const TrialRecord& record) { return record.result.stability.sigma_proposed; }},
      {"epsilon", "",
       "mean quality before lift-off, convention ferrari-canny: mixed cones of 8 edges, unit "
       "normal force, moments about the centre of mass divided by the object's radius",
       TakePart(&Stability::stabilisation, &StabilityPart::quality)},
      {"epsilon_hold", "", "epsilon over the hold",
       TakePart(&Stability::hold, &StabilityPart::quality)},
      {"normal_force_n", "N", "mean sum of the normal forces before lift-off",
       TakePart(&Stability::stabilisation, &StabilityPart::normal_force)},
      {"slip_speed_m_per_s", "m/s",
       "mean speed of the contacts relative to the hand before lift-off",
       TakePart(&Stability::stabilisation, &StabilityPart::slip_speed)},
      {"opposition", "", "share of the time before lift-off with contact of opposed digits",
       TakePart(&Stability::stabilisation, &StabilityPart::opposition)}};
}

/** Of a session in which a camera chooses the grasp. */
void AddSightColumn(const SessionConfig& config, std::vector<TrialColumn>& columns) {
  if (!HasGraspBySight(config)) return;
  columns.push_back(
      {"sight_grasp", "string", "",
       "id of the grasp chosen by the camera, or not seen; missing if the grasp was given",
       [](const TrialRecord& record) {
         const std::optional<std::string>& grasp = record.result.sight_grasp;
         return grasp ? Json(*grasp) : Json();
       }});
}

/** Of records in which a controller has a part. */
void AddPolicyColumns(const std::vector<TrialRecord>& records, std::vector<TrialColumn>& columns) {
  if (std::none_of(records.begin(), records.end(),
                   [](const TrialRecord& record) { return record.result.policy.has_value(); })) {
    return;
  }
  const auto add = [&](const char* name, const char* type, const char* meaning, auto take) {
    columns.push_back({name, type, "", meaning, [take](const TrialRecord& record) {
                         return record.result.policy ? take(*record.result.policy) : Json();
                       }});
  };
  add("policy_told_pose", "string",
      "object pose given to the controller: none, nominal, believed, camera or true",
      [](const PolicyRecord& policy) { return Json(policy.object_pose); });
  add("policy_questions", "integer", "number of questions to the controller",
      [](const PolicyRecord& policy) { return Json(policy.num_questions); });
  add("policy_cut", "integer", "number of its targets and stiffness values clipped to limits",
      [](const PolicyRecord& policy) { return Json(policy.num_cut); });
  add("policy_hand_cut", "integer", "its poses of the hand that were cut; missing: it moved none",
      [](const PolicyRecord& policy) {
        return policy.num_hand_cut ? Json(*policy.num_hand_cut) : Json();
      });
}

void AddDrawColumns(const SessionConfig& config, std::vector<TrialColumn>& columns) {
  const auto add = [&](const char* name, const char* unit, const char* meaning,
                       double TrialDraw::*part) {
    columns.push_back({name, unit, meaning, [config, part](const TrialRecord& record) {
                         const PlannedTrial& plan = record.plan;
                         return MakeObjectDraw(config, plan.object, plan.trial).*part;
                       }});
  };
  add("draw_x_m", "m", "offset of the object from its nominal position in x", &TrialDraw::offset_x);
  add("draw_y_m", "m", "offset of the object from its nominal position in y", &TrialDraw::offset_y);
  add("draw_yaw_rad", "rad", "rotation of the object from its nominal orientation",
      &TrialDraw::offset_yaw);
}

const TrialResult& TakeResult(const TrialRecord& record) { return record.result; }

/** The stability, a record within the result, has columns of its own. */
struct ResultColumns : FieldColumnCollector<TrialRecord, TrialResult, decltype(&TakeResult)> {
  using FieldColumnCollector::operator();
  void operator()(const char*, Stability TrialResult::*) const {
    for (TrialColumn& column : ListStabilityColumns()) columns.push_back(std::move(column));
  }
};

/** Of a session with conditions: its name and a column for each factor. */
void AddConditionColumns(const SessionConfig& config, std::vector<TrialColumn>& columns) {
  if (config.conditions.empty()) return;
  columns.push_back({"condition", "", "name of the condition; empty: the base",
                     [](const TrialRecord& record) { return record.plan.condition.value_or(""); }});
  for (const SweepFactor& factor : ListFactors(config)) {
    std::string name = factor.key == "grasp" ? "grasp_factor" : factor.key;
    std::replace(name.begin(), name.end(), '.', '_');
    columns.push_back({name, "", "level of the factor " + factor.key,
                       [config, key = factor.key](const TrialRecord& record) {
                         return FindLevel(config, record.plan.condition, key);
                       }});
  }
}

/** Of a session with an arm. */
void AddArmColumns(const std::vector<TrialRecord>& records, std::vector<TrialColumn>& columns) {
  if (std::none_of(records.begin(), records.end(),
                   [](const TrialRecord& record) { return record.result.arm.has_value(); })) {
    return;
  }
  const auto add_joint = [&](const char* name, const char* meaning, std::string ArmRecord::*joint) {
    columns.push_back({name, "string", "", meaning, [joint](const TrialRecord& record) {
                         return record.result.arm ? Json((*record.result.arm).*joint) : Json();
                       }});
  };
  add_joint("arm_joint",
            "joint of the arm nearest its limit on the path, or the joint that prevents a path",
            &ArmRecord::joint);
  const auto add = [&](const char* name, const char* unit, const char* meaning,
                       double ArmRecord::*value) {
    columns.push_back({name, unit, meaning, [value](const TrialRecord& record) {
                         return record.result.arm ? (*record.result.arm).*value : kUnset;
                       }});
  };
  add("arm_margin_rad", "rad", "of that joint to its limit; negative: beyond", &ArmRecord::margin);
  add("arm_speed_share", "", "largest joint speed in placing and lift over its limit",
      &ArmRecord::speed_share);
  add("arm_dexterity", "", "smallest value on the path; 0 at a singular posture",
      &ArmRecord::dexterity);
  add("arm_reach_time_s", "s", "of the gross motion to the pre-grasp pose", &ArmRecord::reach_time);
  add("arm_reach_path_m", "m", "path of the hand in the gross motion", &ArmRecord::reach_path);
  add("arm_straight_time_s", "s", "of placing and lift", &ArmRecord::straight_time);
  add("arm_straight_path_m", "m", "path of the hand in placing and lift",
      &ArmRecord::straight_path);
  add("arm_deflection_m", "m", "largest distance of the hand from its commanded place",
      &ArmRecord::deflection);
  add("arm_deflection_rad", "rad", "largest turn of the hand from its commanded orientation",
      &ArmRecord::deflection_angle);
  add("arm_torque_share", "", "largest joint torque over its limit", &ArmRecord::torque_share);
  add_joint("arm_torque_joint", "joint of the arm with that torque", &ArmRecord::torque_joint);
}

}  // namespace

std::string NameEpsilonColumn(const QualityConvention& convention) {
  std::string name = "epsilon_" + convention.id;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<TrialColumn> ListTrialColumns(const std::vector<TrialRecord>& records,
                                          const SessionConfig& config) {
  std::vector<TrialColumn> columns;
  AddFieldColumns<PlannedTrial>(
      [](const TrialRecord& record) -> const PlannedTrial& { return record.plan; }, columns);
  AddSightColumn(config, columns);
  AddPolicyColumns(records, columns);
  AddArmColumns(records, columns);
  AddConditionColumns(config, columns);
  const std::vector<TrialColumn> outcome_columns = {
      {"outcome", "", "how the trial ended",
       [](const TrialRecord& record) { return NameOf(record.result.outcome); }},
      {"success", "", "1 when the outcome is success, else 0",
       [](const TrialRecord& record) { return IsSuccess(record.result.outcome); }},
      {"gct_s", "s", "grasp closure time: start of closure to the last first contact",
       TakeTiming(&ContactTiming::gct)},
      {"gft_s", "s", "grasp forming time: first to last of the first contacts",
       TakeTiming(&ContactTiming::gft)},
      {"got_s", "s", "grasp opposing time: between the thumb and the earliest finger",
       TakeTiming(&ContactTiming::got)},
      {"gft_ratio", "", "gft_s / gct_s", TakeTiming(&ContactTiming::gft_ratio)},
      {"got_ratio", "", "got_s / gct_s", TakeTiming(&ContactTiming::got_ratio)},
      {"contact_before_start", "",
       "1 if a digit touched before closure began (early contact); the times are not comparable "
       "and excluded from medians",
       [](const TrialRecord& record) { return record.result.timing.contact_before_start; }},
      {"contact_order", "",
       "grasping digits by first contact: < earlier, = within one physics step; without digits "
       "that never touched",
       [](const TrialRecord& record) { return FindContactOrder(record.result).Format(); }},
  };
  columns.insert(columns.end(), outcome_columns.begin(), outcome_columns.end());
  TrialResult::ListFields(ResultColumns{{columns, &TakeResult}});
  AddJudgementColumns(columns);
  for (const std::string& digit : ListDigits(records)) {
    AddDigitColumns(digit, columns);
  }
  columns.push_back(
      {"palm_touches", "",
       "1 if the palm, or another link outside the digits, touches at the end of the trial",
       [](const TrialRecord& record) { return TouchesPalmAtEnd(record.result); }});
  columns.push_back({"opposition_type", "string", "",
                     "pad, palm or side: opposition that holds the object at the end; missing if "
                     "not held or in older records",
                     [](const TrialRecord& record) {
                       const std::optional<Opposition>& found = record.result.opposition;
                       return found ? ToJson(*found) : Json();
                     }});
  columns.push_back({"hold_force_n", "N", "mean sum of the normal forces over the hold",
                     TakePart(&Stability::hold, &StabilityPart::normal_force)});
  AddGripColumns(columns);
  columns.push_back({"seat", "string", "",
                     "kept, or reseated (closure_rise_m above 5 mm and 43 % of object_height_m, "
                     "and closure_slide_m above 1 mm); grip forces of the two are not comparable; "
                     "missing if not lifted",
                     [](const TrialRecord& record) {
                       const Seat seat = FindSeat(record.result);
                       return seat == Seat::kUnknown ? Json() : Json(NameOf(seat));
                     }});
  columns.push_back({"caged", "boolean", "",
                     "1 for a success with a total grip below 1.5 N or five object weights, "
                     "whichever is less; missing without a recorded weight",
                     [](const TrialRecord& record) {
                       if (std::isnan(record.result.weight)) return Json();
                       return Json(IsCaged(record.result) ? 1 : 0);
                     }});
  AddDrawColumns(config, columns);
  columns.push_back({"reason", "", "reason of the outcome in words; empty for a success",
                     [](const TrialRecord& record) { return record.result.reason; }});
  AddDiagnosisColumns(columns);
  return columns;
}

std::vector<EventRow> ListEvents(const TrialRecord& record) {
  std::vector<EventRow> rows;
  const ContactOrder order = FindContactOrder(record.result);
  std::set<std::string> touched;
  for (const ContactEvent& event : record.result.contact_events) {
    const bool is_first =
        event.kind == ContactEventKind::kTouch && touched.insert(event.digit).second;
    rows.push_back({&record, &event, is_first ? order.FindRank(event.digit) : 0});
  }
  return rows;
}

std::vector<CsvColumn<EventRow>> ListEventColumns() {
  std::vector<CsvColumn<EventRow>> columns;
  AddFieldColumns<PlannedTrial>(
      [](const EventRow& row) -> const PlannedTrial& { return row.record->plan; }, columns);
  AddFieldColumns<ContactEvent>(
      [](const EventRow& row) -> const ContactEvent& { return *row.event; }, columns);
  columns.insert(columns.end() - 1,  // in front of the impulse, which some kinds have
                 {"event", "", "touch, lost, regained or slip",
                  [](const EventRow& row) { return NameOf(row.event->kind); }});
  columns.push_back(
      {"contact_rank", "integer", "",
       "at the first touch of a grasping digit: its rank in contact_order, equal for tied digits",
       [](const EventRow& row) { return row.rank > 0 ? Json(row.rank) : Json(); }});
  return columns;
}

}  // namespace graspbench
