#include "tests/human_study/protocol/protocol_study.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "core/base/files/files.h"
#include "core/base/random.h"
#include "core/statistics/summary.h"
#include "human_study/recording/save_recording.h"
#include "human_study/study/run/trial_removal.h"

namespace graspbench::protocol {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTips[] = {"thumb", "index", "middle", "ring", "little"};

Recording MakeRecording(const Reach& reach, double rate, bool is_y_up) {
  Recording recording;
  recording.rate = rate;
  recording.num_frames = reach.times.size();
  const auto add = [&](const std::string& label, const std::vector<Eigen::Vector3d>& path) {
    RecordedPoint& point = recording.points.emplace_back();
    point.label = label;
    for (const Eigen::Vector3d& p_WM : path) {
      const Eigen::Vector3d p = 1e3 * p_WM;
      // Turned by 90 degrees about x, z becomes y.
      is_y_up ? point.Append(p.x(), p.z(), -p.y()) : point.Append(p.x(), p.y(), p.z());
    }
  };
  for (int d = 0; d < kNumDigits; ++d) add(kTips[d], reach.digits[d]);
  add("wrist", reach.wrist);
  for (size_t m = 0; m < reach.object_markers.size(); ++m) {
    add("object_" + std::to_string(m + 1), reach.object_markers[m]);
  }
  SetLengthUnit(recording, "mm", "protocol");
  return recording;
}

/** One universe and no bias card: neither is compared here. */
void WriteSettings(const StudyPlan& plan, const Reach& reach, bool has_shape,
                   const fs::path& folder) {
  std::string yaml = "name: Reaches of the protocol\nmarkers:\n  wrist: wrist\n", markers;
  for (const char* tip : kTips) yaml += std::string("  ") + tip + ": " + tip + "\n";
  for (int m = 1; m <= plan.conditions.num_object_markers; ++m) {
    markers += (m == 1 ? "object_" : ", object_") + std::to_string(m);
  }
  if (!markers.empty()) yaml += "  object: [" + markers + "]\n";
  yaml +=
      "multiverse: {onset: [], cutoff_hz: [], detector: [speed], opening: []}\n"
      "bias_trials: 0\n";
  if (has_shape) {
    yaml += "objects: objects.csv\n";
    std::ofstream(folder / "objects.csv")
        << "object,shape,length_m,height_m,centre_x_m,centre_y_m,centre_z_m\ncylinder,cylinder,"
        << 2.0 * reach.object_radius << ',' << reach.object_height << ",0,"
        << (plan.is_y_up ? "" : "0,") << -0.5 * reach.object_height
        << (plan.is_y_up ? ",0\n" : "\n");
  }
  WriteFileAtomically(folder / "study.yaml", yaml + plan.settings);
}

double CalcSd(const std::vector<double>& values) {
  if (values.size() < 2) return std::nan("");
  return std::sqrt(CalcMoments(values).sum_of_squares / static_cast<double>(values.size() - 1));
}

}  // namespace

