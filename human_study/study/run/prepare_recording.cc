#include "human_study/study/run/prepare_recording.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "human_study/events/scalar_curve.h"
#include "human_study/recording/cleaning/butterworth.h"
#include "human_study/recording/cleaning/gaps.h"
#include "human_study/recording/cleaning/trajectory.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/importers/table_mapping.h"

namespace graspbench {
namespace {

/** A gap of the resampled clock: intervals longer than this many median ones are no neighbours. */
constexpr double kMaxIntervals = 2.5;
constexpr double kLeastRate = 10.0;  // a reach takes a second [Hz]

std::vector<std::string> ListLabels(const Recording& recording) {
  std::vector<std::string> labels;
  for (const RecordedPoint& point : recording.points) labels.push_back(point.label);
  return labels;
}

const std::string* FindFirst(const std::vector<std::string>& wanted,
                             const std::vector<std::string>& labels) {
  for (const std::string& label : wanted) {
    if (std::find(labels.begin(), labels.end(), label) != labels.end()) return &label;
  }
  return nullptr;
}

std::string DescribeMissing(const char* role, const std::vector<std::string>& wanted,
                            const std::vector<std::string>& labels) {
  std::string list;
  for (const std::string& label : wanted) list += (list.empty() ? "\"" : ", \"") + label + "\"";
  return std::string("no marker for the ") + role + ": the recording has no " + list +
         SuggestNames(wanted.front(), labels);
}

bool IsSeen(const Recording& recording, const std::string& label) {
  const RecordedPoint& point = recording.FindPoint(label);
  return point.CountStates(SampleState::kInvalid) < point.states.size();
}

std::string DescribeUnseen(const char* role, const std::string& label) {
  return std::string("no marker for the ") + role + ": \"" + label +
         "\" has no place in any sample of the recording";
}

/** One wrong time must not become a clock of years. */
void CheckSpan(const Trajectory& track, const SamplingReport& sampling) {
  constexpr double kSparsest = 100.0;  // of its samples that a recording may lack
  const double span = track.times.back() - track.times.front();
  if (span < kSparsest * sampling.median_interval * static_cast<double>(track.size())) return;
  throw Error(
      ErrorKind::kFormat,
      fmt::format("the recording's {} samples span {:.3g} s, one interval alone {:.3g} s: a "
                  "time is wrong. Correct it, or cut the recording there",
                  track.size(), span, sampling.longest_interval));
}

/** Cleans tracks of one recording alike. */
class Cleaner {
 public:
  Cleaner(const Recording& recording, const CleaningConfig& config)
      : recording_(&recording), config_(&config) {}

  Trajectory Clean(const std::string& label, PreparedRecording& prepared) const {
    Trajectory track = MakeTrajectory(*recording_, label);
    prepared.num_samples += track.size();
    prepared.num_spikes += InvalidateSpikes(track);
    if (config_->drop_frozen) prepared.num_frozen += InvalidateFrozenSamples(track);
    const SamplingReport sampling = FindSampling(track.times);
    if (!(sampling.median_interval > 0.0)) {
      throw Error(ErrorKind::kFormat, "the recording has fewer than two samples");
    }
    prepared.rate = 1.0 / sampling.median_interval;
    if (prepared.rate < kLeastRate) {
      throw Error(ErrorKind::kFormat,
                  fmt::format("the recording has {:.3g} samples a second, too few for a reach: its "
                              "times may be in milliseconds (time_unit: ms in the mapping) or "
                              "count frames (state rate_hz there instead of time)",
                              prepared.rate));
    }
    CheckSpan(track, sampling);
    prepared.was_resampled = !sampling.is_even;
    if (!sampling.is_even) {
      track = Resample(track, prepared.rate, kMaxIntervals * sampling.median_interval);
    }
    FillGaps(track, config_->max_gap);
    if (prepared.times.empty()) prepared.times = track.times;
    return track;
  }

