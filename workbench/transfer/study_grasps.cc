#include "workbench/transfer/study_grasps.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
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
    throw Error(
        ErrorKind::kNotFound,
        object.empty()
            ? "the study has several objects: name one of them with --object, or a trial "
              "with --trial" +
                  SuggestNames("", known)
            : "no kept trial of the study is on \"" + object + "\"" + SuggestNames(object, known));
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
      ++grasps.num_removed;
      continue;
    }
    grasps.trials.push_back({trial.id, trial.participant, trial.object, places[trial.id]});
  }
  if (grasps.trials.empty()) {
    throw Error(ErrorKind::kUsage,
                "\"" + study_file + "\" keeps no trial; graspbench study run says why of each");
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

PersonGrasp MakePersonGrasp(const HandPlaces& places) {
  PersonGrasp person;
  std::vector<Eigen::Vector3d> open;
  for (const DigitPlaces& digit : places.digits) {
    PersonDigit one;
    one.digit = digit.digit;
    one.p_O = digit.p_OContact;
    person.digits.push_back(one);
    open.push_back(digit.p_OOpen);
  }
  if (open.size() >= 2) SetOpening(open, person);
  person.p_OWrist = places.p_OWrist;
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

NewTransfer MakeNewTransfer(const NewTransferOptions& options, const fs::path& folder) {
  const Hand hand = LoadHand(options.hand);
  const StudyGrasps grasps = LoadStudyGrasps(options.study, options.data);
  const StudyGrasp chosen = ChooseGrasp(grasps, options);
  const auto object = LoadStudyObject(grasps.study, chosen.object, folder);
  TransferredGrasp found;
  if (chosen.places) {
    found = TransferGrasp(hand, LoadStandardGrasps(hand), MakePersonGrasp(*chosen.places), *object);
  } else {
    found.not_transferable = chosen.places.reason();
  }
  NewTransfer made;
  made.object = chosen.object;
  made.summary = DescribePads(found);
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
