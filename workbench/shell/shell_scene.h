#pragma once
/** @file
The scene under a person's hand: one trial of one hand, object and grasp, moved step by step, back
and forth.

What decides it is plain data (SceneChoice): equal choices give the bytes of the same trial of a
session. Going back restores the nearest saved instant and simulates on from there. */

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

/** A joint of the grasp's pre-grasp or target posture, set by hand. */
struct JointEdit {
  bool is_target = true;
  std::string joint;
  double position = 0.0;  ///< [rad], of a prismatic joint [m]
};

/** Where the object stands instead of where the draw puts it. */
struct ObjectPlace {
  double x = 0.0;  ///< from the nominal place [m]
  double y = 0.0;
  double yaw = 0.0;  ///< [rad]
};

/** Where the hand stands instead of where the grasp puts it, as it is approached and left too. */
struct HandPlace {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< in W [m]
  /** About the axes of W through the middle of the object at its nominal place, x first, z last
  [rad]. */
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
};

/** A drive that was given another command while the trial went on. */
struct DriveEdit {
  double time = 0.0;  ///< since the start [s]
  std::string joint;
  double position = 0.0;  ///< [rad], of a prismatic joint [m]
};

struct SceneChoice {
  SessionConfig config;     ///< with one hand, one object and one grasp
  std::string folder;       ///< of the session it was opened from; empty: of its own
  std::optional<int> draw;  ///< the session's number of the trial, from 0; unset: no variation
  std::optional<ObjectPlace> place;
  std::optional<Grasp> learned;  ///< instead of the grasp of the configuration
  std::optional<HandPlace> hand_place;
  std::vector<JointEdit> joints;
  std::map<std::string, ClosingSchedule> closing;  ///< of digits, instead of the grasp's
  std::vector<DriveEdit> drives;                   ///< by time

  /** TUM Hand, golf ball, its best grasp, no variation. */
  static SceneChoice MakeDefault();
};

/** Of the standard grasp that a grasp was made from: the one of its type, distance and alpha. */
std::string FindStandardId(const Grasp& grasp);

class ShellScene {
 public:
  /** Loads what is chosen, as far as it is not loaded, and stands at the start of its trial. What
  stands in files of the user is read again.
  @throws Error when that cannot be; the scene is then as it was. */
  void Choose(const SceneChoice& choice);
  const SceneChoice& choice() const { return choice_; }
  bool is_loaded() const { return course_ != nullptr; }
  /** @pre of all below: Choose was called. */
  const TrialSetup& setup() const { return *setup_; }
  /** The chosen grasp without the joints set by hand. */
  Grasp unedited_grasp() const;
  /** What another draw of the same choice would be. */
  TrialSetup MakeSetup(std::optional<int> draw) const;
  /** All that the hand can do. */
  const std::vector<Grasp>& grasps() const { return inputs_->hands.front().grasps; }
  TrialRunner& runner();

  TableLift& course() { return *course_; }
  const TrialNotes& notes() const { return course_->notes(); }
  double time() const { return course_->time(); }
  bool is_over() const { return notes().is_over; }

  /** One step of the physics; false when the trial is over. */
  bool Advance();
  /** To the first step at or behind `time` [s], or the trial's end, until `stops`; back too. */
  void GoTo(double time, const std::function<bool()>& stops);
  void Reset();

 private:
  void KeepInstant();

  SceneChoice choice_ = SceneChoice::MakeDefault();
  std::shared_ptr<const SessionInputs> inputs_;
  std::unique_ptr<TrialSetup> setup_;    // the course refers to it
  std::unique_ptr<TrialRunner> runner_;  // null: made when it is needed
  std::unique_ptr<TableLift> course_;
  std::vector<TrialInstant> instants_;  // by time; the first is the start
  double spacing_ = 0.0;                // of the instants [s]
  double end_time_ = 0.0;               // of the trial [s]; infinite: not reached yet
};

}  // namespace graspbench