 private:
  const Recording* recording_;
  const CleaningConfig* config_;
};

ForceChannel FindForce(const Recording& recording, const std::string& label) {
  ForceChannel force;
  if (label.empty()) return force;
  std::vector<std::string> labels;
  for (const AnalogChannel& channel : recording.analog) {
    labels.push_back(channel.label);
    if (channel.label != label) continue;
    const double start = recording.num_frames > 0 ? recording.Time(0) : 0.0;
    for (size_t i = 0; i < channel.samples.size(); ++i) {
      force.times.push_back(start + static_cast<double>(i) / channel.rate);
      force.values.push_back(channel.samples[i]);
    }
    return force;
  }
  throw Error(ErrorKind::kNotFound,
              "no analog channel \"" + label + "\"" + SuggestNames(label, labels));
}

Trajectory Slice(const Trajectory& track, const SampleRun& run) {
  Trajectory part;
  if (track.size() == 0) return part;
  const auto first = static_cast<std::ptrdiff_t>(run.first);
  const auto last = static_cast<std::ptrdiff_t>(run.last);
  part.times.assign(track.times.begin() + first, track.times.begin() + last);
  part.states.assign(track.states.begin() + first, track.states.begin() + last);
  part.p = track.p.middleCols(first, last - first);
  return part;
}

ForceChannel Slice(const ForceChannel& force, const Reach& part) {
  ForceChannel slice;
  for (size_t i = 0; i < force.times.size(); ++i) {
    if (force.times[i] < part.begin || force.times[i] > part.end) continue;
    slice.times.push_back(force.times[i]);
    slice.values.push_back(force.values[i]);
  }
  return slice;
}

/** Mean of the valid ones at one sample; NaN without any. */
Eigen::Vector3d CalcMiddle(const std::vector<const Trajectory*>& tracks, size_t sample) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const Trajectory* track : tracks) {
    if (!track->IsValid(sample)) continue;
    sum += track->p.col(static_cast<Eigen::Index>(sample));
    ++count;
  }
  if (count == 0) return Eigen::Vector3d::Constant(std::nan(""));
  return sum / count;
}

/** Two skins cannot be in one place: such digits are one marker under two names. */
void CheckDigitsDiffer(const std::vector<DigitTrack>& digits) {
  constexpr size_t kEnough = 10;  // samples
  for (size_t a = 0; a < digits.size(); ++a) {
    for (size_t b = a + 1; b < digits.size(); ++b) {
      const Trajectory &one = digits[a].tip, &other = digits[b].tip;
      size_t num_both = 0, num_equal = 0;
      for (size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
        if (!one.IsValid(i) || !other.IsValid(i)) continue;
        const auto column = static_cast<Eigen::Index>(i);
        ++num_both;
        num_equal += one.p.col(column) == other.p.col(column);
      }
      if (num_both < kEnough || num_equal < num_both) continue;
      throw Error(ErrorKind::kFormat,
                  "the " + NameOfDigit(digits[a].digit) + " and the " +
                      NameOfDigit(digits[b].digit) + " are at the same place in all " +
                      std::to_string(num_both) +
                      " samples that show both: one marker stands for two digits; give each its "
                      "own under markers, and its own columns in the mapping");
    }
  }
}

std::vector<const Trajectory*> ListTracks(const PreparedRecording& prepared) {
  std::vector<const Trajectory*> tracks;
  for (const DigitTrack& digit : prepared.digits) tracks.push_back(&digit.tip);
  for (const Trajectory& marker : prepared.object_markers) tracks.push_back(&marker);
  if (prepared.wrist.size() > 0) tracks.push_back(&prepared.wrist);
  return tracks;
}

/** Of tips, their companions, wrist and object, as they were recorded. */
std::vector<ExchangedMarkers> FindExchanges(const Recording& recording,
                                            const MarkerConfig& markers) {
  const std::vector<std::string> labels = ListLabels(recording);
  std::vector<std::string> names;
  std::vector<Trajectory> tracks;
  const auto add = [&](const std::string& name, const std::vector<std::string>& wanted) {
    const std::string* label = FindFirst(wanted, labels);
    if (label == nullptr) return;
    names.push_back(name.empty() ? "\"" + *label + "\"" : name);
    tracks.push_back(MakeTrajectory(recording, *label));
  };
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    add(NameOfDigit(digit), markers.tips[digit]);
    add("", {markers.companions[digit]});
  }
  add("", markers.wrist);
  for (const std::string& label : markers.object) add("", {label});
  std::vector<ExchangedMarkers> exchanges;
  for (const LabelExchange& exchange : FindLabelExchanges(tracks)) {
    exchanges.push_back({tracks.front().times[exchange.sample], names[exchange.label],
                         names[exchange.other], exchange.distance});
  }
  return exchanges;
}

}  // namespace

