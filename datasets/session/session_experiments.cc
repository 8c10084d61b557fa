#include "datasets/session/session_experiments.h"

#include "core/base/config.h"
#include "core/base/error.h"
#include "datasets/journal/store_kind.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/session/session_store.h"

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

}  // namespace graspbench
