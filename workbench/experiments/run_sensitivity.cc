#include "workbench/experiments/run_sensitivity.h"

#include <algorithm>
#include <map>
#include <memory>

#include "core/base/config.h"
#include "core/base/error.h"
#include "datasets/session/sensitivity_store.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/numerics_check.h"
#include "workbench/experiments/pool/session_worker.h"

namespace graspbench {
namespace {

/** A number and what it is multiplied by. */
struct Factors {
  const char* key;
  std::vector<double> factors;
};
const std::vector<Factors> kFactors = {
    {"variation.offset_m", {0.0, 2.0}},
    {"variation.yaw_rad", {0.0, 2.0}},
    {"model.joint_error_scale", {0.0, 2.0}},
    {"model.pad_torsion_scale", {0.5, 2.0}},
    {"model.friction_scale", {0.8, 1.25}},
    {"model.mass_scale", {0.5, 2.0}},
    {"model.drive_torque_scale", {0.5, 2.0}},
    {"sim.contact_stiffness_n_per_m", {0.5, 2.0}},
    {"sim.tangential_stiffness_n_per_m", {0.5, 2.0}},
    {"sim.arm_stiffness_n_per_m", {0.5, 2.0}},
};

std::vector<std::string> FindSettings(const SensitivityRequest& request,
                                      const SessionConfig& config) {
  if (request.settings.empty()) return ListDefaultVariations(config);
  std::vector<std::string> settings;
  for (const std::string& assignment : request.settings) {
    const std::string setting = NormaliseSetting(assignment, config);
    if (std::find(settings.begin(), settings.end(), setting) != settings.end()) {
      throw Error(ErrorKind::kUsage, "\"" + setting + "\" is named twice; leave one out");
    }
    settings.push_back(setting);
  }
  return settings;
}

/** The trials of one setting. */
class Variation {
 public:
  Variation(const Session& session, const std::string& setting) : setting_(setting) {
    config_ = session.config;
    ApplySetting(setting, config_);
    config_ = SessionConfigFromJson(ToJson(config_), setting);  // without what is not used now
    CheckSessionConfig(config_);
    inputs_ = LoadSessionInputs(config_, FieldUse::kLater, session.folder);
    const std::vector<PlannedTrial> plan = MakePlan(config_, inputs_);
    GRASPBENCH_DEMAND(plan.size() == session.plan.size(), setting);
    for (size_t i = 0; i < plan.size(); ++i) {
      varied_.emplace(session.plan[i].id, plan[i]);
      original_.emplace(plan[i].id, session.plan[i].id);
    }
  }

  const PlannedTrial& Vary(const PlannedTrial& planned) const { return varied_.at(planned.id); }

  MakeBatchWorker MakeWorkers(const std::filesystem::path& folder) const {
    return [this, folder](int worker) {
      const auto runner = std::make_shared<PlannedTrialRunner>(config_, inputs_);
      const auto writer = std::make_shared<SensitivityWriter>(folder, worker);
      return BatchWorker{[runner](const PlannedTrial& planned) { return runner->Run(planned); },
                         [this, writer](const TrialRecord& record) {
                           writer->Append(setting_, original_.at(record.plan.id),
                                          MakeTrialMeasures(record.result));
                         },
                         {},
                         [runner](const PlannedTrial& planned) { runner->Prepare(planned); }};
    };
  }

 private:
  std::string setting_;
  SessionConfig config_;
  SessionInputs inputs_;
  std::map<std::string, PlannedTrial> varied_;   // by the id in the session
  std::map<std::string, std::string> original_;  // the other way round
};

}  // namespace

std::vector<std::string> ListDefaultVariations(const SessionConfig& config) {
  std::vector<std::string> settings;
  const auto add = [&](const std::string& assignment) {
    SessionConfig changed = config;
    ApplySetting(assignment, changed);
    if (FindConfigDifferences(config, changed).empty() || !Validate(changed).empty()) return;
    settings.push_back(NormaliseSetting(assignment, config));
  };
  const Json json = ToJson(config);
  for (const Factors& row : kFactors) {
    const std::string key = row.key;
    const size_t dot = key.find('.');
    const double value = json.at(key.substr(0, dot)).at(key.substr(dot + 1)).get<double>();
    for (const double factor : row.factors) add(key + "=" + FormatJson(factor * value));
  }
  for (const std::string& rule : ListModelCouplings()) add("model.coupling_rule=" + rule);
  return settings;
}

bool RunSensitivity(const SensitivityRequest& request, int num_workers, Observer& observer,
                    const std::atomic<bool>& stop) {
  Session session = LoadSession(request.folder, request.on_damage, RecordParts::kBrief);
  const std::vector<std::string> settings = FindSettings(request, session.config);
  CheckSameSession(session, session.config,
                   MakePlan(session.config,
                            LoadSessionInputs(session.config, FieldUse::kLater, request.folder)));
  std::vector<TrialRecord> trials = session.records;
  if (request.trials_per_cell > 0) trials = ChooseTrials(trials, request.trials_per_cell);
  if (trials.empty()) {
    throw Error(ErrorKind::kUsage, "the session in \"" + request.folder.string() +
                                       "\" has no finished trial; graspbench run --resume --out " +
                                       QuoteForShell(request.folder.string()) + " runs them");
  }
  SensitivityData data = LoadSensitivity(session, session.findings);
  SealStore(kSessionStore, request.folder);
  bool is_complete = true;
  for (const std::string& setting : settings) {
    const Variation variation(session, setting);
    std::vector<PlannedTrial> unfinished;
    for (const TrialRecord& trial : trials) {
      if (data[setting].count(trial.plan.id) == 0) unfinished.push_back(variation.Vary(trial.plan));
    }
    if (unfinished.empty()) continue;
    Stage stage;
    stage.kind = StageKind::kVariant;
    stage.variant = setting;
    stage.num_all = stage.num_left = stage.num_trials = static_cast<int>(unfinished.size());
    is_complete =
        RunBatchStage(stage, unfinished, num_workers, variation.MakeWorkers(request.folder),
                      observer, stop, request.trial_time_limit);
    if (!is_complete) break;
  }
  SealStore(kSessionStore, request.folder);
  return is_complete;
}

}  // namespace graspbench
