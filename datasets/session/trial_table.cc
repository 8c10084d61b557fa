#include "datasets/session/trial_table.h"

#include <algorithm>
#include <set>

#include "core/trial/verdicts.h"

namespace graspbench {
namespace {

using Value = std::function<Json(const TrialRecord&)>;

Value TakePlan(std::string PlannedTrial::*field) {
  return [field](const TrialRecord& record) { return Json(record.plan.*field); };
}
Value TakeTiming(double ContactTiming::*field) {
  return [field](const TrialRecord& record) { return JsonNumber(record.result.timing.*field); };
}

Value TakePart(StabilityPart Stability::*part, double StabilityPart::*field) {
  return [part, field](const TrialRecord& record) {
    return JsonNumber(record.result.stability.*part.*field);
  };
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
    const bool is_force = load.direction.substr(0, 5) == "force";
    if (is_force && (!weakest || load.load < weakest->load)) weakest = &load;
  }
  return weakest ? weakest->direction : "";
}

void AddJudgementColumns(std::vector<TrialColumn>& columns) {
  columns.push_back({"breaking_force_n", "number", "N",
                     "smallest of the six pulls along the palm's axes that took the object out, on "
                     "top of its weight; at most 100 N; missing when not judged",
                     TakeJudgement([](const Judgement& judgement) {
                       return JsonNumber(judgement.breaking_force);
                     })});
  columns.push_back({"breaking_direction", "string", "",
                     "that pull's direction in the palm's frame", TakeJudgement(FindWeakestForce)});
  columns.push_back({"breaking_moment_nm", "number", "N m",
                     "smallest of the six twists about the palm's axes that turned the object out",
                     TakeJudgement([](const Judgement& judgement) {
                       return JsonNumber(judgement.breaking_moment);
                     })});
  columns.push_back(
      {"volume", "number", "N^6", "of the wrench hull at the end of the hold, ferrari-canny",
       TakeJudgement([](const Judgement& judgement) { return JsonNumber(judgement.volume); })});
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

/** Looks up a number of the digit's contact and touch; null when it takes no part. */
template <class Take>
Value TakeOfDigit(const std::string& digit, Take take) {
  return [digit, take](const TrialRecord& record) {
    const TrialResult& result = record.result;
    for (size_t i = 0; i < result.contacts.size(); ++i) {
      if (result.contacts[i].digit == digit) {
        return JsonNumber(take(result.contacts[i], result.touches[i]));
      }
    }
    return Json();
  };
}

void AddDigitColumns(const std::string& digit, std::vector<TrialColumn>& columns) {
  columns.push_back(
      {"t_" + digit + "_s", "number", "s",
       "first contact of digit " + digit +
           ", since the start of closure; missing when it never touched or takes no part",
       TakeOfDigit(digit,
                   [](const DigitContact& contact, const DigitTouch&) { return contact.time; })});
  columns.push_back({"closing_" + digit, "number", "",
                     "how far the hand had closed at that contact: 0 pre-grasp, 1 target grasp",
                     TakeOfDigit(digit, [](const DigitContact&, const DigitTouch& touch) {
                       return touch.closing;
                     })});
  columns.push_back(
      {"gap_" + digit + "_m", "number", "m",
       "smallest distance of digit " + digit + " to the object up to lift-off; 0 when it touched",
       TakeOfDigit(digit, [](const DigitContact&, const DigitTouch& touch) {
         return touch.smallest_gap;
       })});
}

/** Columns of what a trial's stability is made of. */
std::vector<TrialColumn> ListStabilityColumns() {
  return {
      {"sigma", "number", "N",
       "stability: smallest pull along the palm's axes that the contacts stand in the hold, as "
       "their forces tell; 0 when the object was lost",
       [](const TrialRecord& record) { return JsonNumber(record.result.stability.sigma); }},
      {"sigma_stabilisation", "number", "N", "the same before lift-off, whatever came later",
       TakePart(&Stability::stabilisation, &StabilityPart::sigma)},
      {"sigma_lift", "number", "N", "the same over lift-off",
       TakePart(&Stability::lift, &StabilityPart::sigma)},
      {"sigma_proposed", "number", "",
       "the formula proposed first: epsilon times normal force by weight, less for slip and for "
       "missing opposition, before lift-off",
       [](const TrialRecord& record) {
         return JsonNumber(record.result.stability.sigma_proposed);
       }},
      {"epsilon", "number", "",
       "mean quality before lift-off, convention ferrari-canny: mixed cones of 8 edges, unit "
       "normal "
       "force, moments about the centre of mass divided by the object's radius",
       TakePart(&Stability::stabilisation, &StabilityPart::quality)},
      {"epsilon_hold", "number", "", "the same over the hold",
       TakePart(&Stability::hold, &StabilityPart::quality)},
      {"normal_force_n", "number", "N", "mean sum of the normal forces before lift-off",
       TakePart(&Stability::stabilisation, &StabilityPart::normal_force)},
      {"slip_speed_m_per_s", "number", "m/s", "mean speed against the hand before lift-off",
       TakePart(&Stability::stabilisation, &StabilityPart::slip_speed)},
      {"opposition", "number", "",
       "share of the time before lift-off in which opposed digits touched",
       TakePart(&Stability::stabilisation, &StabilityPart::opposition)}};
}

/** The fields of the result that have a column, in their order; the stability has many. */
struct ResultColumns {
  std::vector<TrialColumn>& columns;

  template <class T>
  void operator()(const char* key, T TrialResult::*member, const FieldColumn& about) const {
    columns.push_back(MakeFieldColumn<TrialRecord>(
        key, member, about,
        [](const TrialRecord& record) -> const TrialResult& { return record.result; }));
  }
  void operator()(const char*, Stability TrialResult::*) const {
    for (TrialColumn& column : ListStabilityColumns()) columns.push_back(std::move(column));
  }
  template <class... Other>
  void operator()(const char*, const Other&...) const {}
};

}  // namespace

std::string NameEpsilonColumn(const QualityConvention& convention) {
  std::string name = "epsilon_" + convention.id;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<TrialColumn> ListTrialColumns(const std::vector<TrialRecord>& records) {
  const auto is_success = [](const TrialRecord& record) {
    return Json(IsSuccess(record.result.outcome) ? 1 : 0);
  };
  std::vector<TrialColumn> columns = {
      {"trial_id", "string", "", "hash of everything that matters for the result",
       TakePlan(&PlannedTrial::id)},
      {"hand", "string", "", "id of the hand", TakePlan(&PlannedTrial::hand)},
      {"object", "string", "", "id of the object", TakePlan(&PlannedTrial::object)},
      {"grasp", "string", "", "id of the standard grasp, g1 to g5, or of an optimised one",
       TakePlan(&PlannedTrial::grasp)},
      {"trial", "integer", "", "number of the trial within its hand, object and grasp, from 0",
       [](const TrialRecord& record) { return Json(record.plan.trial); }},
      {"outcome", "string", "", "how the trial ended",
       [](const TrialRecord& record) { return Json(NameOf(record.result.outcome)); }},
      {"success", "boolean", "", "1 when the outcome is success, else 0", is_success},
      {"gct_s", "number", "s", "grasp closure time: start of closure to the last first contact",
       TakeTiming(&ContactTiming::gct)},
      {"gft_s", "number", "s", "grasp forming time: first to last of the first contacts",
       TakeTiming(&ContactTiming::gft)},
      {"got_s", "number", "s", "grasp opposing time: between the thumb and the earliest finger",
       TakeTiming(&ContactTiming::got)},
      {"gft_ratio", "number", "", "gft_s / gct_s", TakeTiming(&ContactTiming::gft_ratio)},
      {"got_ratio", "number", "", "got_s / gct_s", TakeTiming(&ContactTiming::got_ratio)},
      {"contact_before_start", "boolean", "",
       "1 when a digit touched before closure began: its times compare with no other trial's, and "
       "the medians of the report leave them out",
       [](const TrialRecord& record) {
         return Json(record.result.timing.contact_before_start ? 1 : 0);
       }},
      {"contact_order", "string", "",
       "grasping digits by first contact: < before, = less than a step of the physics apart; "
       "digits "
       "that never touched are left out",
       [](const TrialRecord& record) { return Json(FindContactOrder(record.result).Format()); }},
  };
  TrialResult::ListFields(ResultColumns{columns});
  AddJudgementColumns(columns);
  for (const std::string& digit : ListDigits(records)) {
    AddDigitColumns(digit, columns);
  }
  columns.push_back({"reason", "string", "", "why it ended so, for a person; empty for a success",
                     [](const TrialRecord& record) { return Json(record.result.reason); }});
  return columns;
}

std::vector<EventRow> ListEvents(const std::vector<TrialRecord>& records) {
  std::vector<EventRow> rows;
  for (const TrialRecord& record : records) {
    const ContactOrder order = FindContactOrder(record.result);
    std::set<std::string> touched;
    for (const ContactEvent& event : record.result.contact_events) {
      const bool is_first =
          event.kind == ContactEventKind::kTouch && touched.insert(event.digit).second;
      rows.push_back({&record, &event, is_first ? order.FindRank(event.digit) : 0});
    }
  }
  return rows;
}

std::vector<CsvColumn<EventRow>> ListEventColumns() {
  const auto take_plan = [](std::string PlannedTrial::*field) {
    return [field](const EventRow& row) { return Json(row.record->plan.*field); };
  };
  return {{"trial_id", "string", "", "as in trials.csv", take_plan(&PlannedTrial::id)},
          {"hand", "string", "", "id of the hand", take_plan(&PlannedTrial::hand)},
          {"object", "string", "", "id of the object", take_plan(&PlannedTrial::object)},
          {"grasp", "string", "", "id of the grasp", take_plan(&PlannedTrial::grasp)},
          {"trial", "integer", "", "number of the trial in its cell, from 0",
           [](const EventRow& row) { return Json(row.record->plan.trial); }},
          {"time_s", "number", "s", "since the start of closure",
           [](const EventRow& row) { return JsonNumber(row.event->time); }},
          {"digit", "string", "", "id of the digit; palm: none",
           [](const EventRow& row) { return Json(row.event->digit); }},
          {"link", "string", "", "name of the hand's link",
           [](const EventRow& row) { return Json(row.event->link); }},
          {"event", "string", "", "touch, lost, regained or slip",
           [](const EventRow& row) { return Json(NameOf(row.event->kind)); }},
          {"impulse_ns", "number", "N s", "normal impulse on the object of the touch that was lost",
           [](const EventRow& row) { return JsonNumber(row.event->impulse); }},
          {"contact_rank", "integer", "",
           "on the first touch of a grasping digit: its place in contact_order, 1 first, tied "
           "digits alike",
           [](const EventRow& row) { return row.rank > 0 ? Json(row.rank) : Json(); }}};
}

}  // namespace graspbench
