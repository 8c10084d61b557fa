#include "human_study/study/synthetic/synthetic_study.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/random.h"
#include "core/base/text/csv.h"
#include "core/base/units.h"
#include "human_study/events/hand_opening.h"
#include "human_study/recording/save_recording.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kReach = 0.35;               // start to object [m]
constexpr double kStartHalfAperture = 0.012;  // of the markers at the start [m]
constexpr double kOvershootPlace = 0.7;       // share of the duration at which it is prescribed
constexpr double kWristShare = 0.95;          // of the digits' duration after which the wrist rests
constexpr double kPushDuration = 0.1;         // [s]
constexpr double kLiftHeight = 0.15;          // [m]
constexpr double kLiftDuration = 0.7;         // [s]
constexpr double kLiftTilt = RadFromDeg(8.0);
constexpr double kHoldDuration = 0.3;  // [s] recorded after the lift
constexpr double kLongerHold = 0.2;    // [s] of an object that is not lifted
constexpr double kComingBack = 0.4;  // [s] recorded less before the onset when the hand never rests
constexpr double kAfterReturn = 0.1;  // [s] recorded after the way back
constexpr double kForce = 2.0;        // of each digit in the hold [N]
constexpr double kForceTime = 0.08;   // time constant of its rise [s]
constexpr double kForceNoise = 0.01;  // [N]
constexpr size_t kForceSamplesPerFrame = 5;

