#include "workbench/transfer/study_grasps.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/develop/propose_grasps.h"
#include "core/develop/write_grasps.h"
#include "core/grasp/grasp_file.h"
#include "core/grasp/grasp_yaml.h"
#include "core/hand/load_hand.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
#include "core/statistics/summary.h"
#include "datasets/plan/session_inputs.h"
#include "objects/catalogue.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kCatalogueShape[] = "catalogue";

TriMesh MakeStudyMesh(const StudyObject& object) {
  constexpr int kSegments = 64;
  const Eigen::Vector3d half = 0.5 * object.size;
  if (object.shape == "sphere") return MakeSphere(half.x(), kSegments);
  if (object.shape == "box") return MakeRoundedBox(object.size, 0.0);
  return MakeRevolution(
      {{0.0, -half.z()}, {half.x(), -half.z()}, {half.x(), half.z()}, {0.0, half.z()}}, kSegments);
}

/** A median under a name, or why there is none. */
StudyGrasp MakeMedian(const std::string& id, const std::vector<StudyGrasp>& trials) {
  StudyGrasp median = {id, trials.front().participant, trials.front().object, {}};
  std::vector<HandPlaces> places;
  for (const StudyGrasp& trial : trials) {
    if (trial.places) places.push_back(*trial.places);
  }
  median.places = places.empty() ? Answer<HandPlaces>(trials.front().places.none())
                                 : Answer<HandPlaces>(CalcMedianPlaces(places));
  return median;
}

/** "left", "R" of the row of trials.csv; empty: none is stated. */
std::string FindStatedHand(const Study& study, const StudyTrial& trial) {
  for (const PlannedReach& row : study.trials) {
    const bool is_part = trial.trial.rfind(row.trial + ".", 0) == 0;  // of a long recording
    if (row.participant == trial.participant && (row.trial == trial.trial || is_part)) {
      return row.hand;
    }
  }
  return "";
}

const char* NameOfSide(int side) { return side > 0 ? "left" : "right"; }

/** Places that are not those of the stated hand are none. */
Answer<HandPlaces> CheckSide(const Answer<HandPlaces>& places, const std::string& stated) {
  if (!places || stated.empty()) return places;
  const int first = std::tolower(static_cast<unsigned char>(stated.front()));
  const int side = first == 'l' ? 1 : first == 'r' ? -1 : 0;
  const int found = FindHandedness(MakePersonGrasp(*places));
  if (side * found >= 0) return places;
  return NoAnswer{std::string("trials.csv states the ") + NameOfSide(side) +
                  " hand; by thumb, fingers and palm it is a " + NameOfSide(found) +
                  " one: mirrored axes, exchanged markers, or the wrong hand"};
}

/** By person and object, how far the digits' markers are from the surface at contact [m]. */
using Heights = std::map<std::string, std::map<std::string, std::vector<double>>>;

Heights ListHeights(const StudyGrasps& grasps) {
  Heights heights;
  for (const StudyGrasp& trial : grasps.trials) {
    const StudyObject* object = grasps.study.FindObject(trial.object);
    if (!trial.places || !object || !object->distance) continue;
    for (const DigitPlaces& digit : trial.places->digits) {
      heights[trial.participant][trial.object].push_back(object->distance(digit.p_OContact));
    }
  }
  return heights;
}

/** A person's markers are as far from the skin on every object: where they are not, the size or
the place of an object is wrong. */
std::vector<StudyDoubt> FindObjectDoubts(const Heights& heights) {
  std::map<std::string, std::vector<double>> differences;  // of each object, by person
  for (const auto& [person, of_objects] : heights) {
    for (const auto& [object, own] : of_objects) {
      std::vector<double> others;
      for (const auto& [other, values] : of_objects) {
        if (other != object) others.push_back(CalcMedian(values));
      }
      if (!others.empty()) differences[object].push_back(CalcMedian(own) - CalcMedian(others));
    }
  }
  std::vector<StudyDoubt> doubts;
  for (const auto& [object, values] : differences) {
    const double difference = CalcMedian(values);
    if (std::abs(difference) <= kHeightDoubt) continue;
    const bool is_small = difference > 0.0;
    doubts.push_back(
        {object, object + ": people's markers are " +
                     FormatFixed(MmFromM(std::abs(difference)), 1) + " mm " +
                     (is_small ? "farther from" : "nearer to") +
                     " its surface than to the study's other objects, at most 5 mm is expected; "
                     "check its size in objects.csv (perhaps " +
                     FormatFixed(2.0 * MmFromM(std::abs(difference)), 0) + " mm too " +
                     (is_small ? "small" : "large") + ") and its centre"});
  }
  return doubts;
}

