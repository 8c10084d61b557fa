#include "workbench/experiments/scene_runner.h"

#include <algorithm>
#include <optional>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/grasp/grasp_file.h"
#include "datasets/plan/grasp_choice.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/plan/session_plan.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace {

void CheckSameQuestion(const SceneConfig& config, const EvaluationRecord& stored,
                       const EvaluationRecord& asked) {
  if (stored.stage == asked.stage && stored.trial_ids == asked.trial_ids) return;
  throw Error(ErrorKind::kUsage, "the journal of " + config.hand + ", " + config.object + ", " +
                                     config.grasp +
                                     " was started with another version of the hand, the object, "
                                     "the physics or the program; optimise into a new folder");
}

/** A session of one trial of the scene. */
SessionConfig MakeSessionConfig(const SceneConfig& config) {
  SessionConfig session;
  static_cast<TrialConditions&>(session) = config;
  session.hands = {config.hand};
  session.objects = {config.object};
  session.grasps = {config.grasp};
  session.trials = 1;
  return session;
}

}  // namespace

RunLearningTrials MakeJournaledTrials(const SceneConfig& config, const SceneInputs& inputs,
                                      EvaluationJournal& journal, TrialPool& pool,
                                      const ObserveLearning& observe) {
  return [&config, &inputs, &journal, &pool,
          observe](const std::vector<LearningRequest>& requests) {
    std::vector<EvaluationRecord> questions;
    for (const LearningRequest& request : requests) {
      EvaluationRecord& question = questions.emplace_back();
      question.stage = request.stage;
      question.individual = request.individual;
      for (const int draw : request.draws) {
        question.trial_ids.push_back(CalcLearningTrialId(config, inputs, request, draw));
      }
    }
    const auto recall = [&](size_t i, const EvaluationRecord& stored) {
      CheckSameQuestion(config, stored, questions[i]);
      for (const LearningTrial& trial : stored.trials) observe(requests[i], trial);
    };
    const auto simulate = [&](std::vector<EvaluationRecord>& records,
                              const std::vector<size_t>& left) {
      std::vector<TrialSetup> setups;
      std::vector<std::pair<size_t, int>> asked;  // request and draw of each setup
      for (const size_t i : left) {
        for (const int draw : requests[i].draws) {
          setups.push_back(MakeLearningSetup(config, inputs, requests[i], draw));
          asked.push_back({i, draw});
        }
      }
      const std::vector<TrialResult> results =
          pool.Run(setups, [&](size_t setup, const TrialResult& result) {
            const auto [request, draw] = asked[setup];
            observe(requests[request], MakeLearningTrial(draw, result, false));
          });
      for (size_t k = 0; k < asked.size(); ++k) {
        const auto [i, draw] = asked[k];
        records[i].trials.push_back(MakeLearningTrial(draw, results[k], requests[i].keep_postures));
      }
    };
    return journal.Answer(questions, recall, simulate);
  };
}

SceneInputs LoadSceneInputs(SceneConfig& config, const std::filesystem::path& folder) {
  if (IsGraspFile(config.grasp)) {
    throw Error(ErrorKind::kUsage, "\"" + config.grasp +
                                       "\" is a grasp file; optimisation starts from a standard "
                                       "grasp of the hand: give its id, or best. To compare the "
                                       "result with this file: graspbench run --grasp " +
                                       config.grasp + ",DIR/new-target.yaml");
  }
  if (config.grasp == kBySight) {
    throw Error(ErrorKind::kUsage,
                "by-sight chooses a grasp in each trial; optimisation needs the id of a standard "
                "grasp of the hand, or best");
  }
  if (ParseRehearsed(config.grasp)) {
    throw Error(ErrorKind::kUsage,
                "rehearsed chooses a grasp with its placement; optimisation needs the id of a "
                "standard grasp of the hand, or best");
  }
  const SessionConfig session = MakeSessionConfig(config);
  const SessionInputs inputs = LoadSessionInputs(session, FieldUse::kNow, folder);
  const PlannedTrial planned = MakePlan(session, inputs).front();
  config.grasp = planned.grasp;
  const TrialSetup setup = MakeTrialSetup(session, inputs, planned);
  return {setup.hand, setup.object, setup.grasp};
}

OptimisedGrasp RunScene(const std::filesystem::path& folder, const SceneConfig& config,
                        const SceneInputs& inputs, TrialPool& pool,
                        const ObserveLearning& observe) {
  CreateScene(folder, config);
  EvaluationJournal journal(folder / "journal.jsonl");
  try {
    const OptimisedGrasp optimised =
        OptimiseGrasp(*inputs.hand, *inputs.object, inputs.grasp, config.optimise,
                      MakeJournaledTrials(config, inputs, journal, pool, observe));
    WriteSceneResult(folder, config, inputs, optimised);
    return optimised;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) SealStore(kSceneStore, folder);
    throw;
  }
}

void PlanScene(const std::filesystem::path& folder, const SceneConfig& config) {
  if (HasScene(folder)) return CreateScene(folder, config);  // the same one, or an error
  StagedFolder staged({folder, "", false, {}});
  CopyInputs(MakeSessionConfig(config), staged.path());
  CreateScene(staged.path(), config);
  staged.Commit();
}

