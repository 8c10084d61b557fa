#include "workbench/experiments/schedule_session.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/grasp_file.h"
#include "core/trial/digit_delays.h"
#include "datasets/plan/grasp_choice.h"
#include "datasets/plan/session_inputs.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kFolder[] = "schedules";

/** A name in the configuration and the file that it stands for. */
struct NamedFile {
  std::string name, text;
};

struct MadeSchedules {
  PeopleFile people;
  std::vector<NamedFile> grasps;
};

/** The standard grasp whose type, distance and alpha the grasp has. */
std::string FindTaxonOf(const Grasp& grasp) {
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.type == grasp.type && taxon.approach_distance == grasp.approach_distance &&
        taxon.alpha == grasp.alpha) {
      return taxon.id;
    }
  }
  GRASPBENCH_DEMAND(false, grasp.id);
  return "";
}

using Lags = std::map<std::string, double>;  // by digit [s]

/** What people's shares ask of this hand. @param closing_time  of the natural grasp [s]. */
Answer<Lags> FindPeopleLags(const PeopleOnObject& cell, double closing_time) {
  if (!cell.people) return cell.people.none();
  double least = HUGE_VAL;
  for (const DigitShare& share : cell.people->shares) {
    if (std::isinf(share.median)) {
      return NoAnswer{"in at least half of the participants' trials " + share.digit +
                      " never touched"};
    }
    least = std::min(least, share.median);
  }
  Lags lags;
  for (const DigitShare& share : cell.people->shares) {
    lags[share.digit] = (share.median - least) * closing_time;
  }
  return lags;
}

/** The grasp's schedules on one object. */
class Scheduler {
 public:
  Scheduler(TrialRunner& runner, TrialSetup setup) : runner_(runner), setup_(std::move(setup)) {
    setup_.draw = {};
    setup_.draw.joint_error = Eigen::VectorXd::Zero(setup_.hand->num_joints());
    natural_ = runner_.Run(setup_);
  }

  void Make(PeopleOnObject& cell, std::vector<NamedFile>& files) {
    Add(kNatural, setup_.grasp.closing, files);
    Lags together;
    for (const std::string& digit : cell.digits) together[digit] = 0.0;
    Fit(kSimultaneous, together, cell, files);
    Fit(kPeopleLike, FindPeopleLags(cell, natural_.timing.gct), cell, files);
  }

 private:
  void Add(const std::string& schedule, const std::map<std::string, ClosingSchedule>& closing,
           std::vector<NamedFile>& files) {
    Grasp grasp = setup_.grasp;
    grasp.id += "-" + schedule;
    grasp.object = setup_.object->id;
    grasp.closing = closing;
    files.push_back({setup_.hand->id + "-" + grasp.object + "-" + grasp.id + ".yaml",
                     FormatGraspFile(*setup_.hand, grasp, FindTaxonOf(grasp))});
  }

  void Fit(const std::string& schedule, const Answer<Lags>& lags, PeopleOnObject& cell,
           std::vector<NamedFile>& files) {
    std::string& missing = cell.missing[schedule];
    missing = FindNoTiming();
    if (missing.empty() && !lags) missing = lags.reason();
    if (!missing.empty()) return;
    const LaggedClosing found = FitContactLags(runner_, setup_, *lags);
    const double error = found.largest_error;
    if (std::isnan(error)) {
      missing = "in a trial without variation " + (found.untouching.empty()
                                                       ? "the simulation fails"
                                                       : found.untouching + " does not touch");
    } else if (error > std::max(kMostLagError * natural_.timing.gct, setup_.sim.step)) {
      missing = "its lags deviate by " + FormatFixed(MsFromS(error), 1) +
                " ms in a trial without variation";
    }
    if (!missing.empty()) return;
    cell.missing.erase(schedule);
    Add(schedule, found.closing, files);
  }

  /** Why the trial without variation has no times to compare with; empty: it has. */
  std::string FindNoTiming() const {
    if (natural_.outcome == Outcome::kNumericalFailure) {
      return "in a trial without variation the simulation fails";
    }
    for (const DigitContact& contact : natural_.contacts) {
      if (std::isnan(contact.time)) {
        return "in a trial without variation " + contact.digit.str() + " does not touch";
      }
    }
    if (natural_.contacts.empty()) return "in a trial without variation no digit touches";
    return natural_.timing.contact_before_start
               ? "in a trial without variation a digit touches before closing starts"
               : "";
  }

  TrialRunner& runner_;
  TrialSetup setup_;
  TrialResult natural_;
};

