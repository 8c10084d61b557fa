#include "human_study/study/output/motion_bids.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/base/files/files.h"
#include "core/base/version.h"
#include "human_study/study/output/study_tables.h"

namespace graspbench {
namespace {

/** Microseconds and micrometres: below what any tracker resolves. Asked some thousand times a
trial. */
std::string FormatFine(double value) {
  if (!std::isfinite(value)) return "n/a";
  std::array<char, 320> digits;  // the largest number has 309 before the point
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                          std::chars_format::fixed, 6);
  return std::string(digits.data(), end);
}

/** Names of the tracked points and their paths. */
struct TrackedPoint {
  std::string name;
  const Trajectory* path;
};

std::vector<TrackedPoint> ListPoints(const ReachTrial& reach) {
  std::vector<TrackedPoint> points;
  for (const DigitTrack& digit : reach.digits) {
    points.push_back({NameOfDigit(digit.digit) + "_tip", &digit.tip});
  }
  if (reach.wrist.size() > 0) points.push_back({"wrist", &reach.wrist});
  return points;
}

std::string FormatMotion(const std::vector<TrackedPoint>& points, const ObjectTrack& object,
                         size_t num_samples) {
  std::string text;
  for (size_t i = 0; i < num_samples; ++i) {
    const auto add = [&](const Eigen::Vector3d& p) {
      for (const double x : p) (text += FormatFine(x)) += '\t';
    };
    for (const TrackedPoint& point : points) add(point.path->p.col(static_cast<Eigen::Index>(i)));
    if (object.IsRecorded()) {
      const bool is_valid = object.states[i] != SampleState::kInvalid;
      add(is_valid ? Eigen::Vector3d(object.X_LO[i].translation())
                   : Eigen::Vector3d::Constant(std::nan("")));
    }
    text.back() = '\n';
  }
  return text;
}

std::string FormatChannels(const std::vector<std::string>& names) {
  std::string text = "name\tcomponent\ttype\ttracked_point\tunits\n";
  for (const std::string& name : names) {
    for (const char* axis : {"x", "y", "z"}) {
      text += name + "_" + axis + "\t" + axis + "\tPOS\t" + name + "\tm\n";
    }
  }
  return text;
}

std::string FormatEvents(const StudyTrial& trial, const StudyConfig& config) {
  std::string text = "onset\tduration\ttrial_type\tdigit\tdetector\tuncertainty\tfilled\n";
  for (const StudyEvent& event : ListEvents(trial, config)) {
    if (!event.event.IsFound() || !event.is_believed) continue;
    text += FormatFine(event.event.time - trial.begin) + "\t0\t" + event.name +
            (event.digit.empty() ? "" : "_" + NameOfDigit(event.digit)) + "\t" +
            (event.digit.empty() ? "n/a" : event.digit) + "\t" +
            (event.detector.empty() ? "n/a" : event.detector) + "\t" +
            FormatFine(event.event.uncertainty) + "\t" +
            (event.event.is_filled || event.event.is_in_gap ? "1" : "0") + "\n";
  }
  return text;
}

Json DescribeMotion(const StudyConfig& config, const ReachTrial& reach, size_t num_points) {
  const double interval = reach.times[1] - reach.times[0];
  return Json{{"TaskName", config.task},
              {"SamplingFrequency", std::round(1e6 / interval) / 1e6},
              {"TrackingSystemName", "markers"},
              {"TrackedPointsCount", num_points},
              {"POSChannelCount", 3 * num_points},
              {"MissingValues", "n/a"},
              {"RecordingDuration",
               std::round(1e6 * interval * static_cast<double>(reach.times.size())) / 1e6}};
}

constexpr char kReadme[] =
    "Cleaned paths of fingertips, wrist and object, one file a trial that counts, with the events\n"
    "that the measures rest on. Positions in metres, times in seconds from the trial's start.\n"
    "Short gaps were filled; nothing was filtered. trials.csv of the study says which part of\n"
    "which recording a trial is.\n";

}  // namespace

MotionBidsWriter::MotionBidsWriter(const std::filesystem::path& folder, const Study& study)
    : folder_(folder), study_(&study) {
  MakeFolder(folder_);
  std::filesystem::remove(folder_ / "dataset_description.json");
}

const std::string& MotionBidsWriter::FindLabel(const std::string& participant) {
  const auto [entry, is_new] = labels_.try_emplace(participant);
  if (!is_new) return entry->second;
  std::string label;
  for (const char c : participant) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 128) {
      label += c;
    }
  }
  // Two names may keep the same letters.
  const auto is_taken = [&](const std::string& text) { return num_runs_.count(text) > 0; };
  std::string unique = label.empty() ? "x" : label;
  for (int i = 2; is_taken(unique); ++i) unique = label + "x" + std::to_string(i);
  num_runs_[unique] = 0;
  return entry->second = unique;
}

void MotionBidsWriter::WriteTrial(const StudyTrial& trial, const ReachTrial& reach) {
  const std::string& label = FindLabel(trial.participant);
  const std::string subject = "sub-" + label;
  const std::string stem = subject + "_task-" + study_->config.task;
  const std::string end = "_run-" + std::to_string(++num_runs_[label]) + "_desc-cleaned";
  const std::filesystem::path folder = folder_ / subject / "motion";
  MakeFolder(folder);

  const std::vector<TrackedPoint> points = ListPoints(reach);
  std::vector<std::string> names;
  for (const TrackedPoint& point : points) names.push_back(point.name);
  if (reach.object.IsRecorded()) names.push_back("object");
  const std::string motion = stem + "_tracksys-markers" + end;
  WriteFile(folder / (motion + "_motion.tsv"),
            FormatMotion(points, reach.object, reach.times.size()));
  WriteFile(folder / (motion + "_channels.tsv"), FormatChannels(names));
  WriteFile(folder / (motion + "_motion.json"),
            FormatJson(DescribeMotion(study_->config, reach, names.size()), 2) + "\n");
  WriteFile(folder / (stem + end + "_events.tsv"), FormatEvents(trial, study_->config));
}

void MotionBidsWriter::Finish() const {
  std::string participants = "participant_id\n";
  for (const auto& [label, count] : num_runs_) participants += "sub-" + label + "\n";
  WriteFile(folder_ / "participants.tsv", participants);
  WriteFile(folder_ / "README", kReadme);
  // A folder with a description is whole, also after a power failure.
  SyncFileSystem(folder_);
  const Json description = {
      {"Name", study_->config.name},
      {"BIDSVersion", "1.9.0"},
      {"DatasetType", "derivative"},
      {"GeneratedBy", {{{"Name", "graspbench"}, {"Version", program_version()}}}}};
  WriteFileAtomically(folder_ / "dataset_description.json", FormatJson(description, 2) + "\n");
}

}  // namespace graspbench