std::optional<TableRows> StudyTables::Find(const Study& study, const PlannedReach& planned) {
  const std::string& mapping = study.config.recording.mapping;
  const std::string& format = study.config.recording.format;
  const bool is_table = !mapping.empty() && (format.empty() || format == "table");
  if (!is_table || planned.table_trial.empty()) return std::nullopt;
  const auto [table, is_new] = tables_.try_emplace(planned.file);
  if (is_new) {
    for (const TableTrial& trial : FindTableTrials(study.recordings / planned.file,
                                                   LoadTableMapping(study.folder / mapping))) {
      table->second.emplace(trial.name, trial.rows);
    }
  }
  const auto found = table->second.find(planned.table_trial);
  return found == table->second.end() ? std::nullopt : std::optional(found->second);
}

Recording LoadPlanned(const Study& study, const PlannedReach& planned, StudyTables& tables) {
  const RecordingConfig& config = study.config.recording;
  ImportOptions options;
  options.format = config.format;
  options.unit = config.unit;
  options.accept_truncated = config.accept_truncated;
  if (!config.mapping.empty()) options.mapping = study.folder / config.mapping;
  options.trial = planned.table_trial;
  options.rows = tables.Find(study, planned);
  return LoadRecording(study.recordings / planned.file, options);
}

PreparedRecording PrepareRecording(const Recording& recording, const StudyConfig& config) {
  PreparedRecording prepared;
  const std::vector<std::string> labels = ListLabels(recording);
  const Cleaner cleaner(recording, config.cleaning);
  const auto miss = [&](int digit, const char* role, const std::vector<std::string>& wanted) {
    prepared.missing.push_back({digit, DescribeMissing(role, wanted, labels)});
  };
  /** The first label that the recording has, if it shows its marker at all. */
  const auto find = [&](int digit, const char* role, const std::vector<std::string>& wanted) {
    const std::string* label = FindFirst(wanted, labels);
    if (label == nullptr) {
      miss(digit, role, wanted);
    } else if (!IsSeen(recording, *label)) {
      prepared.missing.push_back({digit, DescribeUnseen(role, *label)});
      label = nullptr;
    }
    return label;
  };
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    const std::vector<std::string>& wanted = config.markers.tips[digit];
    if (wanted.empty()) continue;
    const std::string* label = find(digit, NameOfDigit(digit), wanted);
    if (label == nullptr) continue;
    DigitTrack track;
    track.digit = IdOfDigit(digit);
    track.is_thumb = digit == 0;
    track.tip = cleaner.Clean(*label, prepared);
    const std::string& companion = config.markers.companions[digit];
    if (!companion.empty()) {
      if (FindFirst({companion}, labels) == nullptr) {
        miss(-1, (std::string("companion of the ") + NameOfDigit(digit)).c_str(), {companion});
      } else {
        FillGapsAlong(track.tip, cleaner.Clean(companion, prepared),
                      config.cleaning.max_companion_gap);
      }
    }
    for (const std::string& joint : config.markers.joints[digit]) {
      const std::string role = std::string("joint of the ") + NameOfDigit(digit);
      if (find(-1, role.c_str(), {joint}) == nullptr) continue;
      track.joints.push_back(cleaner.Clean(joint, prepared));
    }
    track.pad_offset = config.pad_offsets[digit];
    track.force = FindForce(recording, config.forces[digit]);
    prepared.digits.push_back(track);
  }
  CheckDigitsDiffer(prepared.digits);
  if (!config.markers.wrist.empty()) {
    const std::string* label = find(-1, "wrist", config.markers.wrist);
    if (label != nullptr) prepared.wrist = cleaner.Clean(*label, prepared);
  }
  const std::string* unseen = nullptr;  // of the object's
  for (const std::string& label : config.markers.object) {
    if (FindFirst({label}, labels) == nullptr) continue;
    if (!IsSeen(recording, label)) {
      unseen = &label;
      continue;
    }
    prepared.object_markers.push_back(cleaner.Clean(label, prepared));
  }
  if (!config.markers.object.empty() && prepared.object_markers.empty()) {
    if (unseen != nullptr) {
      prepared.missing.push_back({-1, DescribeUnseen("object", *unseen)});
    } else {
      miss(-1, "object", config.markers.object);
    }
  }
  prepared.exchanges = FindExchanges(recording, config.markers);
  // Resampling is a filter itself, and its clock hides no frame.
  if (!prepared.was_resampled) {
    const std::vector<const Trajectory*> tracks = ListTracks(prepared);
    prepared.low_pass = FindLowPassTrace(tracks);
    prepared.frame_losses = FindFrameLosses(tracks);
  }
  return prepared;
}

