#include "workbench/transfer/transfer_session.h"

#include <algorithm>
#include <map>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"
#include "core/transfer/play_person.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/transfer/study_grasps.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kMadeObjects[] = "made";      // in the staged folder, until they are copied
constexpr char kMadeHands[] = "made_hands";  // the same

struct MadeTransfers {
  TransferFile file;
  std::vector<std::string> objects;  ///< ids, in the study's order
  /** Name in the configuration and content. */
  std::vector<std::pair<std::string, std::string>> grasps;
};

/** Joints and tip, one after the other. */
Eigen::VectorXd MakeChain(std::vector<Eigen::Vector3d> p_OJoints, const Eigen::Vector3d& p_OTip) {
  p_OJoints.push_back(p_OTip);
  Eigen::VectorXd chain(3 * p_OJoints.size());
  for (size_t k = 0; k < p_OJoints.size(); ++k) {
    chain.segment<3>(3 * static_cast<Eigen::Index>(k)) = p_OJoints[k];
  }
  return chain;
}

TransferRow DescribeTransfer(const Hand& hand, const StudyGrasp& grasp,
                             const TransferredGrasp& found) {
  TransferRow row;
  row.hand = hand.id;
  row.object = grasp.object;
  row.participant = grasp.participant;
  row.grasp = "person-" + grasp.id;
  row.not_transferable = found.not_transferable;
  for (const PadMiss& pad : found.pads) {
    row.pads.push_back({pad.digit, pad.person, pad.distance, pad.angle, pad.is_reached()});
  }
  row.undetermined = found.undetermined;
  if (found.not_transferable.empty()) row.type = NameOf(found.grasp.type);
  if (!grasp.places) return row;
  for (const DigitPlaces& digit : grasp.places->digits) {
    row.person.push_back({digit.digit, digit.lag, MakeChain(digit.p_OOpenJoints, digit.p_OOpen),
                          MakeChain(digit.p_OJoints, digit.p_OContact)});
  }
  return row;
}

/** @param folder  for the objects that are made. */
MadeTransfers MakeTransfers(const TransferRequest& request, const fs::path& folder) {
  const StudyGrasps study = LoadStudyGrasps(request.study, request.data);
  const std::vector<StudyGrasp> grasps =
      request.takes_every_trial ? study.trials : CalcMediansByPerson(study.trials);
  MadeTransfers made;
  made.file.study = study.study.config.name;
  for (const StudyDoubt& doubt : study.doubts) made.file.doubts.push_back(doubt.text);
  std::map<std::string, std::shared_ptr<const GraspObject>> objects;
  for (const StudyGrasp& grasp : grasps) {
    std::shared_ptr<const GraspObject>& object = objects[grasp.object];
    if (object) continue;
    object = LoadStudyObject(study.study, grasp.object, folder);
    made.objects.push_back(grasp.object);
  }
  for (const std::string& name : request.config.hands) {
    const Hand hand = LoadHand(name);
    const std::vector<Grasp> standard = FindStandardGrasps(hand);
    for (const StudyGrasp& grasp : grasps) {
      TransferredGrasp found;
      if (grasp.places) {
        found =
            TransferGrasp(hand, standard, MakePersonGrasp(*grasp.places), *objects[grasp.object]);
      } else {
        found.not_transferable = grasp.places.reason();
      }
      TransferRow row = DescribeTransfer(hand, grasp, found);
      const auto add = [&](const std::string& id) {
        found.grasp.id = id;
        made.grasps.emplace_back(hand.id + "-" + grasp.object + "-" + id + ".yaml",
                                 FormatGraspFile(hand, found.grasp, found.standard));
      };
      if (found.not_transferable.empty()) add(row.grasp);
      if (found.not_transferable.empty() && request.plays) {
        const PlayedReach played =
            PlayReach(hand, found, MakePersonGrasp(*grasp.places), *objects[grasp.object]);
        row.not_played = played.not_played;
        found.grasp.course = played.course;
        if (played.not_played.empty()) add(row.grasp + kPlayedSuffix);
      }
      made.file.rows.push_back(row);
    }
  }
  return made;
}

std::string FormatTransfers(const TransferFile& file) { return RecordToJson(file).dump(1) + "\n"; }

/** Everything that the session needs, in its folder. @returns its configuration. */
SessionConfig StageTransfers(const TransferRequest& request, const fs::path& folder) {
  const fs::path made_objects = folder / kMadeObjects;
  MakeFolder(made_objects);
  const MadeTransfers made = MakeTransfers(request, made_objects);
  SessionConfig config = request.config;
  config.objects = made.objects;
  config.grasps = {kBestGrasp, NameRehearsed({})};
  SessionConfig copied = config;  // with the objects where they lie now, without grasp files
  for (std::string& object : copied.objects) {
    if (fs::exists(made_objects / object)) object = (made_objects / object).string();
  }
  for (std::string& name : copied.hands) {
    const Hand hand = LoadHand(name);
    if (!LoadStandardGrasps(hand).empty()) continue;
    name = CopyWithGrasps(hand, folder / kMadeHands).string();
  }
  RehearseGrasps(copied, request.num_workers);
  CopyInputs(copied, folder);
  fs::remove_all(made_objects);
  fs::remove_all(folder / kMadeHands);
  const fs::path grasps = folder / "inputs" / "grasps";
  MakeFolder(grasps);
  for (const auto& [name, text] : made.grasps) {
    WriteFile(grasps / (std::to_string(config.grasps.size()) + ".yaml"), text);
    config.grasps.push_back(name);
  }
  WriteFile(folder / kTransferPath, FormatTransfers(made.file));
  const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater, folder);
  CopyRehearsed(inputs, folder);
  CreateSession(folder, config, MakePlan(config, inputs));
  return config;
}

}  // namespace

PreparedSession PrepareTransfers(const TransferRequest& request) {
  PreparedSession prepared;
  prepared.folder = request.out;
  if (HasSession(request.out)) {
    StagedFolder scratch({request.out.string() + ".again", "", false, {}});
    const MadeTransfers made = MakeTransfers(request, scratch.path());
    std::error_code status;
    const bool is_same = fs::exists(request.out / kTransferPath, status) &&
                         ReadFile(request.out / kTransferPath) == FormatTransfers(made.file);
    if (!is_same) {
      throw Error(ErrorKind::kUsage, "\"" + request.out.string() +
                                         "\" holds a session of other grasps; choose another "
                                         "folder with --out");
    }
  } else {
    StagedFolder staged({request.out, "", false, {request.study, request.data}});
    StageTransfers(request, staged.path());
    staged.Commit();
  }
  prepared.session = LoadSession(prepared.folder, OnDamage::kRefuse, RecordParts::kBrief);
  prepared.config = prepared.session.config;
  prepared.inputs = LoadSessionInputs(prepared.config, FieldUse::kLater, prepared.folder);
  CheckSameSession(prepared.session, prepared.config, MakePlan(prepared.config, prepared.inputs));
  return prepared;
}

}  // namespace graspbench
