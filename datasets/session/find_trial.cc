#include "datasets/session/find_trial.h"

#include <algorithm>
#include <limits>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/text/text.h"
#include "datasets/journal/store_kind.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

void CheckIsExperimentOn(const Session& session, const Session& experiment,
                         const std::string& name) {
  SessionConfig config = experiment.config;
  config.trials = session.config.trials;
  config.conditions = session.config.conditions;
  // Schedules are grasps of their own, made from the session's.
  if (name.rfind("schedules/", 0) == 0) config.grasps = session.config.grasps;
  const std::string text = ListDifferences(FindConfigDifferences(session.config, config));
  if (text.empty()) return;
  throw Error(ErrorKind::kFormat, "\"" + name +
                                      "\" is an experiment on another session (this one and "
                                      "that):" +
                                      text + "\nmove that folder elsewhere");
}

std::vector<Session> LoadExperiments(const Session& session, const std::string& kind) {
  std::vector<Session> experiments;
  if (session.folder.empty()) return experiments;
  for (const std::string& name : ListMatches(session.folder, {kind + "/*"})) {
    if (!HasSession(session.folder / name)) continue;
    experiments.push_back(
        LoadSession(session.folder / name, OnDamage::kAccept, RecordParts::kBrief));
    CheckIsExperimentOn(session, experiments.back(), name);
  }
  return experiments;
}

namespace {

constexpr size_t kMinLetters = 4;  // of an id that is cut short

const std::string& HowToName() {
  static const std::string text =
      "; name a trial by its trial_id (column of trials.csv), by at least its first four letters, "
      "or as tum-can-g2:3 (hand, object, grasp, number); in a sweep with its condition, "
      "tum-can-g2:3@model.mass_scale=2.0";
  return text;
}

std::string NameCell(const PlannedTrial& planned) {
  return MakePlainKey({planned.hand, planned.object, planned.grasp});
}

/** The key of the cell that a person may have called by its ids alone, as "tum-can-new-target",
whose key has a hash. */
std::string FindCell(const Session& session, const std::string& name) {
  std::vector<std::string> keys;
  for (const PlannedTrial& planned : session.plan) {
    const std::string key = NameCell(planned);
    if (key == name) return name;
    if (ToLower(planned.hand + "-" + planned.object + "-" + planned.grasp) != name) continue;
    if (keys.empty() || keys.back() != key) keys.push_back(key);
  }
  return keys.size() == 1 ? keys.front() : name;
}

/** The trial of that name, in whatever case where no other has it; null: none.
@throws Error(kUsage) where several names differ from it in their case alone. */
const PlannedTrial* FindByName(const Session& session, const std::string& given,
                               const std::string& lower) {
  std::vector<const PlannedTrial*> found;
  for (const PlannedTrial& planned : session.plan) {
    const std::string name = NameTrial(planned);
    if (name == given) return &planned;
    if (ToLower(name) == lower) found.push_back(&planned);
  }
  if (found.size() > 1) {
    throw Error(ErrorKind::kUsage,
                "\"" + given + "\" is " + NameTrial(*found[0]) + " and " + NameTrial(*found[1]) +
                    ", which differ only in capital letters; use the exact spelling");
  }
  return found.empty() ? nullptr : found.front();
}

/** @throws Error(kNotFound) for a cell or number that is not in the plan. */
const PlannedTrial& FindByNumber(const Session& session, const std::string& given) {
  const std::string name = ToLower(given);
  const std::string cell = FindCell(session, name.substr(0, name.find(':')));
  const std::string number = name.substr(name.find(':') + 1);
  if (const PlannedTrial* found = FindByName(session, given, cell + name.substr(name.find(':')))) {
    return *found;
  }
  std::vector<std::string> cells;
  std::string under_conditions;
  int num_trials = 0;
  for (const PlannedTrial& planned : session.plan) {
    const std::string key = NameCell(planned);
    if (key == cell && !planned.condition) ++num_trials;
    if (key == cell && planned.condition && std::to_string(planned.trial) == number) {
      under_conditions += (under_conditions.empty() ? "" : ", ") + NameTrial(planned);
    }
    if (std::find(cells.begin(), cells.end(), key) == cells.end()) cells.push_back(key);
  }
  if (num_trials > 0) {
    throw Error(ErrorKind::kNotFound, "\"" + name + "\": the session has " + cell + ":0 to " +
                                          cell + ":" + std::to_string(num_trials - 1));
  }
  if (!under_conditions.empty()) {
    throw Error(ErrorKind::kNotFound, "the base of the sweep has no \"" + name +
                                          "\", its conditions have: " + under_conditions);
  }
  throw Error(ErrorKind::kNotFound, "the session has no condition \"" + cell + "\"" +
                                        SuggestNames(cell, cells) + HowToName());
}

}  // namespace