MadeSchedules MakeSchedules(const Session& session, const SessionInputs& inputs,
                            const People& people) {
  MadeSchedules made;
  made.people.study = people.study;
  std::unique_ptr<TrialRunner> runner;
  TrialSetup before;
  for (const PlannedTrial& planned : session.plan) {
    if (planned.trial != 0 || planned.grasp == kBySight) continue;
    const TrialSetup setup = MakeTrialSetup(session.config, inputs, planned);
    if (!runner || setup.hand != before.hand || setup.object != before.object) {
      runner = std::make_unique<TrialRunner>(setup.hand, setup.object);
    }
    before = setup;
    PeopleOnObject cell = {planned.hand, planned.object, planned.grasp, setup.grasp.digits, {}, {}};
    cell.people = people.study.empty()
                      ? Answer<TouchLags>(NoAnswer{"no study of participants was named"})
                      : SummarisePeople(people.touches, planned.object, cell.digits);
    Scheduler(*runner, setup).Make(cell, made.grasps);
    made.people.cells.push_back(std::move(cell));
  }
  return made;
}

/** A comparison that has nothing to compare is refused before it costs time. */
void CheckHasSchedules(const Session& session, const People& people, const MadeSchedules& made) {
  const std::vector<PeopleOnObject>& cells = made.people.cells;
  const bool has_people = std::any_of(cells.begin(), cells.end(),
                                      [](const PeopleOnObject& cell) { return bool(cell.people); });
  if (!people.study.empty() && !has_people) {
    throw Error(ErrorKind::kUsage,
                "the people of \"" + people.study + "\" are not compared with \"" +
                    session.folder.string() + "\": " +
                    (cells.empty() ? "the camera chooses its grasps" : cells[0].people.reason()) +
                    "; expected a study of the session's objects, by their ids, and of the digits "
                    "of its grasps");
  }
  if (made.grasps.size() > cells.size()) return;
  throw Error(ErrorKind::kUsage,
              "no schedule of the grasps of \"" + session.folder.string() + "\" can be compared: " +
                  (cells.empty() ? "the camera chooses them" : cells[0].missing.at(kSimultaneous)) +
                  "; choose other objects or grasps");
}

void CheckIsNatural(const Session& session) {
  std::error_code status;
  if (session.config.conditions.empty() &&
      !fs::exists(session.folder / "inputs" / "grasps" / "people.json", status)) {
    return;
  }
  throw Error(ErrorKind::kUsage, "\"" + session.folder.string() +
                                     "\" has its own conditions or schedules; expected a session "
                                     "with the natural closing of its grasps (graspbench run)");
}

/** The folder's own copies, so that it needs nothing of the session's. */
void WriteInputs(const Session& session, const MadeSchedules& made, const fs::path& folder) {
  SessionConfig own = session.config;
  own.grasps.clear();
  for (std::string& name : own.hands) name = FindHandInput(name, session.folder);
  for (std::string& name : own.objects) name = FindObjectInput(name, session.folder);
  CopyInputs(own, folder);
  const fs::path grasps = folder / "inputs" / "grasps";
  MakeFolder(grasps);
  for (size_t i = 0; i < made.grasps.size(); ++i) {
    WriteFile(grasps / (std::to_string(i) + ".yaml"), made.grasps[i].text);
  }
  WriteFile(grasps / "people.json", ToJson(made.people).dump(1) + "\n");
}

}  // namespace

PreparedSession PrepareSchedules(const ExperimentRequest& request, const People& people) {
  const Session session = LoadSession(request.folder, request.on_damage, RecordParts::kBrief);
  CheckIsNatural(session);
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kNow, session.folder);
  CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  const MadeSchedules made = MakeSchedules(session, inputs, people);
  CheckHasSchedules(session, people, made);
  PreparedSession prepared;
  prepared.config = session.config;
  if (request.trials_per_cell > 0) {
    prepared.config.trials = std::min(prepared.config.trials, request.trials_per_cell);
  }
  prepared.config.grasps.clear();
  std::string content = FormatJson(ToJson(made.people));
  for (const NamedFile& grasp : made.grasps) {
    prepared.config.grasps.push_back(grasp.name);
    content += grasp.text;
  }
  for (const PlannedTrial& planned : session.plan) content += planned.id;
  content += std::to_string(prepared.config.trials);
  prepared.folder = session.folder / kFolder / CalcHashHex(content).substr(0, 8);
  if (!HasSession(prepared.folder)) {
    StagedFolder staged({prepared.folder, "", false, {}});
    WriteInputs(session, made, staged.path());
    const SessionInputs own = LoadSessionInputs(prepared.config, FieldUse::kLater, staged.path());
    CreateSession(staged.path(), prepared.config, MakePlan(prepared.config, own));
    staged.Commit();
  }
  prepared.inputs = LoadSessionInputs(prepared.config, FieldUse::kLater, prepared.folder);
  prepared.session = LoadSession(prepared.folder, request.on_damage, RecordParts::kBrief);
  CheckSameSession(prepared.session, prepared.config, MakePlan(prepared.config, prepared.inputs));
  return prepared;
}

}  // namespace graspbench