/** 0 to 1 with no speed and acceleration at either end (Flash and Hogan 1985). */
double MinimumJerk(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

/** What is the same in all trials of a person. */
struct Person {
  double duration;             // onset to contact [s]
  double overshoot;            // of the opening beyond the object of 50 mm [m]
  std::vector<double> delays;  // of each digit's contact [s]
};

Person DrawPerson(const SyntheticOptions& options, const std::string& id) {
  RandomStream random(options.seed, "person " + id);
  Person person;
  person.duration = std::clamp(0.9 + 0.08 * random.NextNormal(), 0.7, 1.1);
  person.overshoot = std::clamp(0.019 + 0.003 * random.NextNormal(), 0.013, 0.025);
  for (int d = 0; d < options.num_digits; ++d) {
    // From radial to ulnar, as most people.
    person.delays.push_back(0.006 * d + 0.005 * random.NextNormal());
  }
  return person;
}

/** One digit's path in O: a polynomial of fifth degree to the contact, then rest on the surface. */
struct DigitPath {
  Vector3d start, place, normal;  // normal out of the object
  double onset, contact, contact_speed, deceleration, compression;

  Vector3d Find(double t) const {
    if (t >= contact) {
      if (compression == 0.0) return place;
      const double depth =
          compression * (1.0 - std::exp(-contact_speed * (t - contact) / compression));
      return place - depth * normal;
    }
    const double duration = contact - onset;
    const double s = std::max(0.0, (t - onset) / duration), r = 1.0 - s;
    const double s3 = s * s * s;
    return start + MinimumJerk(s) * (place - start) +
           normal * (contact_speed * duration * s3 * r * (4.0 - 3.0 * s) +
                     deceleration * duration * duration * 0.5 * s3 * r * r);
  }
};

/** Deceleration at contact that gives the overshoot at kOvershootPlace. */
double CalcDeceleration(const DigitPath& path, double overshoot) {
  const double s = kOvershootPlace, r = 1.0 - s, s3 = s * s * s;
  const double duration = path.contact - path.onset;
  const double deficit = (1.0 - MinimumJerk(s)) * std::abs(path.place.x() - path.start.x());
  const double by_speed = path.contact_speed * duration * s3 * r * (4.0 - 3.0 * s);
  return (overshoot + deficit - by_speed) / (duration * duration * 0.5 * s3 * r * r);
}

struct Scene {
  double onset, end;
  double lift_off = std::numeric_limits<double>::infinity();  ///< never, as release
  double release = std::numeric_limits<double>::infinity();
  std::vector<DigitPath> digits;
  double push_begin;
  Vector3d push = Vector3d::Zero();
  Vector3d p_LO = Vector3d(0.0, kReach, kSyntheticObjectHeight / 2);  // at rest
  double wrist_duration;
  bool rests;

  Pose FindObject(double t) const {
    const double lift = MinimumJerk((t - lift_off) / kLiftDuration);
    const Vector3d place = p_LO + MinimumJerk((t - push_begin) / kPushDuration) * push +
                           lift * Vector3d(0.0, 0.0, kLiftHeight);
    return MakePose(MakeRotationRpy(lift * kLiftTilt, 0.0, 0.0), place);
  }
  /** The instant of the way out at which what arrives at `arrival` was where it is at `t`. */
  double FindWayOut(double t, double arrival) const {
    if (t > release) return arrival - (t - release);
    return rests ? t : onset + std::abs(t - onset);
  }
  Vector3d FindTip(size_t digit, double t) const {
    const DigitPath& path = digits[digit];
    return FindObject(t) * path.Find(FindWayOut(t, path.contact));
  }
  Vector3d FindWrist(double t) const {
    const Vector3d start(0.0, -0.13, 0.06), stop(0.0, kReach - 0.15, 0.12);
    const double way_out = FindWayOut(t, onset + wrist_duration);
    const Vector3d reach = MinimumJerk((way_out - onset) / wrist_duration) * (stop - start);
    return start + reach + FindObject(t).translation() - p_LO;
  }
};

std::vector<double> DrawDelays(const SyntheticOptions& options, const Person& person,
                               RandomStream& random) {
  std::vector<double> delays = person.delays;
  for (double& delay : delays) delay += 0.008 * random.NextNormal();
  const double earliest = *std::min_element(delays.begin(), delays.end());
  const double range = *std::max_element(delays.begin(), delays.end()) - earliest;
  for (double& delay : delays) {
    delay -= earliest;
    if (std::isfinite(options.forming_time)) delay *= options.forming_time / range;
  }
  return delays;
}

Scene MakeScene(const SyntheticOptions& options, const Person& person, double diameter,
                RandomStream& random) {
  constexpr double kThumbAzimuth_deg = 180.0;
  constexpr double kAzimuths_deg[] = {kThumbAzimuth_deg, 15.0, 5.0, -5.0, -15.0};
  constexpr double kHeights[] = {0.01, 0.03, 0.01, -0.01, -0.03};  // above the object's centre [m]
  Scene scene;
  scene.onset = random.NextUniform(0.5, 0.6) - (options.rests ? 0.0 : kComingBack);
  scene.rests = options.rests;
  const double duration = std::max(0.5, person.duration + 0.04 * random.NextNormal());
  const double overshoot =
      person.overshoot + 0.003 * random.NextNormal() - 0.38 * (diameter - 0.05);
  const std::vector<double> delays = DrawDelays(options, person, random);
  double last_contact = 0.0;
  for (size_t d = 0; d < delays.size(); ++d) {
    DigitPath path;
    const double azimuth = RadFromDeg(kAzimuths_deg[d]);
    path.normal = Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0);
    path.place = (diameter / 2 + kSyntheticPadOffset) * path.normal + Vector3d(0, 0, kHeights[d]);
    const double side = d == 0 ? -1.0 : 1.0;
    path.start = Vector3d(side * kStartHalfAperture, -kReach, 0.3 * kHeights[d] - 0.02);
    path.onset = scene.onset;
    path.contact = scene.onset + duration + delays[d];
    path.contact_speed = random.NextUniform(options.min_contact_speed, options.max_contact_speed);
    path.compression = options.pad_compression;
    path.deceleration = CalcDeceleration(path, overshoot / 2);
    last_contact = std::max(last_contact, path.contact);
    if (d == 0 || path.contact < scene.push_begin) {
      scene.push_begin = path.contact;
      scene.push = -options.push * path.normal;
    }
    scene.digits.push_back(path);
  }
  scene.wrist_duration = kWristShare * duration;
  const double held = last_contact + std::max(0.12, 0.2 + 0.03 * random.NextNormal());
  if (options.lifts) {
    scene.lift_off = held;
    scene.end = held + kLiftDuration + kHoldDuration;
  } else {
    scene.release = held + kLongerHold;
    scene.end = scene.release + duration + kAfterReturn;
  }
  return scene;
}

