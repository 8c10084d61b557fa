#pragma once
/** @file
File forms of trajectories. Each has one file `<name>_trajectory.cc` and one line in
trajectory_form_list.inc. Equal trajectories give equal bytes. */

#include <memory>
#include <string>
#include <vector>

#include "core/arm/mounted_arm.h"
#include "core/base/text/csv.h"
#include "core/hand/hand.h"
#include "core/hand/tactile.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_trace.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {

/** Default sample rate of trajectories. */
inline constexpr double kTrajectoryRate = 60.0;  ///< [1/s]

struct TrialTrajectory {
  PlannedTrial planned;
  std::string record_sha256;  ///< see CalcRecordSha256
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  double rate = kTrajectoryRate;  ///< [1/s]
  TracedTrial traced;             ///< with only the kept instants in its trace
  SensorConfig sensors = {};      ///< of the trial
};

/** SHA-256 of a trial's record: its journal line without the checksum, which equals its line in
export/records.jsonl unless it is judged. */
std::string CalcRecordSha256(const PlannedTrial& planned, const TrialResult& result);

/** Makes a trajectory sampled at `rate`. Keeps the first instant at or after each multiple of
1/rate since the start, the end of each phase and the end of the trial. Times are those of the
simulation; nothing is interpolated.
@param traced  with one instant per step.
@throws Error(kUnsupported) for a trial that could not begin. */
TrialTrajectory MakeTrajectory(const PlannedTrial& planned, const TrialSetup& setup,
                               const TracedTrial& traced, double rate);

/** The arm whose joints the trace holds; null: none. */
const Arm* FindTracedArm(const TracedTrial& traced);
/** Columns of an instant: ListTraceColumns(), and the joints of the arm ("arm/elbow_rad"). */
std::vector<CsvColumn<TraceInstant>> ListInstantColumns(const Hand& hand,
                                                        const TracedTrial& traced);

/** An event: the start of a phase, or a contact event of the record. */
struct TrajectoryEvent {
  double time = 0.0;        ///< since the start of placing [s]
  std::string kind;         ///< "phase", "touch", "lost", "regained", "slip"
  std::string phase;        ///< for kind "phase"
  std::string digit;        ///< for contact events; "palm" for links of no digit
  std::string link;         ///< for contact events
  double impulse = kUnset;  ///< for "lost" [N s]
};
/** Lists the events in the order of time. */
std::vector<TrajectoryEvent> ListTrajectoryEvents(const TrialTrajectory& trajectory);

/** A contact at an instant, for tables. */
struct TrajectoryContact {
  const TraceInstant* instant;
  const HandContact* contact;
};
std::vector<CsvColumn<TrajectoryContact>> ListContactNumbers();

/** A tactile element of a hand, for tables. */
struct TrajectoryTaxel {
  const Hand* hand;
  size_t index;  ///< in the elements of its skin

  const TactileElement& element() const { return hand->skin->elements[index]; }
};
/** Columns of an element: number, link, digit, position, normal and area. */
std::vector<CsvColumn<TrajectoryTaxel>> ListTaxelColumns();
/** Lists the hand's tactile elements, if any. */
std::vector<TrajectoryTaxel> ListTaxels(const Hand& hand);
/** Force on the cell of each tactile element at an instant (core/trial/taxel_forces.h) [N]. */
std::vector<double> CalcTaxelForces(const TrialTrajectory& trajectory, const TraceInstant& instant);

struct TrajectoryFile {
  std::string ending;  ///< of the file name: ".csv", ".contacts.csv"
  std::string bytes;
};

/** Writes many trials to one file. */
class TrajectoryCollection {
 public:
  virtual ~TrajectoryCollection() = default;
  /** Adds a trial, in the order of the plan. Not thread-safe. */
  virtual void Add(const TrialTrajectory& trajectory) = 0;
  /** Returns the file's bytes; call once. */
  virtual std::string Finish() = 0;
};

struct TrajectoryForm {
  const char* name;  ///< "mcap": the file extension without the dot
  const char* text;  ///< description for the help: what it is and what reads it
  /** Makes the files of one trial, the first with the requested name; thread-safe. Null for a form
  of many trials. */
  std::vector<TrajectoryFile> (*make)(const TrialTrajectory& trajectory);
  std::unique_ptr<TrajectoryCollection> (*collect)();  ///< null for a form of one trial
};

/** Lists all forms, in the order of the list. */
const std::vector<TrajectoryForm>& ListTrajectoryForms();
/** Finds a form by a file name or by its name: "trial.mcap", "mcap".
@throws Error(kUsage) naming the known forms. */
const TrajectoryForm& FindTrajectoryForm(const std::string& name);

/** Makes the files of one trial in any form. */
std::vector<TrajectoryFile> MakeTrajectoryFiles(const TrajectoryForm& form,
                                                const TrialTrajectory& trajectory);

/** The data dictionaries of the form csv: contacts, events, tactile elements; those of instants
come from ListTraceColumns(). */
///@{
Json MakeTrajectoryContactSchema(const Hand& hand);
Json MakeTrajectoryEventSchema();
Json MakeTrajectoryTaxelSchema();
///@}

#define GRASPBENCH_TRAJECTORY_FORM(Name) TrajectoryForm Make##Name##TrajectoryForm();
#include "datasets/trajectory/trajectory_form_list.inc"
#undef GRASPBENCH_TRAJECTORY_FORM

}  // namespace graspbench
