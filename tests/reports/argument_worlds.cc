#include "tests/reports/argument_worlds.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/text/csv.h"
#include "human_study/study/output/statistics_table.h"
#include "human_study/study/run/run_study.h"
#include "tests/datasets/analysis/map/planted_worlds.h"

namespace graspbench {
namespace {

const std::vector<std::string> kHands = {"tum", "shadow"};

EventTime MakeEvent(double time, double uncertainty) {
  EventTime event;
  event.time = time;
  event.uncertainty = uncertainty;
  return event;
}

/** One reach: digits have habits and scatter on their own, and share what the model says. */
StudyTrial MakeReach(double shared_sd, double own_sd, const std::vector<double>& habits,
                     RandomStream& random) {
  constexpr double kClockError = 0.004;
  StudyTrial trial;
  TrialAnalysis& analysis = trial.analysis.emplace();
  const double start = random.NextUniform(0.5, 1.5);
  const auto read = [&](double time) {
    return MakeEvent(time + kClockError * random.NextNormal(), kClockError);
  };
  analysis.movement.onset = read(start);
  analysis.movement.end = read(start + 1.1);
  analysis.closure_start = read(start + 0.6);
  const double shared = shared_sd * random.NextNormal();
  for (const double habit : habits) {
    DigitContactEvents& events = analysis.contacts.emplace_back();
    events.contact = MakeEvent(start + 0.95 + habit + shared + own_sd * random.NextNormal(), 0.002);
    events.own_uncertainty = 0.002;
  }
  return trial;
}

PeopleEvidence MakePeople(const WorldSize& size, Truth truth, uint64_t seed) {
  const bool is_absent = truth == Truth::kAbsent;
  const int num_persons = is_absent ? 1 : 10, num_repeats = is_absent ? 1 : 12;
  RandomStream random(std::to_string(seed), "people");
  std::vector<StudyTrial> trials;
  for (int person = 0; person < num_persons; ++person) {
    std::vector<double> habits;
    for (int digit = 0; digit < 5; ++digit) habits.push_back(0.01 * random.NextNormal());
    const double own_sd = 0.03 * std::exp(0.15 * random.NextNormal());
    for (int repeat = 0; repeat < 2 * num_repeats; ++repeat) {
      trials.push_back(MakeReach(size.shared_sd, own_sd, habits, random));
      trials.back().participant = std::to_string(person);
      trials.back().levels = {repeat % 2 == 0 ? "small" : "large"};
      trials.back().id = std::to_string(seed) + " " + std::to_string(trials.size());
    }
  }
  const auto rows = ListIndependenceVerdicts(CalcIndependenceNull(trials, 5));
  PeopleEvidence people =
      ReadPeopleEvidence(FormatCsv(ListStatisticColumns(), rows), "statistics.csv");
  people.folder = "study";
  return people;
}

MapResult MakeMap(Truth truth, uint64_t seed) {
  const MapFinding kind = truth == Truth::kTrue ? MapFinding::kMatters
                          : seed % 2 == 0       ? MapFinding::kNoEffect
                                                : MapFinding::kCommonCause;
  PlantedWorld world = MakeWorld(kind, seed);
  world.data.factors[planted::kOffset].scales_draws = true;
  if (truth == Truth::kAbsent) {  // two objects tell nothing
    auto& trials = world.data.trials;
    trials.erase(std::remove_if(trials.begin(), trials.end(),
                                [](const MapTrial& trial) { return trial.object > "object01"; }),
                 trials.end());
  }
  MapPartResult part;
  part.id = "success";
  part.num_trials = part.num_planned = static_cast<int>(world.data.trials.size());
  part.map = MapSimultaneity(world.data);
  MapResult result;
  result.parts.push_back(part);
  return result;
}

/** Trials of one grasp: a digit's contact is its own lateness and scatter; its worth is noisy. */
std::vector<LearningTrial> MakeTrials(const std::vector<double>& lateness, double worth, int count,
                                      RandomStream& random) {
  constexpr double kScatter = 0.015, kNoise = 0.15, kNever = 0.02;
  const std::vector<std::string> digits = {"TH", "FF", "MF"};
  std::vector<LearningTrial> trials;
  for (int i = 0; i < count; ++i) {
    LearningTrial trial;
    trial.outcome = Outcome::kSuccess;
    trial.sigma = worth * std::exp(kNoise * random.NextNormal());
    trial.stability.normal_force = 5.0;
    for (size_t digit = 0; digit < digits.size(); ++digit) {
      const bool never = random.NextUniform(0.0, 1.0) < kNever;
      trial.contacts.push_back(
          {digits[digit], digit == 0,
           never ? kUnset : 0.4 + lateness[digit] + kScatter * random.NextNormal()});
    }
    trial.timing = CalcContactTiming(trial.contacts, 0.0);
    trials.push_back(trial);
  }
  return trials;
}

SceneRecord MakeScene(int claim, const std::string& hand, int number, Truth truth,
                      const WorldSize& size, RandomStream& random) {
  constexpr int kTrials = 40;  // a check takes 20 to 100 pairs
  SceneRecord scene;
  scene.config.hand = hand;
  scene.config.object = "object" + std::to_string(number);
  std::vector<double> lateness, after;
  for (int digit = 0; digit < 3; ++digit) {
    lateness.push_back(random.NextUniform(0.0, 0.18));
    const double share = size.taken_away + 0.15 * random.NextNormal();
    after.push_back(size.taken_away > 0.0 ? (1.0 - std::clamp(share, 0.0, 1.0)) * lateness[digit]
                                          : lateness[digit]);
  }
  const double worth = std::exp(0.5 * random.NextNormal());
  const double gain = size.gain > 1.0 ? size.gain * std::exp(0.1 * random.NextNormal()) : size.gain;
  const Json before = MakeScore(MakeTrials(lateness, worth, kTrials, random));
  if (claim == 2) {
    const Json changed = MakeScore(MakeTrials(after, worth, kTrials, random));
    scene.result["pregrasp_step"] = {{"standard", before},
                                     {"checked", "pre-grasp"},
                                     {"pregrasp_alone", {{"before", before}, {"after", changed}}},
                                     {"check_before", before},
                                     {"check_after", changed}};
    if (truth == Truth::kAbsent) scene.result["pregrasp_step"] = {{"taken", Json()}};
    return scene;
  }
  const bool has_taken = random.NextUniform(0.0, 1.0) < 0.5;
  scene.result["target_step"] = {
      {"taken", has_taken},
      {"check_before", before},
      {"check_after", MakeScore(MakeTrials(lateness, worth * gain, kTrials, random))}};
  if (truth == Truth::kAbsent) {  // another search, or a start that holds nothing
    if (number % 2 == 0) scene.config.optimise.search = "all-digits";
    scene.result["target_step"]["check_before"]["fitness"] = -0.01;
  }
  return scene;
}

TrialRecord MakeOutcome(const PlannedTrial& plan, bool holds) {
  TrialRecord record;
  record.plan = plan;
  record.result.outcome = holds ? Outcome::kSuccess : Outcome::kPushedAway;
  return record;
}

/** Sessions of a hand and of its evolved grasps on the same draws: an object is hard or easy, and a
draw is shared. */
void MakeSessions(Truth truth, const WorldSize& size, RandomStream& random,
                  ArgumentSources& sources) {
  const double flip = size.is_at_ceiling ? 0.002 : 0.02;
  for (const std::string& hand : kHands) {
    Session before, after;
    before.config.objects = after.config.objects = {"all"};
    before.config.hands = {hand};
    after.config.hands = {hand + "-evolved"};
    if (truth == Truth::kAbsent) after.config.seed = before.config.seed + 1;  // other draws
    for (int object = 0; object < size.num_scenes; ++object) {
      const double rate =
          size.is_at_ceiling ? 0.994 : std::clamp(0.75 + 0.12 * random.NextNormal(), 0.3, 0.85);
      const double change = size.success != 0.0 ? size.success + 0.03 * random.NextNormal() : 0.0;
      for (int trial = 0; trial < size.num_trials; ++trial) {
        const double luck = random.NextUniform(0.0, 1.0);
        const auto holds = [&](double probability) {
          return (luck < probability) != (random.NextUniform(0.0, 1.0) < flip);
        };
        const auto add = [&](Session& session, const std::string& own, bool is_held) {
          session.plan.push_back({own + std::to_string(session.plan.size()), own,
                                  "object" + std::to_string(object), "g1", trial});
          session.records.push_back(MakeOutcome(session.plan.back(), is_held));
        };
        add(before, hand, holds(rate));
        add(after, hand + "-evolved", holds(rate + change));
      }
    }
    sources.sessions.push_back({hand, before});
    sources.sessions.push_back({hand + "-evolved", after});
  }
}

}  // namespace

WorldSize SizeOf(Truth truth) {
  WorldSize size;
  if (truth != Truth::kTrue) return size;
  size.shared_sd = 0.04;
  size.taken_away = 0.6;
  size.gain = 1.25;
  size.success = 0.1;
  return size;
}

ArgumentSources MakeArgumentWorld(int claim, Truth truth, const WorldSize& size, uint64_t seed) {
  RandomStream random(std::to_string(seed), "argument " + std::to_string(claim));
  ArgumentSources sources;
  if (claim == 0) sources.people.push_back(MakePeople(size, truth, seed));
  if (claim == 1) sources.maps.push_back({"map", MakeMap(truth, seed)});
  if (claim == 2 || claim == 3) {
    for (const std::string& hand : kHands) {
      for (int number = 0; number < size.num_scenes; ++number) {
        sources.scenes.push_back({"scenes", MakeScene(claim, hand, number, truth, size, random)});
      }
    }
  }
  if (claim == 4) MakeSessions(truth, size, random, sources);
  return sources;
}

ArgumentVerdict NameWorld(int claim, Truth truth, const WorldSize& size, uint64_t seed) {
  return MakeArgument(MakeArgumentWorld(claim, truth, size, seed)).at(claim).verdict;
}

}  // namespace graspbench