SyntheticTruth FindTruth(const Scene& scene) {
  constexpr double kStep = 0.0005;  // [s] of the search for the maxima
  SyntheticTruth truth;
  truth.onset = scene.onset;
  truth.movement_end = scene.onset + scene.wrist_duration;
  const auto time_or_none = [](double t) { return std::isfinite(t) ? t : std::nan(""); };
  truth.lift_off = time_or_none(scene.lift_off);
  truth.release = time_or_none(scene.release);
  for (const DigitPath& path : scene.digits) truth.contacts.push_back(path.contact);
  const HandOpening &aperture = FindHandOpening("aperture"),
                    &opening = FindHandOpening(kDefaultHandOpening);
  const double first = *std::min_element(truth.contacts.begin(), truth.contacts.end());
  double widest = 0.0;
  Eigen::Matrix3Xd tips(3, static_cast<Eigen::Index>(scene.digits.size()));
  for (double t = scene.onset; t <= first; t += kStep) {
    for (size_t d = 0; d < scene.digits.size(); ++d) {
      tips.col(static_cast<Eigen::Index>(d)) = scene.FindTip(d, t);
    }
    const double distance = aperture.calc(tips), width = opening.calc(tips);
    if (distance > truth.peak_aperture) {
      truth.peak_aperture = distance;
      truth.peak_aperture_time = t;
    }
    if (width > widest) {
      widest = width;
      truth.peak_opening = t;
    }
  }
  return truth;
}

/** Records one marker with noise and, when asked, drop-outs. */
template <class Path>
RecordedPoint RecordMarker(const std::string& label, const Recording& recording,
                           const std::string& trial_id, const SyntheticOptions& options,
                           double dropouts_per_second, const Path& path) {
  RandomStream noise(trial_id, "noise " + label), dropout(trial_id, "drop-outs " + label);
  RecordedPoint point;
  point.label = label;
  point.unit = "mm";
  point.metres_per_unit = MFromMm(1.0);
  double hidden_until = -1.0;
  for (size_t i = 0; i < recording.num_frames; ++i) {
    const double t = recording.Time(i);
    Vector3d p = path(t);
    for (int axis = 0; axis < 3; ++axis) p[axis] += options.noise * noise.NextNormal();
    point.Append(MmFromM(p.x()), MmFromM(p.y()), MmFromM(p.z()));
    if (dropout.NextUnit() * options.rate < dropouts_per_second) {
      hidden_until = t - options.dropout_duration * std::log(1.0 - dropout.NextUnit());
    }
    if (t < hidden_until) point.SetInvalid(i);
  }
  return point;
}

AnalogChannel RecordForce(const std::string& digit, double contact, double release,
                          const Recording& recording, const std::string& trial_id) {
  RandomStream noise(trial_id, "force " + digit);
  AnalogChannel channel;
  channel.label = "force_" + digit;
  channel.unit = "N";
  channel.rate = recording.rate * static_cast<double>(kForceSamplesPerFrame);
  for (size_t k = 0; k < kForceSamplesPerFrame * recording.num_frames; ++k) {
    const double t = recording.start_time + static_cast<double>(k) / channel.rate;
    const double late = t - contact;
    const double force =
        late > 0.0 && t < release ? kForce * (1.0 - std::exp(-late / kForceTime)) : 0.0;
    channel.samples.push_back(static_cast<float>(force + kForceNoise * noise.NextNormal()));
  }
  return channel;
}

Recording Record(const Scene& scene, double diameter, const std::string& trial_id,
                 const SyntheticOptions& options) {
  Recording recording;
  recording.format = "synthetic";
  recording.rate = options.rate;
  recording.num_frames = static_cast<size_t>(scene.end * options.rate) + 1;
  for (size_t d = 0; d < scene.digits.size(); ++d) {
    recording.points.push_back(RecordMarker(SyntheticTipLabels()[d], recording, trial_id, options,
                                            options.dropouts_per_second,
                                            [&](double t) { return scene.FindTip(d, t); }));
    if (options.has_force) {
      recording.analog.push_back(RecordForce(SyntheticDigits()[d], scene.digits[d].contact,
                                             scene.release, recording, trial_id));
    }
  }
  recording.points.push_back(RecordMarker(kSyntheticWristLabel, recording, trial_id, options, 0.0,
                                          [&](double t) { return scene.FindWrist(t); }));
  const std::vector<Vector3d> places = SyntheticMarkerPlaces(diameter);
  for (size_t m = 0; m < places.size(); ++m) {
    recording.points.push_back(
        RecordMarker("object_" + std::to_string(m + 1), recording, trial_id, options, 0.0,
                     [&](double t) { return Vector3d(scene.FindObject(t) * places[m]); }));
  }
  return recording;
}