std::string NameTrial(const PlannedTrial& planned) {
  return NameCell(planned) + ":" + std::to_string(planned.trial) +
         (planned.condition ? "@" + *planned.condition : "");
}

namespace {

/** "; did you mean tum-can-g2:0 or tum-can-g3:0?": trials of conditions whose name begins so. */
std::string SuggestTrials(const Session& session, const std::string& name) {
  constexpr size_t kMostNamed = 4;
  std::vector<std::string> trials;
  for (const PlannedTrial& planned : session.plan) {
    const std::string trial = planned.hand + "-" + planned.object + "-" + planned.grasp + ":0";
    if (planned.condition || ToLower(trial).rfind(name, 0) != 0) continue;
    if (std::find(trials.begin(), trials.end(), trial) == trials.end()) trials.push_back(trial);
  }
  if (name.empty() || trials.empty()) return "";
  std::string text;
  for (size_t i = 0; i < std::min(trials.size(), kMostNamed); ++i) {
    text += (i == 0 ? "; did you mean " : " or ") + trials[i];
  }
  return text + (trials.size() > kMostNamed ? " ..?" : "?");
}

}  // namespace

const PlannedTrial& FindPlannedTrial(const Session& session, const std::string& given) {
  const std::string name = ToLower(given);
  if (name.find(':') != name.npos) return FindByNumber(session, given);
  const PlannedTrial* found = nullptr;
  for (const PlannedTrial& planned : session.plan) {
    if (planned.id == name) return planned;
    if (name.size() < kMinLetters || planned.id.compare(0, name.size(), name) != 0) continue;
    if (found) {
      throw Error(ErrorKind::kUsage, "several trials begin with \"" + given + "\": " + found->id +
                                         " (" + NameTrial(*found) + "), " + planned.id + " (" +
                                         NameTrial(planned) + ")");
    }
    found = &planned;
  }
  if (found) return *found;
  throw Error(ErrorKind::kNotFound, "the session has no trial \"" + given + "\"" +
                                        SuggestTrials(session, name) + HowToName());
}

const TrialRecord* FindRecord(const Session& session, const PlannedTrial& planned) {
  const auto found = std::find_if(session.records.begin(), session.records.end(),
                                  [&](const TrialRecord& r) { return r.plan.id == planned.id; });
  return found == session.records.end() ? nullptr : &*found;
}

std::shared_ptr<HandPolicy> FindRecordedPolicy(const Session& session,
                                               const PlannedTrial& planned) {
  const TrialRecord* record = FindRecord(session, planned);
  if (!record || !record->result.policy) return nullptr;
  return MakeRecordedPolicy(*LoadWhole(session, *record).result.policy);
}

TrialSetup MakeRecordedSetup(const Session& session, const SessionInputs& inputs,
                             const PlannedTrial& planned) {
  TrialSetup setup = MakeTrialSetup(session.config, inputs, planned);
  if (!setup.policy.command.empty()) setup.controller = FindRecordedPolicy(session, planned);
  return setup;
}

NearestSuccess FindNearestSuccess(const Session& session, const PlannedTrial& planned,
                                  double radius) {
  const auto draw = [&](int trial) {
    return MakeObjectDraw(session.config, planned.object, trial);
  };
  const TrialDraw own = draw(planned.trial);
  NearestSuccess nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  for (const TrialRecord& record : session.records) {
    const bool is_of_cell = record.plan.hand == planned.hand &&
                            record.plan.object == planned.object &&
                            record.plan.grasp == planned.grasp;
    if (!is_of_cell || record.plan.id == planned.id || !IsSuccess(record.result.outcome)) continue;
    const double distance = CalcDrawDistance(own, draw(record.plan.trial), radius);
    if (distance < nearest.distance) nearest = {&record, distance};
  }
  return nearest;
}

SessionInputs LoadTrialInputs(const Session& session, const PlannedTrial& planned) {
  SessionConfig config = session.config;
  const auto is_other = [&](const Condition& condition) {
    return planned.condition != condition.name;
  };
  config.conditions.erase(
      std::remove_if(config.conditions.begin(), config.conditions.end(), is_other),
      config.conditions.end());
  // A name may also be a path, whose hand or object is known only once it is loaded; and every grasp
  // file needs its hand.
  const auto narrow = [](std::vector<std::string>& names, const std::string& id) {
    const bool is_listed = std::find(names.begin(), names.end(), id) != names.end();
    if (is_listed || names == std::vector<std::string>{"all"}) names = {id};
  };
  narrow(config.objects, planned.object);
  const auto needs_hands = [&](const std::string& grasp) {
    return IsGraspFile(grasp) || !ListSceneGrasps(grasp, session.folder).empty();
  };
  if (std::none_of(config.grasps.begin(), config.grasps.end(), needs_hands)) {
    narrow(config.hands, planned.hand);
  }
  return LoadSessionInputs(config, FieldUse::kLater, session.folder);
}

}  // namespace graspbench