/** ": the first, 01-1, is removed: ..". @param object  empty: of any. */
std::string NameFirstRemoved(const StudyGrasps& grasps, const std::string& object) {
  for (const StudyGrasp& trial : grasps.removed) {
    if (!object.empty() && trial.object != object) continue;
    return ": the first, " + trial.id + ", is removed: " + trial.places.reason();
  }
  return "";
}

StudyGrasp ChooseGrasp(const StudyGrasps& grasps, const NewTransferOptions& options) {
  std::vector<std::string> known;
  for (const StudyGrasp& trial : grasps.trials) {
    known.push_back(trial.id);
    if (trial.id == options.trial) return trial;
  }
  if (!options.trial.empty()) {
    throw Error(ErrorKind::kNotFound, "the study keeps no trial \"" + options.trial + "\"" +
                                          SuggestNames(options.trial, known) +
                                          "; trials.csv of graspbench study run lists them");
  }
  known.clear();
  for (const StudyGrasp& trial : grasps.trials) {
    if (!std::count(known.begin(), known.end(), trial.object)) known.push_back(trial.object);
  }
  const std::string object =
      options.object.empty() && known.size() == 1 ? known.front() : options.object;
  std::vector<StudyGrasp> chosen;
  for (const StudyGrasp& trial : grasps.trials) {
    if (trial.object == object) chosen.push_back(trial);
  }
  if (chosen.empty()) {
    throw Error(ErrorKind::kNotFound,
                object.empty()
                    ? "the study has several objects: name one of them with --object, or a trial "
                      "with --trial" +
                          SuggestNames("", known)
                    : "no kept trial of the study is on \"" + object + "\"" +
                          NameFirstRemoved(grasps, object) + SuggestNames(object, known));
  }
  return MakeMedian(object, chosen);
}

std::string DescribePads(const TransferredGrasp& found) {
  TextTable table({"digit", "stands for", "distance [mm]", "angle [deg]", ""});
  for (const PadMiss& pad : found.pads) {
    table.AddRow({pad.digit, pad.person, FormatFixed(MmFromM(pad.distance), 1),
                  FormatFixed(DegFromRad(pad.angle), 0), pad.is_reached() ? "" : "unreachable"});
  }
  std::string text = found.pads.empty() ? "" : table.Format();
  if (!found.undetermined.empty()) {
    text += "not determined by the pads, so near " + found.standard + ":";
    for (const std::string& joint : found.undetermined) text += " " + joint;
    text += "\n";
  }
  return text;
}

}  // namespace

StudyGrasps LoadStudyGrasps(const std::string& study_file, const std::string& data) {
  StudyGrasps grasps;
  const std::filesystem::path of_results = std::filesystem::path(study_file) / "input/study.yaml";
  grasps.study = LeaveOutReport(
      LoadStudy(std::filesystem::exists(of_results) ? of_results.string() : study_file, data));
  StudyWatch watch;
  std::map<std::string, Answer<HandPlaces>> places;
  watch.on_trial = [&](const StudyTrial& trial, const ReachTrial& reach) {
    places[trial.id] = FindHandPlaces(*trial.analysis, reach, grasps.study.config.analysis);
  };
  const StudyResult result = RunTrials(grasps.study, watch);
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) {
      grasps.removed.push_back(
          {trial.id, trial.participant, trial.object, NoAnswer{trial.removed}});
      continue;
    }
    grasps.trials.push_back({trial.id, trial.participant, trial.object,
                             CheckSide(places[trial.id], FindStatedHand(grasps.study, trial))});
  }
  if (grasps.trials.empty()) {
    throw Error(ErrorKind::kUsage,
                "\"" + study_file + "\" keeps no trial" + NameFirstRemoved(grasps, ""));
  }
  grasps.doubts = FindObjectDoubts(ListHeights(grasps));
  const auto num_left =
      std::count_if(grasps.trials.begin(), grasps.trials.end(), [&](const StudyGrasp& trial) {
        return trial.places && FindHandedness(MakePersonGrasp(*trial.places)) > 0;
      });
  const bool is_stated = std::all_of(grasps.study.trials.begin(), grasps.study.trials.end(),
                                     [](const PlannedReach& row) { return !row.hand.empty(); });
  if (num_left > 0 && !is_stated) {
    grasps.doubts.push_back(
        {"", "by thumb, fingers and palm " + FormatCount(static_cast<int>(num_left), "trial") +
                 " of " + std::to_string(grasps.trials.size()) +
                 " show a left hand, and trials.csv states none (hand): if people used the right "
                 "one, the recording is mirrored"});
  }
  return grasps;
}