void CheckSyntheticOptions(const SyntheticOptions& options) {
  const auto check = [](const char* name, bool is_good, const std::string& expected) {
    if (is_good) return;
    throw Error(ErrorKind::kRange,
                std::string("synthetic study: ") + name + " must be " + expected);
  };
  check("the number of people", options.num_people >= 1 && options.num_people <= 999, "1 to 999");
  check("the number of trials per size",
        options.trials_per_size >= 1 && options.trials_per_size <= 999, "1 to 999");
  check("the number of digits",
        options.num_digits >= 2 && options.num_digits <= static_cast<int>(SyntheticDigits().size()),
        "2 to 5");
  check("the list of diameters", !options.diameters.empty(), "not empty");
  for (const double diameter : options.diameters) {
    check("a diameter", diameter >= 0.02 && diameter <= 0.09, "0.02 to 0.09 m, a hand's span");
  }
  check("the rate", options.rate >= 20.0 && options.rate <= 2000.0, "20 to 2000 Hz");
  check("the noise", options.noise >= 0.0 && options.noise <= 0.01, "0 to 0.01 m");
  check("the number of drop-outs per second",
        options.dropouts_per_second >= 0.0 && options.dropouts_per_second <= options.rate,
        "0 to the rate");
  check("the duration of drop-outs", options.dropout_duration >= 0.0, "0 or more");
  check("the forming time",
        std::isnan(options.forming_time) ||
            (options.forming_time >= 0.0 && options.forming_time <= 0.2),
        "0 to 0.2 s");
  check("the speed at contact",
        options.min_contact_speed >= 0.0 &&
            options.max_contact_speed >= options.min_contact_speed &&
            options.max_contact_speed <= 0.5,
        "0 to 0.5 m/s, the smaller one first");
  check("the compression of the pads",
        options.pad_compression >= 0.0 && options.pad_compression <= 0.03, "0 to 0.03 m");
  check("the push", options.push >= 0.0 && options.push <= 0.02, "0 to 0.02 m");
}

}  // namespace

std::vector<Eigen::Vector3d> SyntheticMarkerPlaces(double diameter) {
  const double top = kSyntheticObjectHeight / 2;
  return {{0.0, diameter / 2, top}, {-diameter / 2, 0.0, top}, {0.0, -diameter / 2, top - 0.03}};
}

std::vector<SyntheticTrial> MakeSyntheticStudy(const SyntheticOptions& options) {
  CheckSyntheticOptions(options);
  std::vector<SyntheticTrial> trials;
  for (int p = 1; p <= options.num_people; ++p) {
    const std::string person_id = fmt::format("{:02}", p);
    const Person person = DrawPerson(options, person_id);
    std::vector<double> diameters;
    for (int repetition = 0; repetition < options.trials_per_size; ++repetition) {
      diameters.insert(diameters.end(), options.diameters.begin(), options.diameters.end());
    }
    RandomStream order(options.seed, "order " + person_id);
    for (size_t i = diameters.size(); i-- > 1;) {
      std::swap(diameters[i],
                diameters[static_cast<size_t>(order.NextIndex(static_cast<int>(i) + 1))]);
    }
    for (size_t i = 0; i < diameters.size(); ++i) {
      SyntheticTrial trial;
      trial.person = person_id;
      trial.trial = static_cast<int>(i) + 1;
      trial.diameter = diameters[i];
      const std::string trial_id =
          options.seed + "/" + person_id + "/" + std::to_string(trial.trial);
      RandomStream random(trial_id, "movement");
      const Scene scene = MakeScene(options, person, trial.diameter, random);
      trial.truth = FindTruth(scene);
      trial.recording = Record(scene, trial.diameter, trial_id, options);
      trials.push_back(std::move(trial));
    }
  }
  return trials;
}

