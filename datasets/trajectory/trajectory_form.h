#pragma once
/** @file
The forms in which trajectories are written: one file `<name>_trajectory.cc` and one line of
trajectory_form_list.inc each. Equal trajectories give equal bytes. */

#include <memory>
#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/hand/hand.h"
#include "core/hand/tactile.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_trace.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {

/** A trial as it went, thinned to a rate: what the files of trajectories hold. */
inline constexpr double kTrajectoryRate = 60.0;  ///< samples per second by default

struct TrialTrajectory {
  PlannedTrial planned;
  std::string record_sha256;  ///< see CalcRecordSha256
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  double rate = kTrajectoryRate;  ///< [1/s]
  TracedTrial traced;             ///< its trace: the instants that are kept
  SensorConfig sensors = {};      ///< of the trial
};

/** SHA-256 of a trial's record: its journal line without the checksum, which is its line of
export/records.jsonl as long as it is not judged. */
std::string CalcRecordSha256(const PlannedTrial& planned, const TrialResult& result);

/** Keeps the first instant at or after each 1/rate since the start, the end of each phase and the
end of the trial: times are those of the physics, nothing is interpolated.
@param traced  with an instant a step.
@throws Error(kUnsupported) for a trial that could not begin. */
TrialTrajectory MakeTrajectory(const PlannedTrial& planned, const TrialSetup& setup,
                               const TracedTrial& traced, double rate);

/** What happened at a time: a phase that begins, or a contact event of the record. */
struct TrajectoryEvent {
  double time = 0.0;        ///< since the start of placing [s]
  std::string kind;         ///< "phase", "touch", "lost", "regained", "slip"
  std::string phase;        ///< of kind "phase"
  std::string digit;        ///< of a contact event; "palm" for links of none
  std::string link;         ///< of a contact event
  double impulse = kUnset;  ///< of "lost" [N s]
};
/** In the order of their times. */
std::vector<TrajectoryEvent> ListTrajectoryEvents(const TrialTrajectory& trajectory);

/** A contact at an instant, and the numbers that tables have of it. */
struct TrajectoryContact {
  const TraceInstant* instant;
  const HandContact* contact;
};
std::vector<CsvColumn<TrajectoryContact>> ListContactNumbers();

/** A tactile element of a hand, as tables have it. */
struct TrajectoryTaxel {
  const Hand* hand;
  size_t index;  ///< into the elements of its skin

  const TactileElement& element() const { return hand->skin->elements[index]; }
};
/** Its number, link, digit, place, normal and area. */
std::vector<CsvColumn<TrajectoryTaxel>> ListTaxelColumns();
/** Empty for a hand without. */
std::vector<TrajectoryTaxel> ListTaxels(const Hand& hand);
/** On the cell of each at an instant (core/trial/taxel_forces.h) [N]. */
std::vector<double> CalcTaxelForces(const TrialTrajectory& trajectory, const TraceInstant& instant);

struct TrajectoryFile {
  std::string ending;  ///< behind the trial's or the person's name: ".csv", ".contacts.csv"
  std::string bytes;
};

/** Many trials in one file. */
class TrajectoryCollection {
 public:
  virtual ~TrajectoryCollection() = default;
  /** In the order of the plan. Not for several threads at a time. */
  virtual void Add(const TrialTrajectory& trajectory) = 0;
  /** The file's bytes; to be called once. */
  virtual std::string Finish() = 0;
};

struct TrajectoryForm {
  const char* name;  ///< "mcap": its file's ending without the point
  const char* text;  ///< what it is and what reads it, for the help
  /** The files of one trial, the first of them named as asked for; several threads may call it.
  Null: a form of many trials. */
  std::vector<TrajectoryFile> (*make)(const TrialTrajectory& trajectory);
  std::unique_ptr<TrajectoryCollection> (*collect)();  ///< null: a form of one trial
};

/** All of them, by the list. */
const std::vector<TrajectoryForm>& ListTrajectoryForms();
/** The form of a file's ending or of a name: "trial.mcap", "mcap".
@throws Error(kUsage) naming the forms there are. */
const TrajectoryForm& FindTrajectoryForm(const std::string& name);

/** The files of one trial in any form. */
std::vector<TrajectoryFile> MakeTrajectoryFiles(const TrajectoryForm& form,
                                                const TrialTrajectory& trajectory);

/** The data dictionaries of the form csv: contacts, events, tactile elements; instants are of
ListTraceColumns(). */
///@{
Json MakeTrajectoryContactSchema(const Hand& hand);
Json MakeTrajectoryEventSchema();
Json MakeTrajectoryTaxelSchema();
///@}

#define GRASPBENCH_TRAJECTORY_FORM(Name) TrajectoryForm Make##Name##TrajectoryForm();
#include "datasets/trajectory/trajectory_form_list.inc"
#undef GRASPBENCH_TRAJECTORY_FORM

}  // namespace graspbench
