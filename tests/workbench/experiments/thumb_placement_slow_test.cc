// Grasps that all succeed ten times of ten, told apart: the stability must order them as the force
// that breaks them does. The thumb of one standard grasp is moved over a grid; everything else,
// also where the hand stands, stays as it is.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/base/files/files.h"
#include "core/grasp/grasp_file.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/statistics/bootstrap.h"
#include "core/statistics/distributions.h"
#include "core/statistics/ranks.h"
#include "core/statistics/summary.h"
#include "datasets/plan/session_plan.h"
#include "objects/catalogue.h"
#include "workbench/experiments/pool/batch_runner.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

constexpr int kNumTrials = 10;

/** Files of the grid: thumb sideways over its range, base flexion over 24 degrees. */
std::vector<std::string> WriteGraspFiles(const fs::path& folder) {
  const Hand hand = LoadHand("tum");
  const GraspObject object = *LoadObject("adhesive_tape");
  std::vector<std::string> files;
  for (Grasp grasp : LoadStandardGrasps(hand)) {
    if (grasp.id != "g3") continue;
    grasp.object = object.id;
    grasp.placement = CalcPlacement(hand, grasp, object.size, object.mass_properties.p_OOcm);
    const Eigen::VectorXd q_target = grasp.q_target;
    for (const int sideways_deg : {-12, -6, 0, 6, 12}) {
      for (const int flexion_deg : {-16, -8, 0, 8}) {
        char id[32];
        std::snprintf(id, sizeof id, "thumb%+d%+d", sideways_deg, flexion_deg);
        grasp.id = id;
        grasp.q_target = q_target;
        grasp.q_target[hand.FindJoint("THq1")] += RadFromDeg(sideways_deg);
        grasp.q_target[hand.FindJoint("THq2")] += RadFromDeg(flexion_deg);
        files.push_back((folder / (grasp.id + ".yaml")).string());
        WriteFileAtomically(files.back(), FormatGraspFile(hand, grasp, "g3"));
      }
    }
  }
  return files;
}

/** Mean of ten trials with its 95 % interval. */
struct Mean {
  double value = 0.0, half_width = 0.0;
};

Mean CalcMean(const std::vector<double>& values) {
  const Answer<Summary> summary = CalcSummary(values);
  const double n = static_cast<double>(values.size());
  return {summary->mean,
          CalcStudentQuantile(0.975, n - 1.0) * *summary->standard_deviation / std::sqrt(n)};
}

/** -1, 0, 1; 0 when the intervals overlap. */
int Compare(const Mean& a, const Mean& b) {
  if (std::abs(a.value - b.value) <= a.half_width + b.half_width) return 0;
  return a.value < b.value ? -1 : 1;
}

struct JudgedCell {
  std::string grasp;
  int num_successes = 0;
  std::vector<double> forces, sigmas, epsilons;
};

std::vector<JudgedCell> RunAndJudge(const SessionConfig& config) {
  const SessionInputs inputs = LoadSessionInputs(config);
  TrialBench bench;
  std::vector<JudgedCell> cells;
  for (const PlannedTrial& planned : MakePlan(config, inputs)) {
    if (planned.trial == 0) cells.push_back({planned.grasp, 0, {}, {}, {}});
    TrialSetup setup = MakeTrialSetup(config, inputs, planned);
    const JudgedTrial trial = bench.Prepare(setup).Judge(setup);
    if (trial.result.outcome != Outcome::kSuccess) continue;
    JudgedCell& cell = cells.back();
    ++cell.num_successes;
    cell.forces.push_back(trial.judgement->breaking_force);
    cell.sigmas.push_back(trial.result.stability.sigma);
    cell.epsilons.push_back(trial.judgement->epsilons.front().epsilon);
  }
  return cells;
}

void PrintSpearman(const char* measure, const std::vector<double>& values,
                   const std::vector<double>& forces) {
  const auto interval = CalcBootstrap(
      values.size(),
      [&](const std::vector<size_t>& members) {
        std::vector<double> a, b;
        for (const size_t member : members) {
          a.push_back(values[member]);
          b.push_back(forces[member]);
        }
        const Answer<double> answer = CalcSpearman(a, b);
        return answer ? *answer : std::nan("");
      },
      measure);
  if (!interval) return;
  std::printf("%s: Spearman %.2f (95 %% interval %.2f to %.2f)\n", measure, interval->estimate,
              interval->interval.low, interval->interval.high);
}

TEST(ThumbPlacement, SigmaOrdersGraspsThatAlwaysSucceedAsTheirBreakingForce) {
  const fs::path folder = fs::path(testing::TempDir()) / "thumb_placement";
  MakeFolder(folder);
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"adhesive_tape"};
  config.grasps = WriteGraspFiles(folder);
  config.trials = kNumTrials;
  std::printf("grasp files in %s\n", folder.c_str());

  std::vector<Mean> forces, sigmas;
  std::vector<double> mean_forces, mean_sigmas, mean_epsilons;
  for (const JudgedCell& cell : RunAndJudge(config)) {
    if (cell.num_successes < kNumTrials) {
      std::printf("%-12s %d of %d\n", cell.grasp.c_str(), cell.num_successes, kNumTrials);
      continue;
    }
    forces.push_back(CalcMean(cell.forces));
    sigmas.push_back(CalcMean(cell.sigmas));
    mean_forces.push_back(forces.back().value);
    mean_sigmas.push_back(sigmas.back().value);
    mean_epsilons.push_back(CalcMean(cell.epsilons).value);
    std::printf("%-12s breaking force %5.2f +- %.2f N   sigma %5.2f +- %.2f N   epsilon %.3f\n",
                cell.grasp.c_str(), mean_forces.back(), forces.back().half_width,
                mean_sigmas.back(), sigmas.back().half_width, mean_epsilons.back());
  }
  int num_apart = 0, num_apart_inverted = 0, num_told = 0, num_told_inverted = 0;
  for (size_t a = 0; a < forces.size(); ++a) {
    for (size_t b = a + 1; b < forces.size(); ++b) {
      const int by_force = Compare(forces[a], forces[b]), by_sigma = Compare(sigmas[a], sigmas[b]);
      if (by_force == 0) continue;
      ++num_apart;
      num_apart_inverted += (sigmas[a].value < sigmas[b].value) != (by_force < 0);
      num_told += by_sigma != 0;
      num_told_inverted += by_sigma == -by_force;
    }
  }
  PrintSpearman("sigma", mean_sigmas, mean_forces);
  PrintSpearman("epsilon", mean_epsilons, mean_forces);
  std::printf(
      "pairs apart in breaking force %d, of them inverted by mean sigma %d; apart in sigma "
      "too %d, inverted %d\n",
      num_apart, num_apart_inverted, num_told, num_told_inverted);

  ASSERT_GE(forces.size(), 10u) << "too few grasps that always succeed";
  // Whatever both tell apart beyond their noise they order alike ...
  EXPECT_GE(num_told, 10);
  EXPECT_EQ(num_told_inverted, 0);
  // ... and what the force alone tells apart, the mean sigma rarely orders otherwise: it does not
  // know that drives may yield before contacts slip.
  EXPECT_LE(num_apart_inverted, num_apart / 5);
  EXPECT_GT(*CalcSpearman(mean_sigmas, mean_forces), *CalcSpearman(mean_epsilons, mean_forces));
}

}  // namespace
}  // namespace graspbench