Judged RunPlan(const StudyPlan& plan) {
  const fs::path folder =
      fs::temp_directory_path() / ("graspbench_protocol_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  MakeFolder(folder);
  Judged judged;
  const bool has_shape = plan.has_shape && plan.conditions.num_object_markers > 0;
  std::string trials = std::string("participant,trial,file") + (has_shape ? ",object\n" : "\n");
  for (int person = 1; person <= plan.num_people; ++person) {
    const std::string name = "p" + std::to_string(person);
    for (int trial = 0; trial < plan.trials_per_person; ++trial) {
      Conditions conditions = plan.conditions;
      if (plan.other_rate > 0.0 && trial % 2 == 1) conditions.rate = plan.other_rate;
      judged.truth.push_back(plan.make_reach(conditions, plan.seed + "/" + name, trial));
      const std::string file = name + "_" + std::to_string(trial + 1) + ".c3d";
      std::ofstream out(folder / file, std::ios::binary);
      WriteC3d(out, MakeRecording(judged.truth.back(), conditions.rate, plan.is_y_up));
      trials += name + "," + std::to_string(trial + 1) + "," + file;
      trials += has_shape ? ",cylinder\n" : "\n";
    }
  }
  WriteFileAtomically(folder / "trials.csv", trials);
  WriteSettings(plan, judged.truth.front(), has_shape, folder);
  judged.result = RunStudy(LoadStudy(folder / "study.yaml"));
  fs::remove_all(folder);
  return judged;
}

Accuracy CompareWithTruth(const Judged& judged) {
  constexpr double kLarge = 0.02;  // [s]
  Accuracy accuracy;
  std::vector<double> errors, gft_errors, gfts;
  int num_covered = 0;
  for (size_t i = 0; i < judged.truth.size(); ++i) {
    ++accuracy.num_trials;
    const StudyTrial& found = judged.result.trials.at(i);
    if (!found.IsKept()) continue;
    ++accuracy.num_kept;
    const std::string flags = FormatFlags(*found.analysis);
    const bool is_silent = flags.empty() || flags == "touch not verified";
    double first = INFINITY, last = -INFINITY;
    bool is_complete = true;
    for (size_t d = 0; d < kNumDigits; ++d) {
      const EventTime& contact = found.analysis->contacts.at(d).contact;
      const double touch = judged.truth[i].touch_times[d];
      if (std::isnan(touch)) {
        accuracy.num_false_contacts += contact.IsFound();
        is_complete &= !contact.IsFound();
        continue;
      }
      ++accuracy.num_true_contacts;
      first = std::min(first, touch);
      last = std::max(last, touch);
      is_complete &= contact.IsFound();
      if (!contact.IsFound()) continue;
      ++accuracy.num_contacts;
      errors.push_back(contact.time - touch);
      const double error = std::abs(errors.back());
      num_covered += error <= contact.CalcHalfWidth();
      accuracy.num_silent += error > std::max(kLarge, contact.CalcHalfWidth()) && is_silent;
    }
    gfts.push_back(found.analysis->timing.gft);
    if (is_complete) gft_errors.push_back(gfts.back() - (last - first));
  }
  accuracy.bias = CalcMean(errors);
  accuracy.sd = CalcSd(errors);
  accuracy.coverage = errors.empty() ? std::nan("") : num_covered / double(errors.size());
  accuracy.gft_bias = CalcMean(gft_errors);
  accuracy.gft_sd = CalcSd(gft_errors);
  accuracy.median_gft = CalcMedian(gfts);
  return accuracy;
}

std::map<std::string, int> CountRemovals(const StudyResult& result) {
  std::map<std::string, int> codes;
  for (const StudyTrial& trial : result.trials) ++codes[trial.removed_code];
  return codes;
}

void Print(const std::string& name, const Judged& judged) {
  const Accuracy a = CompareWithTruth(judged);
  std::printf(
      "%-34s kept %d of %d, contacts %d of %d, bias %.1f ms, SD %.1f ms, coverage %.3f, silent %d;",
      name.c_str(), a.num_kept, a.num_trials, a.num_contacts, a.num_true_contacts, 1e3 * a.bias,
      1e3 * a.sd, a.coverage, a.num_silent);
  for (const auto& [code, count] : CountRemovals(judged.result)) {
    if (!code.empty()) std::printf(" %s %d", code.c_str(), count);
  }
  std::printf("\n");
  std::fflush(stdout);
}

namespace {

void AddVerdict(const Answer<IndependenceNull>& null, Verdicts& verdicts) {
  if (!null) {
    ++verdicts.num_none;
    return;
  }

  switch (null->Judge(null->gft)) {
    case IndependenceVerdict::kMore:
      ++verdicts.num_more;
      break;
    case IndependenceVerdict::kLess:
      ++verdicts.num_less;
      break;
    case IndependenceVerdict::kNotDecided:
      ++verdicts.num_not_decided;
      break;
    case IndependenceVerdict::kNoDifference:
      ++verdicts.num_no_difference;
      break;
  }
}

Movement FindWristMovement(const Reach& reach) {
  Trajectory wrist;
  wrist.times = reach.times;
  wrist.states.assign(reach.times.size(), SampleState::kMeasured);
  wrist.p.resize(3, static_cast<Eigen::Index>(reach.times.size()));
  for (size_t i = 0; i < reach.times.size(); ++i) {
    wrist.At(i) = reach.wrist[i];
  }
  const MovementOptions options;
  return FindMovement(CalcSpeed(Smooth(wrist, options.cutoff)), reach.times.front(), reach.lift_off,
                      options);
}

EventTime ReadEvent(double truth, double error, RandomStream& random) {
  EventTime event;
  event.time = truth + error * random.NextNormal();
  event.uncertainty = error;
  return event;
}

}  // namespace

Verdicts CountVerdicts(StudyPlan plan, int num_studies) {
  Verdicts verdicts;
  const std::string seed = plan.seed;
  for (int i = 0; i < num_studies; ++i) {
    plan.seed = seed + std::to_string(i);
    AddVerdict(RunPlan(plan).result.statistics.independence, verdicts);
  }
  return verdicts;
}

Verdicts CountVerdictsOfEvents(StudyPlan plan, int num_studies) {
  Verdicts verdicts;
  plan.conditions.num_object_markers = 0;
  for (int study = 0; study < num_studies; ++study) {
    std::vector<StudyTrial> trials;
    for (int person = 1; person <= plan.num_people; ++person) {
      const std::string id =
          plan.seed + ", events " + std::to_string(study) + "/p" + std::to_string(person);
      RandomStream random(id, "errors of events");
      for (int i = 0; i < plan.trials_per_person; ++i) {
        const Reach reach = plan.make_reach(plan.conditions, id, i);
        StudyTrial& trial = trials.emplace_back();
        trial.participant = "p" + std::to_string(person);
        trial.id = id + "-" + std::to_string(i);
        TrialAnalysis& analysis = trial.analysis.emplace();
        analysis.movement = FindWristMovement(reach);
        analysis.closure_start = ReadEvent(reach.widest, 0.01, random);
        for (const double touch : reach.touch_times) {
          DigitContactEvents& digit = analysis.contacts.emplace_back();
          digit.contact = ReadEvent(touch, 0.004, random);
          digit.own_uncertainty = 0.004;
        }
      }
    }
    AddVerdict(CalcIndependenceNull(trials, kNumDigits), verdicts);
  }
  return verdicts;
}

std::vector<NamedPlan> ListIndependentPeople() {
  using Family = SpeedProfile::Family;
  std::vector<NamedPlan> plans;
  const auto add = [&](const char* name) -> Conditions& {
    plans.push_back({name, {}});
    plans.back().plan.seed = name;
    return plans.back().plan.conditions;
  };
  const auto set_peak = [](Conditions& conditions, Family family, double low, double high) {
    conditions.family = family;
    conditions.min_peak = low;
    conditions.max_peak = high;
  };
  set_peak(add("peak at 44 to 56 percent, warped"), Family::kWarped, 0.44, 0.56);
  set_peak(add("peak at 40 to 60 percent, warped"), Family::kWarped, 0.40, 0.60);
  set_peak(add("peak at 40 to 60 percent, beta"), Family::kBeta, 0.40, 0.60);
  set_peak(add("peak at 40 to 60 percent, halves"), Family::kHalves, 0.40, 0.60);
  Conditions& distances = add("undeclared distances, noisy ends");
  distances.distances = {0.25, 0.35, 0.45};
  distances.end_sd = 0.03;
  add("noisy ends").end_sd = 0.04;
  add("drift").drift = 0.01;
  Conditions& steady = add("drift beside 20 ms of each digit's own");
  steady.drift = 0.01;
  steady.digit_sd = 0.02;
  add("lags of 60 ms").lag = 0.06;
  return plans;
}

std::vector<NamedPlan> ListCoordinatedPeople() {
  std::vector<NamedPlan> plans;
  for (NamedPlan& independent : ListIndependentPeople()) {
    // Lags of 60 ms make a GFT of 240 ms that no coordination shortens.
    if (independent.name.find("lags") != std::string::npos) continue;
    independent.plan.conditions.shared_sd = 0.06;
    independent.plan.seed += ", shared";
    plans.push_back(independent);
  }
  return plans;
}

}  // namespace graspbench::protocol
