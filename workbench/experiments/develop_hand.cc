#include "workbench/experiments/develop_hand.h"

#include <algorithm>
#include <memory>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/develop/write_grasps.h"
#include "core/hand/hand.h"
#include "core/hand/load_hand.h"
#include "core/shape/synthetic_shapes.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/plan/session_plan.h"
#include "datasets/scene/development_store.h"
#include "objects/catalogue.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kDevelopment[] = "development";
constexpr int kNumDrawn = 800;         ///< proposals of a grasp, by geometry alone
constexpr int kNumKept = 32;           ///< of these
constexpr double kLargestShape = 0.8;  ///< of the widest opening that was proposed
constexpr double kHoldTime = 0.7;      ///< shorter than the benchmark's: what slips, slips soon [s]
constexpr double kPlacingTime = 0.5;   ///< likewise: nothing is touched meanwhile [s]
/** Of the grip, and of its margin beyond 1, by turn: the mean score of trials that ask less and
less is higher the lower the threshold of grip is. */
constexpr double kGripShares[] = {1.0, 0.5, 1.0, 0.25};

/** The hand, and for a coupling that is not known the same with the other rules, its own in turn
with each of them. */
std::vector<std::shared_ptr<const Hand>> MakeCoupledHands(const std::shared_ptr<const Hand>& own,
                                                          bool any_coupling) {
  std::vector<std::shared_ptr<const Hand>> hands = {own};
  const bool has_pairs = std::any_of(own->joints.begin(), own->joints.end(), [](const auto& joint) {
    return joint.coupled_to >= 0 && !joint.is_mimic;
  });
  if (!any_coupling || !has_pairs) return hands;
  hands.clear();
  for (const CouplingRule rule : ListCouplingRules()) {
    if (rule == own->coupling) continue;
    auto other = std::make_shared<Hand>(*own);
    other->coupling = rule;
    hands.push_back(own);
    hands.push_back(std::move(other));
  }
  return hands;
}

/** Answers what the development of one grasp asks: from the journal, else by simulation. */
class GraspTrials {
 public:
  GraspTrials(std::shared_ptr<const Hand> hand, const DevelopmentConfig& config,
              std::vector<std::shared_ptr<const GraspObject>> shapes, DevelopmentJournal& journal,
              TrialPool& pool)
      : hand_(std::move(hand)),
        coupled_hands_(MakeCoupledHands(hand_, config.develop.any_coupling)),
        config_(config),
        shapes_(std::move(shapes)),
        journal_(journal),
        pool_(pool) {}

  /** Adds what had to be simulated to `work`. */
  std::vector<std::vector<DevelopTrial>> Run(const std::vector<DevelopRequest>& requests,
                                             double& work) {
    std::vector<DevelopmentRecord> questions;
    for (const DevelopRequest& request : requests) {
      questions.push_back({0, request.stage, CalcId(request), {}});
    }
    const auto recall = [&](size_t i, const DevelopmentRecord& stored) {
      CheckSame(stored, questions[i]);
    };
    const auto simulate = [&](std::vector<DevelopmentRecord>& records,
                              const std::vector<size_t>& left) {
      for (const size_t i : left) work += static_cast<double>(requests[i].trials.size());
      Simulate(requests, left, records);
    };
    return journal_.Answer(questions, recall, simulate);
  }

 private:
  std::string CalcId(const DevelopRequest& request) const {
    Json trials = Json::array();
    for (const DevelopRequest::Trial& trial : request.trials) {
      trials.push_back({shapes_[static_cast<size_t>(trial.shape)]->content_hash, trial.draw});
    }
    return CalcHashHex(FormatJson({{"physics", kPhysicsVersion},
                                   {"hand", hand_->content_hash},
                                   {"grasp", ToJson(request.grasp)},
                                   {"trials", trials}}));
  }

  static void CheckSame(const DevelopmentRecord& stored, const DevelopmentRecord& asked) {
    if (stored.stage == asked.stage && stored.id == asked.id) return;
    throw Error(ErrorKind::kUsage,
                "this development was started with another version of the hand, the physics or the "
                "program; develop into a new folder");
  }

