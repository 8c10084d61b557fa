#include "core/grasp/grasp_keys.h"

namespace graspbench {

const FileKeys& ListHandGraspKeys() {
  static const FileKeys keys = {
      {"grasps.ID.digits", kRequired, "ids of the digits that grasp; at least two"},
      {"grasps.ID.tilt_deg", kRequired, "turn of the hand towards its fingertips, from above"},
      {"grasps.ID.palm_may_touch", "false", KeyType::kBoolean, "true of power grasps"},
      {"grasps.ID.palm_gap_m", "0.003",
       "of a power grasp: how far the palm stops before the object; it may draw it in", 0, 0.05},
      {"grasps.ID.held_share", "",
       "of shapes not met in development, how many it held; of grasps that can take an object, "
       "those that held half are preferred",
       0, 1},
      {"grasps.ID.approach", "automatic", "from where the hand comes: automatic, above or side"},
      {"grasps.ID.changed", "", "where the postures come from, for people"},
      {"grasps.ID.closing", "",
       "when and how fast digits close, by digit; those left out as all do"},
      {"grasps.ID.closing.DIGIT.delay_s", "0", "after the start of closure", 0, 10},
      {"grasps.ID.closing.DIGIT.speed", "1", "share of the speed of all", 0.05, 10},
      {"grasps.ID.pre_deg", kRequired,
       "open posture: by digit, a value for each joint with a drive; of joints that slide in mm"},
      {"grasps.ID.target_deg", kRequired, "closed posture, with nothing between the fingers"},
  };
  return keys;
}

const FileKeys& ListGraspFileKeys() {
  static const FileKeys keys = [] {
    FileKeys rows = {
        {"format", kRequired, "graspbench grasp"},
        {"format_version", kRequired, "1"},
        {"made_from", kRequired, "the standard grasp whose type and approach it has: g1 to g5"},
        {"id", kRequired, "its name; not that of a standard grasp"},
        {"object", "", "the one object it is for; else any"},
    };
    for (FileKey row : ListHandGraspKeys()) {
      row.key.erase(0, std::string("grasps.ID.").size());
      if (row.key != "held_share" && row.key != "changed") rows.push_back(row);
    }
    const FileKeys rest = {
        {"hand", kRequired, "id of the hand it is for"},
        {"placement", "", "where the hand stands; else computed from the object's size"},
        {"placement.position_m", kRequired,
         "of the hand's base, the object at rest above the origin"},
        {"placement.orientation_wxyz", kRequired, "of the hand's base, a unit quaternion"},
        {"placement.approach", kRequired, "the way to the object, a unit vector"},
        {"placement.closing_at_contact", kRequired, "share of the closure at the first contact", 0,
         1},
    };
    rows.insert(rows.end(), rest.begin(), rest.end());
    return rows;
  }();
  return keys;
}

}  // namespace graspbench