ReachTrial MakeReachTrial(const SyntheticTrial& trial) {
  ReachTrial reach;
  std::vector<Trajectory> markers;
  for (const RecordedPoint& point : trial.recording.points) {
    Trajectory path = MakeTrajectory(trial.recording, point.label);
    const std::vector<std::string>& tips = SyntheticTipLabels();
    const auto tip = std::find(tips.begin(), tips.end(), point.label);
    if (tip != tips.end()) {
      DigitTrack digit;
      digit.digit = SyntheticDigits()[static_cast<size_t>(tip - tips.begin())];
      digit.is_thumb = tip == tips.begin();
      digit.tip = std::move(path);
      reach.digits.push_back(std::move(digit));
    } else if (point.label == kSyntheticWristLabel) {
      reach.wrist = std::move(path);
    } else {
      markers.push_back(std::move(path));
    }
  }
  reach.times = reach.wrist.times;
  reach.object = MakeObjectTrack(markers, SyntheticMarkerPlaces(trial.diameter));
  reach.object.distance = MakeCylinderDistance(trial.diameter / 2, kSyntheticObjectHeight);
  for (size_t c = 0; c < trial.recording.analog.size(); ++c) {
    const AnalogChannel& channel = trial.recording.analog[c];
    ForceChannel& force = reach.digits[c].force;
    force.values.assign(channel.samples.begin(), channel.samples.end());
    for (size_t k = 0; k < channel.samples.size(); ++k) {
      force.times.push_back(trial.recording.start_time + static_cast<double>(k) / channel.rate);
    }
  }
  return reach;
}

std::string SyntheticFileName(const SyntheticTrial& trial, SyntheticFormat format) {
  return "sub-" + trial.person + fmt::format("_trial-{:03}", trial.trial) +
         (format == SyntheticFormat::kC3d ? ".c3d" : ".tsv");
}

namespace {

std::vector<CsvColumn<SyntheticTrial>> ListTruthColumns(size_t num_digits, SyntheticFormat format) {
  using Column = CsvColumn<SyntheticTrial>;
  const auto time = [](std::string name, std::string meaning, double SyntheticTruth::*field) {
    return Column{std::move(name), "number", "s", std::move(meaning),
                  [field](const SyntheticTrial& t) { return Json(t.truth.*field); }};
  };
  std::vector<Column> columns = {
      {"file", "", "recording",
       [format](const SyntheticTrial& t) { return SyntheticFileName(t, format); }},
      {"person", "", "who", &SyntheticTrial::person},
      {"trial", "", "number within the person", &SyntheticTrial::trial},
      {"diameter_m", "m", "of the object", &SyntheticTrial::diameter},
      time("onset_s", "everything starts to move", &SyntheticTruth::onset),
      time("movement_end_s", "the wrist stops", &SyntheticTruth::movement_end),
      time("peak_opening_s", "thumb to virtual finger is widest", &SyntheticTruth::peak_opening),
      {"peak_aperture_m", "number", "m", "largest thumb-index distance of the markers",
       [](const SyntheticTrial& t) { return Json(t.truth.peak_aperture); }},
      time("peak_aperture_s", "instant of that", &SyntheticTruth::peak_aperture_time),
      time("lift_off_s", "the object leaves the table", &SyntheticTruth::lift_off),
      time("release_s", "the digits let go of an object that is not lifted",
           &SyntheticTruth::release)};
  for (size_t d = 0; d < num_digits; ++d) {
    columns.push_back({"contact_" + SyntheticDigits()[d] + "_s", "number", "s", "first contact",
                       [d](const SyntheticTrial& t) { return Json(t.truth.contacts[d]); }});
  }
  return columns;
}

}  // namespace

std::string FormatTruthCsv(const std::vector<SyntheticTrial>& trials, SyntheticFormat format) {
  const size_t num_digits = trials.empty() ? 0 : trials[0].truth.contacts.size();
  return FormatCsv(ListTruthColumns(num_digits, format), trials);
}

Json MakeTruthSchema() {
  return MakeTableSchema(ListTruthColumns(SyntheticDigits().size(), SyntheticFormat::kC3d), "");
}

void SaveSyntheticStudy(const std::vector<SyntheticTrial>& trials, SyntheticFormat format,
                        const std::filesystem::path& folder) {
  MakeFolder(folder);
  for (const SyntheticTrial& trial : trials) {
    SaveRecording(folder / SyntheticFileName(trial, format), trial.recording);
  }
  WriteFileAtomically(folder / "truth.csv", FormatTruthCsv(trials, format));
}

}  // namespace graspbench
