#pragma once
/** @file
The forms in which trajectories are written: one file `<name>_trajectory.cc` and one line of
trajectory_form_list.inc each. Equal trajectories give equal bytes. */

#include <memory>
#include <string>
#include <vector>

#include "datasets/trajectory/trajectory.h"

namespace graspbench {

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

#define GRASPBENCH_TRAJECTORY_FORM(Name) TrajectoryForm Make##Name##TrajectoryForm();
#include "datasets/trajectory/trajectory_form_list.inc"
#undef GRASPBENCH_TRAJECTORY_FORM

}  // namespace graspbench