OptimisedGrasp RunSceneStage(const std::filesystem::path& folder, const SceneConfig& config,
                             const SceneInputs& inputs, int num_workers, Observer& observer,
                             double trial_time_limit) {
  if (!HasScene(folder)) PlanScene(folder, config);
  Stage stage = MakeStage(StageKind::kOptimisation, 1);
  stage.num_trials = CountLearningTrials(config.optimise);
  observer.BeginStage(stage);
  TrialPool pool(num_workers, observer.stop(), trial_time_limit);
  BatchStatus status;
  const auto observe = [&](const LearningRequest& request, const LearningTrial& trial) {
    ++status.num_done;
    ++status.outcomes[trial.outcome];
    status.busy = {PlannedTrial{"", inputs.hand->id, inputs.object->id,
                                config.grasp + "  " + NameOf(request.stage),
                                request.individual.number}};
    observer.ShowStatus(status, std::max(stage.num_trials, status.num_done));
  };
  OptimisedGrasp optimised = RunScene(folder, config, inputs, pool, observe);
  observer.ShowStatus(status, status.num_done);
  observer.EndStage();
  return optimised;
}

void RunComparisonSearch(const ComparisonTask& task, TrialPool& pool,
                         const ObserveLearning& observe) {
  const CampaignScene& scene = *task.scene;
  Grasp start = LoadSceneGrasp(scene.folder, kNewPreGrasp, *scene.inputs.hand);
  start.id = NameOf(kNewTarget);
  EvaluationJournal journal(task.journal);
  SearchTarget(*scene.inputs.hand, *scene.inputs.object, start, task.config.optimise,
               MakeJournaledTrials(task.config, scene.inputs, journal, pool, observe));
}

ReplayedIndividual ReplayIndividual(const std::filesystem::path& folder, int number,
                                    TrialPool& pool) {
  SceneRecord scene = LoadScene(folder);
  if (scene.result.is_null()) {
    throw Error(ErrorKind::kUsage, "the optimisation in \"" + folder.string() +
                                       "\" is not finished; finish it, then replay");
  }
  const SceneInputs inputs = LoadSceneInputs(scene.config, folder);
  // The optimisation leads to the individual when it gets its stored answers again.
  std::optional<LearningRequest> request;
  int next = 0;
  const EvaluationRecord* stored_answer = nullptr;
  const auto answer = [&](const std::vector<LearningRequest>& requests) {
    std::vector<std::vector<LearningTrial>> trials;
    for (const LearningRequest& asked : requests) {
      const EvaluationRecord* stored = FindAnswer(scene.evaluations, next++);
      if (!stored) {
        throw Error(ErrorKind::kFormat, "the journal in \"" + folder.string() +
                                            "\" lacks an evaluation; continue the optimisation, "
                                            "then replay");
      }
      if (asked.stage == LearningStage::kSearch && asked.individual.number == number) {
        request = asked;
        stored_answer = stored;
      }
      trials.push_back(stored->trials);
    }
    return trials;
  };
  OptimiseGrasp(*inputs.hand, *inputs.object, inputs.grasp, scene.config.optimise, answer);
  if (!request) {
    throw Error(ErrorKind::kNotFound,
                "no individual " + std::to_string(number) + " in \"" + folder.string() + "\"");
  }
  const EvaluationRecord& stored = *stored_answer;
  std::vector<TrialSetup> setups;
  for (const int draw : request->draws) {
    setups.push_back(MakeLearningSetup(scene.config, inputs, *request, draw));
  }
  EvaluationRecord again = stored;
  again.trials.clear();
  for (const TrialResult& result : pool.Run(setups)) {
    again.trials.push_back(
        MakeLearningTrial(request->draws[again.trials.size()], result, request->keep_postures));
  }
  ReplayedIndividual replayed;
  replayed.grasp = request->grasp;
  replayed.grasp.id = "individual-" + std::to_string(number);
  replayed.stored_fitness = CalcFitness(stored.trials);
  replayed.fitness = CalcFitness(again.trials);
  replayed.is_same = EvaluationRecord::Format(stored) == EvaluationRecord::Format(again);
  return replayed;
}

std::filesystem::path SaveReplayed(const std::filesystem::path& folder,
                                   const ReplayedIndividual& replayed) {
  SceneConfig config = LoadScene(folder).config;
  const SceneInputs inputs = LoadSceneInputs(config, folder);
  const std::filesystem::path path = folder / (replayed.grasp.id + ".yaml");
  WriteFileAtomically(path, FormatGraspFile(*inputs.hand, replayed.grasp, config.grasp));
  return path;
}

std::filesystem::path NameSceneFolder(const SceneConfig& config, const SceneInputs& inputs) {
  const std::string hash = CalcHashHex(FormatJson(ConfigToJson(config))).substr(0, 8);
  return std::filesystem::path("results") /
         ("optimise-" + inputs.hand->id + "-" + inputs.object->id + "-" + hash);
}

}  // namespace graspbench