  TrialSetup MakeSetup(const DevelopRequest& request, const DevelopRequest::Trial& trial) const {
    const auto turn = static_cast<size_t>(trial.shape + trial.draw);
    TrialSetup setup;
    setup.hand = coupled_hands_[turn % coupled_hands_.size()];
    setup.object = shapes_[static_cast<size_t>(trial.shape)];
    setup.grasp = request.grasp;
    ApplyCoupling(*setup.hand, setup.grasp.q_pre);
    ApplyCoupling(*setup.hand, setup.grasp.q_target);
    setup.strategy = config_.strategy;
    // Not in step with the couplings, which are as many.
    const double grip =
        kGripShares[(turn + static_cast<size_t>(trial.shape) / 4) % std::size(kGripShares)];
    setup.strategy.grip_force *= grip;
    setup.strategy.grip_margin = 1.0 + grip * (setup.strategy.grip_margin - 1.0);
    setup.sim = config_.sim;
    const Json names = {config_.develop.seed, setup.object->id, trial.draw};
    setup.draw = DrawVariation(config_.variation, *hand_,
                               RandomStream(FormatJson(names), "object pose of development"),
                               RandomStream(FormatJson(names), "joint error of development"));
    return setup;
  }

  /** Shape by shape, as a worker keeps the world of its last one. */
  void Simulate(const std::vector<DevelopRequest>& requests, const std::vector<size_t>& left,
                std::vector<DevelopmentRecord>& records) {
    struct Place {
      size_t request, trial;
      int shape;
    };
    std::vector<Place> places;
    for (const size_t r : left) {
      for (size_t t = 0; t < requests[r].trials.size(); ++t) {
        places.push_back({r, t, requests[r].trials[t].shape});
      }
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& a, const Place& b) { return a.shape < b.shape; });
    std::vector<TrialSetup> setups;
    for (const Place& place : places) {
      const DevelopRequest& request = requests[place.request];
      setups.push_back(MakeSetup(request, request.trials[place.trial]));
    }
    const std::vector<TrialResult> results = pool_.Run(setups);
    for (size_t k = 0; k < places.size(); ++k) {
      const auto& [r, t, shape] = places[k];
      records[r].trials.resize(requests[r].trials.size());
      records[r].trials[t] =
          MakeDevelopTrial(requests[r].grasp, *shapes_[static_cast<size_t>(shape)], results[k]);
    }
  }

  std::shared_ptr<const Hand> hand_;
  std::vector<std::shared_ptr<const Hand>> coupled_hands_;  // taken in turn
  const DevelopmentConfig& config_;
  std::vector<std::shared_ptr<const GraspObject>> shapes_;
  DevelopmentJournal& journal_;
  TrialPool& pool_;
};

std::vector<const GraspTaxon*> FindTaxa(const Hand& hand) {
  std::vector<const GraspTaxon*> taxa;
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (CanDevelop(hand, taxon)) taxa.push_back(&taxon);
  }
  if (taxa.empty()) {
    throw Error(ErrorKind::kUsage,
                "\"" + hand.id + "\" has " + std::to_string(hand.digits.size()) +
                    " digits; a grasp needs at least two, listed under `digits` of hand.yaml");
  }
  return taxa;
}

/** Twice as much for power, which has most to learn: the palm is to hold, too. */
std::vector<int> ShareBudget(int budget, const std::vector<const GraspTaxon*>& taxa) {
  const auto count_parts = [](const GraspTaxon* taxon) {
    return taxon->type == GraspType::kPower ? 2 : 1;
  };
  int num_parts = 0;
  for (const GraspTaxon* taxon : taxa) num_parts += count_parts(taxon);
  std::vector<int> budgets;
  for (const GraspTaxon* taxon : taxa) budgets.push_back(budget * count_parts(taxon) / num_parts);
  return budgets;
}

/** A new folder with a copy of the hand, or the same development in it. */
void PrepareFolder(const DevelopHandRequest& request, const Hand& hand,
                   const DevelopmentConfig& config) {
  CheckOutside(request.out, hand.folder);
  if (HasDevelopment(request.out / kDevelopment)) {
    CheckSameDevelopment(request.out / kDevelopment, config);
    return;
  }
  StagedFolder staged({request.out, "", false, {hand.folder}});
  GatherHand(hand.folder, staged.path());
  MakeFolder(staged.path() / kDevelopment);
  CreateDevelopment(staged.path() / kDevelopment, config);
  staged.Commit();
}

/** Sizes of the catalogue's objects, which judge hands. */
std::vector<Eigen::Vector3d> ListJudges() {
  std::vector<Eigen::Vector3d> sizes;
  for (const std::string& id : ListObjects()) {
    sizes.push_back(LoadObject(id, FieldUse::kLater)->size);
  }
  return sizes;
}