std::vector<StudyGrasp> CalcMediansByPerson(const std::vector<StudyGrasp>& trials) {
  std::vector<std::vector<StudyGrasp>> groups;
  for (const StudyGrasp& trial : trials) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& one) {
      return one.front().participant == trial.participant && one.front().object == trial.object;
    });
    if (group == groups.end()) {
      groups.push_back({trial});
    } else {
      group->push_back(trial);
    }
  }
  std::vector<StudyGrasp> medians;
  for (const auto& group : groups) medians.push_back(MakeMedian(group.front().participant, group));
  return medians;
}

namespace {

/** The mean of wrist and knuckles, the fingers' first joints; the wrist where there are none. */
std::optional<Eigen::Vector3d> FindPalm(const HandPlaces& places) {
  if (!places.p_OWrist) return std::nullopt;
  Eigen::Vector3d knuckles = Eigen::Vector3d::Zero();
  int count = 0;
  for (const DigitPlaces& digit : places.digits) {
    if (digit.digit == "TH" || digit.p_OJoints.empty()) continue;
    knuckles += digit.p_OJoints.front();
    ++count;
  }
  if (count == 0) return places.p_OWrist;
  return Eigen::Vector3d(0.5 * (*places.p_OWrist + knuckles / count));
}

/** Of digits that were followed unequally far, as far as all were. */
PersonReach MakeReach(const HandPlaces& places) {
  PersonReach reach;
  reach.period = kCoursePeriod;
  reach.from_widest = places.from_widest;
  for (size_t k = 0;; ++k) {
    std::vector<Eigen::Vector3d> tips;
    for (const DigitPlaces& digit : places.digits) {
      if (k < digit.p_OCourse.size()) tips.push_back(digit.p_OCourse[k]);
    }
    if (tips.empty() || tips.size() < places.digits.size()) return reach;
    reach.p_OTips.push_back(tips);
  }
}

}  // namespace

PersonGrasp MakePersonGrasp(const HandPlaces& places) {
  PersonGrasp person;
  std::vector<Eigen::Vector3d> open;
  for (const DigitPlaces& digit : places.digits) {
    PersonDigit one;
    one.digit = digit.digit;
    one.p_O = digit.p_OContact;
    one.p_OJoints = digit.p_OJoints;
    person.digits.push_back(one);
    open.push_back(digit.p_OOpen);
  }
  if (open.size() >= 2) SetOpening(open, person);
  person.reach = MakeReach(places);
  person.p_OPalm = FindPalm(places);
  person.approach_O = places.approach_O;
  return person;
}

bool IsOfCatalogue(const Study& study, const std::string& id) {
  const StudyObject* object = study.FindObject(id);
  return object && object->shape == kCatalogueShape;
}

