#include "tests/human_study/protocol/protocol_study.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/base/files/files.h"
#include "core/statistics/summary.h"
#include "human_study/events/scalar_curve.h"
#include "human_study/recording/c3d_writer.h"

namespace graspbench::protocol {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTips[] = {"thumb", "index", "middle", "ring", "little"};

/** Turned by 90 degrees about x: z becomes y. */
Eigen::Vector3d MakeYUp(const Eigen::Vector3d& p) { return {p.x(), p.z(), -p.y()}; }

void AddPoint(const std::string& label, const std::vector<Eigen::Vector3d>& path, bool is_y_up,
              Recording& recording) {
  RecordedPoint& point = recording.points.emplace_back();
  point.label = label;
  for (const Eigen::Vector3d& p_WM : path) {
    const Eigen::Vector3d p = 1e3 * (is_y_up ? MakeYUp(p_WM) : p_WM);
    point.Append(p.x(), p.y(), p.z());
  }
}

Recording MakeRecording(const Reach& reach, double rate, bool is_y_up) {
  Recording recording;
  recording.rate = rate;
  recording.num_frames = reach.times.size();
  for (int d = 0; d < kNumDigits; ++d) AddPoint(kTips[d], reach.digits[d], is_y_up, recording);
  AddPoint("wrist", reach.wrist, is_y_up, recording);
  for (size_t m = 0; m < reach.object_markers.size(); ++m) {
    AddPoint("object_" + std::to_string(m + 1), reach.object_markers[m], is_y_up, recording);
  }
  SetLengthUnit(recording, "mm", "protocol");
  return recording;
}

std::string FormatStudy(const StudyPlan& plan) {
  std::string yaml = "name: Reaches of the protocol\nmarkers:\n";
  for (const char* tip : kTips) yaml += std::string("  ") + tip + ": " + tip + "\n";
  yaml += "  wrist: wrist\n";
  std::string markers;
  for (int m = 1; m <= plan.conditions.num_object_markers; ++m) {
    markers += (m == 1 ? "" : ", ") + std::string("object_") + std::to_string(m);
  }
  if (!markers.empty()) yaml += "  object: [" + markers + "]\n";
  if (plan.has_shape && !markers.empty()) yaml += "objects: objects.csv\n";
  return yaml + plan.settings;
}

/** One universe and no bias card: neither is compared here. */
constexpr const char* kQuick =
    "multiverse: {onset: [], cutoff_hz: [], detector: [speed], opening: []}\nbias_trials: 0\n";

double CalcMean(const std::vector<double>& values) {
  return values.empty() ? std::nan("") : CalcMoments(values).mean;
}

double CalcSd(const std::vector<double>& values) {
  if (values.size() < 2) return std::nan("");
  return std::sqrt(CalcMoments(values).sum_of_squares / static_cast<double>(values.size() - 1));
}

}  // namespace

std::vector<Reach> WriteStudy(const StudyPlan& plan, const fs::path& folder) {
  MakeFolder(folder);
  std::vector<Reach> truth;
  std::string trials = "participant,trial,file,object\n";
  for (int person = 1; person <= plan.num_people; ++person) {
    const std::string name = "p" + std::to_string(person);
    for (int trial = 1; trial <= plan.trials_per_person; ++trial) {
      truth.push_back(MakeReach(plan.conditions, plan.seed + "/" + name, trial));
      const std::string file = name + "_" + std::to_string(trial) + ".c3d";
      std::ofstream out(folder / file, std::ios::binary);
      WriteC3d(out, MakeRecording(truth.back(), plan.conditions.rate, plan.is_y_up));
      trials += name + "," + std::to_string(trial) + "," + file + ",cylinder\n";
    }
  }
  if (!plan.has_shape || plan.conditions.num_object_markers == 0) {
    for (size_t at; (at = trials.find(",cylinder")) != std::string::npos;) trials.erase(at, 9);
    trials.erase(trials.find(",object"), 7);
  }
  WriteFileAtomically(folder / "trials.csv", trials);
  WriteFileAtomically(folder / "objects.csv",
                      "object,shape,length_m,height_m,centre_x_m,centre_y_m,centre_z_m\n"
                      "cylinder,cylinder,0.07,0.12,0,0,-0.06\n");
  WriteFileAtomically(folder / "study.yaml", FormatStudy(plan) + kQuick);
  return truth;
}

Accuracy CompareWithTruth(const StudyResult& result, const std::vector<Reach>& truth) {
  Accuracy accuracy;
  std::vector<double> errors, gft_errors, gfts;
  int num_covered = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    ++accuracy.num_trials;
    const StudyTrial& found = result.trials.at(i);
    if (!found.IsKept()) continue;
    ++accuracy.num_kept;
    double first = INFINITY, last = -INFINITY;
    bool is_complete = true;
    for (int d = 0; d < kNumDigits; ++d) {
      const EventTime& contact = found.analysis->contacts.at(static_cast<size_t>(d)).contact;
      const double touch = truth[i].touch_times[d];
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
      num_covered += std::abs(errors.back()) <= 1.96 * contact.uncertainty;
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
  accuracy.zero_median = result.statistics.zero_gft.median;
  accuracy.zero_limit = result.statistics.zero_gft.limit;
  return accuracy;
}

Accuracy Measure(const StudyPlan& plan, const fs::path& scratch) {
  const fs::path folder = scratch / "protocol_study";
  fs::remove_all(folder);
  const std::vector<Reach> truth = WriteStudy(plan, folder);
  const Accuracy accuracy = CompareWithTruth(RunStudy(LoadStudy(folder / "study.yaml")), truth);
  fs::remove_all(folder);
  return accuracy;
}

}  // namespace graspbench::protocol