std::vector<double> CalcHandDistances(const PreparedRecording& recording) {
  std::vector<const Trajectory*> tips, markers;
  for (const DigitTrack& digit : recording.digits) tips.push_back(&digit.tip);
  for (const Trajectory& marker : recording.object_markers) markers.push_back(&marker);
  std::vector<double> distances;
  for (size_t i = 0; i < recording.times.size(); ++i) {
    distances.push_back((CalcMiddle(tips, i) - CalcMiddle(markers, i)).norm());
  }
  return distances;
}

std::vector<Reach> FindReaches(const PreparedRecording& recording, const CutConfig& cut) {
  const std::vector<double> distances = CalcHandDistances(recording);
  std::vector<Reach> reaches;
  bool is_at_object = false, is_open = false;  // open: the last reach ends farther on
  double farthest = -1.0, farthest_time = 0.0;
  for (size_t i = 0; i < recording.times.size(); ++i) {
    const double distance = distances[i];
    if (std::isnan(distance)) continue;
    const double time = recording.times[i];
    if (distance < cut.near && !is_at_object) {
      is_at_object = true;
      is_open = farthest > cut.far;
      if (is_open) reaches.push_back({farthest_time, time});
      farthest = -1.0;
    }
    if (distance > cut.far) is_at_object = false;
    if (distance > farthest) {
      farthest = distance;
      farthest_time = time;
      if (is_open) reaches.back().end = time;
    }
  }
  return reaches;
}

ReachTrial MakeReachTrial(const PreparedRecording& recording, const Reach& part,
                          const StudyConfig& config, const StudyObject* object) {
  const SampleRun run = FindSamples(recording.times, part.begin, part.end);
  if (run.size() < 10) {
    throw Error(ErrorKind::kRange, "only " + std::to_string(run.size()) +
                                       " samples between start and end; expected at least 10");
  }
  ReachTrial trial;
  const auto first = static_cast<std::ptrdiff_t>(run.first);
  trial.low_pass = recording.low_pass;
  trial.times.assign(recording.times.begin() + first,
                     recording.times.begin() + static_cast<std::ptrdiff_t>(run.last));
  for (const DigitTrack& digit : recording.digits) {
    DigitTrack track = digit;
    track.tip = Slice(digit.tip, run);
    for (Trajectory& joint : track.joints) joint = Slice(joint, run);
    track.force = Slice(digit.force, part);
    trial.digits.push_back(track);
  }
  trial.wrist = Slice(recording.wrist, run);
  if (!recording.object_markers.empty()) {
    std::vector<Trajectory> markers;
    for (const Trajectory& marker : recording.object_markers) {
      markers.push_back(Slice(marker, run));
    }
    const double rest_end = trial.times.front() +
                            config.cleaning.rest_share * (trial.times.back() - trial.times.front());
    const Eigen::Vector3d p_MO_L = object ? object->p_MO_L : Eigen::Vector3d::Zero();
    const LiftOffOptions& lift_off = config.analysis.lift_off;
    const Eigen::Matrix3d R_LO =
        MakeUprightOrientation({lift_off.up_x, lift_off.up_y, lift_off.up_z});
    trial.object =
        MakeObjectTrack(markers, FindMarkerPlaces(markers, rest_end, p_MO_L, R_LO), R_LO);
    if (object) trial.object.distance = object->distance;
  }
  CheckTrial(trial);
  return trial;
}

}  // namespace graspbench