std::shared_ptr<const GraspObject> LoadStudyObject(const Study& study, const std::string& id,
                                                   const fs::path& folder) {
  const StudyObject* object = study.FindObject(id);
  if (!object || object->shape.empty()) {
    throw Error(ErrorKind::kUsage,
                "the study says no shape of the object \"" + id +
                    "\", so nobody knows where its surface is; add its row with a shape to "
                    "objects.csv and name the table in study.yaml (objects)");
  }
  if (object->shape == kCatalogueShape) return LoadObject(id);
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (!std::all_of(id.begin(), id.end(), is_plain)) {
    throw Error(ErrorKind::kUsage, "the object \"" + id +
                                       "\" becomes a folder; name it in objects.csv and trials.csv "
                                       "by letters, digits, - and _ alone");
  }
  const fs::path own = folder / id;
  MakeFolder(own);
  WriteFile(own / "mesh.obj", FormatObj(MakeStudyMesh(*object)));
  WriteFile(own / "object.yaml", "name: " + object->shape +
                                     " of a study\nmesh: mesh.obj\nmesh_unit: m\n" +
                                     "density_kg_per_m3: " + FormatFixed(kAssumedDensity, 0) +
                                     "   # assumed: the study says no mass\n" +
                                     "friction_static: " + FormatFixed(kAssumedFriction, 2) +
                                     "    # assumed, as the next\nfriction_dynamic: 0.35\n");
  return LoadObject(own.string());
}

std::vector<Grasp> FindStandardGrasps(const Hand& hand) {
  constexpr int kNumProposed = 400;
  std::vector<Grasp> grasps = LoadStandardGrasps(hand);
  if (!grasps.empty()) return grasps;
  for (const char* id : {"g1", "g2"}) {
    const GraspTaxon& taxon = FindGraspTaxon(id);
    if (!CanDevelop(hand, taxon)) continue;
    for (const ProposedGrasp& proposed :
         ProposeGrasps(hand, taxon, kNumProposed, 1, false, RandomStream("transfer", taxon.id))) {
      grasps.push_back(proposed.grasp);
    }
  }
  return grasps;
}

std::filesystem::path CopyWithGrasps(const Hand& hand, const std::filesystem::path& folder) {
  std::filesystem::path own = folder / hand.id;
  GatherHand(hand.folder, own);
  std::string section = "# By geometry alone, never tried.\ngrasps:\n";
  for (const Grasp& grasp : FindStandardGrasps(hand)) {
    std::string digits;
    for (const std::string& id : grasp.digits) digits += (digits.empty() ? "" : ", ") + id;
    section += "  " + grasp.id + ":\n    digits: [" + digits +
               "]\n    tilt_deg: " + FormatFixed(DegFromRad(grasp.tilt), kGraspDecimals) +
               "\n    pre_deg: " + FormatPosture(hand, grasp.q_pre, kGraspDecimals) +
               "\n    target_deg: " + FormatPosture(hand, grasp.q_target, kGraspDecimals) + "\n";
  }
  const std::filesystem::path yaml = own / "hand.yaml";
  WriteFileAtomically(yaml, ReplaceGrasps(ReadFile(yaml), section));
  return own;
}

NewTransfer MakeNewTransfer(const NewTransferOptions& options, const fs::path& folder) {
  const Hand hand = LoadHand(options.hand);
  const StudyGrasps grasps = LoadStudyGrasps(options.study, options.data);
  const StudyGrasp chosen = ChooseGrasp(grasps, options);
  const auto object = LoadStudyObject(grasps.study, chosen.object, folder);
  TransferredGrasp found;
  if (chosen.places) {
    found = TransferGrasp(hand, FindStandardGrasps(hand), MakePersonGrasp(*chosen.places), *object);
  } else {
    found.not_transferable = chosen.places.reason();
  }
  NewTransfer made;
  made.object = chosen.object;
  made.summary = DescribePads(found);
  for (const StudyDoubt& doubt : grasps.doubts) {
    if (doubt.object.empty() || doubt.object == chosen.object)
      made.summary += "doubt    " + doubt.text + "\n";
  }
  if (!found.not_transferable.empty()) {
    made.summary += "not transferable to " + hand.id + ": " + found.not_transferable + "\n";
    return made;
  }
  found.grasp.id = "person";
  made.file = FormatGraspFile(hand, found.grasp, found.standard);
  if (!IsOfCatalogue(grasps.study, chosen.object)) {
    made.summary += "assumed of " + chosen.object + ": " +
                    FormatFixed(1e3 * object->mass_properties.mass, 0) + " g, friction " +
                    FormatFixed(kAssumedFriction, 2) + "\n";
  }
  return made;
}

}  // namespace graspbench
