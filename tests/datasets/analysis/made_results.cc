#include "tests/datasets/analysis/made_results.h"

#include "core/trial/judge/judge.h"

namespace graspbench {

TrialRecord MakeRecord(const PlannedTrial& plan, Outcome outcome) {
  TrialRecord record;
  record.plan = plan;
  TrialResult& result = record.result;
  result.outcome = outcome;
  if (outcome != Outcome::kSuccess) result.reason = "the thumb came late";
  const double late = 0.01 * plan.trial;
  result.contacts = {
      {"FF", false, 0.4 + late}, {"MF", false, 0.6 + late}, {"TH", true, 0.5 + late}};
  result.touches.resize(result.contacts.size());
  result.timing = CalcContactTiming(result.contacts, 0.0);
  result.lift_height = 0.0987;
  result.hold_slip = 0.0012;
  result.end_speed = 0.0034;
  result.grip_force = 5.67;
  result.worst_penetration = 0.00043 + 0.0001 * plan.trial;
  result.energy_residual = -0.000321;
  result.num_steps = 1234;
  result.num_unconverged = plan.trial;
  result.simulated_time = 4.5;
  return record;
}

Session MakeSession(const std::vector<std::string>& hands, const std::vector<std::string>& objects,
                    const std::string& grasp, int trials) {
  Session session;
  session.config.hands = hands;
  session.config.objects = objects;
  session.config.grasps = {grasp};
  session.config.trials = trials;
  for (const std::string& hand : hands) {
    for (const std::string& object : objects) {
      for (int trial = 0; trial < trials; ++trial) {
        const std::string number = std::to_string(session.plan.size());
        session.plan.push_back({"id" + number, hand, object, grasp, trial});
        session.records.push_back(MakeRecord(session.plan.back(), Outcome::kSuccess));
      }
    }
  }
  return session;
}

Session MakeJudgedSession() {
  Session session = MakeSession({"tum", "shadow"}, {"a", "b", "c", "d", "e", "f"}, "g1", 2);
  double force = 0.0;
  for (TrialRecord& record : session.records) {
    force += 1.0;
    record.result.stability.sigma = 0.5 * force * force;
    record.result.stability.stabilisation.quality = 1.0 / force;
    Judgement judgement = MakeEmptyHandJudgement();
    judgement.breaking_force = force;
    judgement.verdicts[0].passed = true;
    judgement.verdicts[1].passed = force > 6.0;
    record.judgement = judgement;
  }
  return session;
}

Campaign MakeCampaign() {
  Campaign campaign;
  campaign.config.session.trials = 10;
  for (const char* object : {"can", "cup"}) {
    SceneRecord scene;
    scene.config.hand = "tum";
    scene.config.object = object;
    scene.config.grasp = "g3";
    scene.result = {
        {"pregrasp_step",
         {{"verdict", "taken: <it> closes better"},
          {"taken", "one-shot, half"},
          {"standard", {{"gft_ratio_without_variation", 0.2}}},
          {"shots",
           {{{"name", "one-shot, widest"}, {"score", {{"gft_ratio_without_variation", 0.01}}}},
            {{"name", "one-shot, half"}, {"score", {{"gft_ratio_without_variation", 0.05}}}}}}}},
        {"target_step",
         {{"verdict", "taken"},
          {"joints", {"THJ1"}},
          {"start_rad", {0.5}},
          {"found_rad", {0.25}},
          {"lower_rad", {0.1}},
          {"upper_rad", {0.9}}}}};
    campaign.scenes.push_back(scene);
    int variant = 0;
    for (const char* grasp : {"g3", "new-pregrasp", "new-target"}) {
      for (int trial = 0; trial < 10; ++trial) {
        const PlannedTrial plan = {std::string(grasp) + object + std::to_string(trial), "tum",
                                   object, grasp, trial};
        const bool fails = variant == 2 && std::string(object) == "can" && trial < 6;
        TrialRecord record =
            MakeRecord(plan, fails ? Outcome::kSlippedInLiftOff : Outcome::kSuccess);
        record.result.stability.sigma = 1.0 + variant + 0.01 * trial;
        record.result.timing.gft_ratio = 0.4 / (1 << variant) + 0.001 * trial;
        campaign.benchmark.plan.push_back(plan);
        campaign.benchmark.records.push_back(record);
      }
      ++variant;
    }
  }
  for (const char* method : {"es", "random"}) {
    for (int seed = 1; seed <= 3; ++seed) {
      ComparisonRun run = {"tum", "can", method, seed, {0.0, 1.0, 2.0, 2.0}, 3};
      if (std::string(method) == "random") run.fitness = {0.0, 0.5, 0.5, 1.0};
      if (std::string(method) == "random") run.evaluations_to_90 = 0;
      campaign.comparison.push_back(run);
    }
  }
  return campaign;
}

std::vector<BasinSample> MakeBasinSamples(int count) {
  Session session;
  session.config.draws = "halton";
  session.config.variation.offset = kBasinOffset;
  session.config.variation.yaw = kBasinYaw;
  for (int i = 0; i < count; ++i) {
    session.records.push_back({{std::to_string(i), "tum", "can", "g1", i}, {}});
  }
  return ListBasinSamples(session);
}

}  // namespace graspbench
