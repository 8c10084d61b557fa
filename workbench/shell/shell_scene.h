#pragma once
/** @file
The scene of the interactive shell: one trial of one hand, object and grasp, stepped forwards and
backwards.

It is fully determined by plain data (SceneChoice): equal choices give the same bytes as the trial
of a session. Going back restores the nearest saved instant and simulates from there. */

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/trial/protocols/table_lift.h"
#include "core/trial/trial_runner.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** A joint of the pre-grasp or target posture, edited by the user. */
struct JointEdit {
  bool is_target = true;
  std::string joint;
  double position = 0.0;  ///< [rad], of a prismatic joint [m]
};

/** Pose of the object that replaces the sampled one. */
struct ObjectPlace {
  double x = 0.0;  ///< from the nominal position [m]
  double y = 0.0;
  double yaw = 0.0;  ///< [rad]
};

/** Change of the hand's pose relative to the grasp's placement; approach and retreat change with
it. */
struct HandPlace {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< in W [m]
  /** Rotations about the axes of W through the object's centre at its nominal position, x first, z
  last [rad]. */
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
};

/** A drive command that the user changed during the trial. */
struct DriveEdit {
  double time = 0.0;  ///< since the start [s]
  std::string joint;
  double position = 0.0;  ///< [rad], of a prismatic joint [m]
};

struct SceneChoice {
  SessionConfig config;     ///< with one hand, one object and one grasp
  std::string folder;       ///< session that the trial was opened from; empty: none
  std::optional<int> draw;  ///< index of the session's draw, from 0; unset: no variation
  std::optional<ObjectPlace> place;
  std::optional<Grasp> learned;  ///< replaces the grasp of the configuration
  std::optional<HandPlace> hand_place;
  std::vector<JointEdit> joints;
  std::map<std::string, ClosingSchedule> closing;  ///< by digit; replaces the grasp's schedule
  std::vector<DriveEdit> drives;                   ///< in order of time

  /** TUM Hand, golf ball, its best grasp, no variation. */
  static SceneChoice MakeDefault();
};

/** Id of the standard grasp that a grasp was made from: that with its type, distance and alpha. */
std::string FindStandardId(const Grasp& grasp);

class ShellScene {
 public:
  /** Loads the choice, as far as it is not loaded yet, and goes to the start of its trial. The
  user's own files are read again. @throws Error when that fails; the scene is then unchanged. */
  void Choose(const SceneChoice& choice);
  const SceneChoice& choice() const { return choice_; }
  bool is_loaded() const { return course_ != nullptr; }
  /** @pre Choose was called, here and for all functions below. */
  const TrialSetup& setup() const { return *setup_; }
  /** The chosen grasp without the user's edits. */
  Grasp unedited_grasp() const;
  /** Makes the setup of another draw of the same choice. */
  TrialSetup MakeSetup(std::optional<int> draw) const;
  /** All grasps of the hand. */
  const std::vector<Grasp>& grasps() const { return inputs_->hands.front().grasps; }
  TrialRunner& runner();

  TableLift& course() { return *course_; }
  const TrialNotes& notes() const { return course_->notes(); }
  double time() const { return course_->time(); }
  bool is_over() const { return notes().is_over; }

  /** Advances by one physics step; false when the trial is over. */
  bool Advance();
  /** Goes, forwards or backwards, to the first step at or after `time` [s], or to the trial's end;
  ends early once `stops()` is true. */
  void GoTo(double time, const std::function<bool()>& stops);
  void Reset();

 private:
  void KeepInstant();

  SceneChoice choice_ = SceneChoice::MakeDefault();
  std::shared_ptr<const SessionInputs> inputs_;
  std::unique_ptr<TrialSetup> setup_;    // the course refers to it
  std::unique_ptr<TrialRunner> runner_;  // null: made when it is needed
  std::unique_ptr<TableLift> course_;
  std::vector<TrialInstant> instants_;  // in order of time; the first is the start
  double spacing_ = 0.0;                // between instants [s]
  double end_time_ = 0.0;               // [s]; infinite: not reached yet
};

}  // namespace graspbench