std::vector<std::shared_ptr<const GraspObject>> MakeAllShapes(
    const GraspTaxon& taxon, int seed, const std::vector<ProposedGrasp>& proposals,
    const std::vector<Eigen::Vector3d>& judges) {
  double widest = 0.0;
  for (const ProposedGrasp& proposed : proposals) {
    if (!proposed.is_own) widest = std::max(widest, proposed.aim.opening);
  }
  std::vector<std::shared_ptr<const GraspObject>> shapes;
  for (const ShapeUse use : {ShapeUse::kTraining, ShapeUse::kValidation}) {
    for (const auto& shape :
         MakeShapes(taxon.id, use, seed, kNumTrainingShapes, kLargestShape * widest, judges)) {
      shapes.push_back(CompleteObject(shape));
    }
  }
  return shapes;
}

}  // namespace

std::vector<DevelopedGrasp> DevelopHand(const DevelopHandRequest& request, Observer& observer) {
  const auto hand = std::make_shared<const Hand>(LoadHand(request.hand));
  const std::vector<const GraspTaxon*> taxa = FindTaxa(*hand);
  DevelopmentConfig config;
  config.hand = hand->id;
  config.hand_content = hand->content_hash;
  config.develop = request.config;
  config.strategy.hold_time = kHoldTime;
  config.strategy.placing_time = kPlacingTime;
  PrepareFolder(request, *hand, config);

  DevelopmentJournal journal(request.out / kDevelopment / "journal.jsonl");
  TrialPool pool(request.num_workers, observer.stop(), request.trial_time_limit);
  Stage stage = MakeStage(StageKind::kDevelopment, taxa.size());
  stage.num_trials = 0;
  const std::vector<int> budgets = ShareBudget(request.config.budget, taxa);
  for (const int budget : budgets) stage.num_trials += CountDevelopTrials(budget);
  observer.BeginStage(stage);
  BatchStatus status;
  const std::vector<Eigen::Vector3d> judges = ListJudges();
  const std::vector<Grasp> owned = LoadStandardGrasps(*hand);
  std::vector<DevelopedGrasp> developed;
  for (size_t k = 0; k < taxa.size(); ++k) {
    const GraspTaxon* taxon = taxa[k];
    const std::string stream = std::to_string(request.config.seed) + " " + taxon->id;
    std::vector<ProposedGrasp> proposals =
        ProposeGrasps(*hand, *taxon, kNumDrawn, kNumKept, request.config.any_coupling,
                      RandomStream(stream, "proposals"));
    if (const auto own = ProposeOwn(*hand, owned, *taxon))
      proposals.insert(proposals.begin(), *own);
    GraspTrials trials(hand, config, MakeAllShapes(*taxon, request.config.seed, proposals, judges),
                       journal, pool);
    double left = CountDevelopTrials(budgets[k]), following = 0.0;
    for (size_t later = k + 1; later < taxa.size(); ++later) {
      following += CountDevelopTrials(budgets[later]);
    }
    const auto run = [&](const std::vector<DevelopRequest>& requests) {
      auto answers = trials.Run(requests, status.work_done);
      for (const DevelopRequest& asked : requests) {
        left -= static_cast<double>(asked.trials.size());
      }
      status.work_left = std::max(0.0, left) + following;
      for (const auto& answer : answers) {
        status.num_done += static_cast<int>(answer.size());
        for (const DevelopTrial& trial : answer) ++status.outcomes[trial.outcome];
      }
      status.busy = {PlannedTrial{"", hand->id, "", taxon->id + "  " + requests.front().stage,
                                  status.num_done}};
      observer.ShowStatus(status, stage.num_trials);
      return answers;
    };
    developed.push_back(DevelopGrasp(*hand, proposals, budgets[k], request.config.seed, run));
  }
  observer.ShowStatus(status, status.num_done);
  observer.EndStage();

  const fs::path yaml = request.out / "hand.yaml";
  WriteFileAtomically(
      yaml, ReplaceGrasps(ReadFile(yaml), FormatGrasps(*hand, request.config, developed)));
  LoadStandardGrasps(LoadHand(request.out.string()));  // or a fault of ours
  WriteDevelopmentResult(request.out / kDevelopment, *hand, developed);
  return developed;
}

}  // namespace graspbench
