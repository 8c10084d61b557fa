#include "core/hand/hand_yaml.h"

namespace graspbench {

// One line per key.
const FileKeys& ListHandKeys() {
  static const FileKeys keys = [] {
    FileKeys rows = {
        {"name", kRequired, "what a person calls it"},
        {"palm", kRequired, "where the palm is"},
        {"palm.link", kRequired, "link of hand.urdf"},
        {"palm.centre_m", kRequired, "middle of the palm's surface, in the palm's frame", -1, 1},
        {"palm.normal", kRequired, "direction out of the palm, in the palm's frame"},
        {"joint_accuracy_deg", kRequired, "half-width of every drive's error, drawn for each trial",
         0, 45},
        {"slide_accuracy_mm", "0", "the same of drives of joints that slide", 0, 20},
        {"pad_torsion_radius_m", "0.004",
         "of the links that carry the pads: resists turning on the spot", 0},
        {"digits", kRequired, KeyType::kList, "list, in the order of the joints"},
        {"digits.id", kRequired, "short name: TH, FF, MF, RF, LF or another"},
        {"digits.name", kRequired, "what a person calls it"},
        {"digits.thumb", "false", KeyType::kBoolean, "true of one digit: it opposes the others"},
        {"digits.links", kRequired, "links of hand.urdf from base to tip; the last has the pad"},
        {"digits.tip_m", kRequired, "in the last link", -1, 1},
        {"digits.pad_m", kRequired, "middle of the pad's surface, in the last link", -1, 1},
        {"coupling", "", "joints that follow the one before them in their finger; else none"},
        {"coupling.rule", kRequired, "middle-first, even or fixed"},
        {"coupling.fixed_ratio", "0.8", "of rule fixed", kAboveZero, 1},
        {"coupling.joints", kRequired, "distal joint: the middle joint that it follows"},
        {"mimic", "", KeyType::kList, "list of joints that a linkage ties to any other; else none"},
        {"mimic.joint", kRequired, "the joint that follows"},
        {"mimic.follows", kRequired, "a joint with a drive"},
        {"mimic.ratio", kRequired, "of its angle or way to the other's; not 0", -100, 100},
        {"mimic.offset_deg", "0", KeyType::kNumber, "where the other joint is at 0"},
        {"mimic.offset_mm", "0", KeyType::kNumber, "the same of a joint that slides"},
        {"drives", kRequired, KeyType::kList,
         "list; every joint that follows no other stands in one entry"},
        {"drives.joints", kRequired, "joints of hand.urdf with such a drive"},
        {"drives.stiffness_nm_per_rad", kRequired, KeyType::kNumberOfSome, "of joints that turn",
         kAboveZero},
        {"drives.damping_nms_per_rad", kRequired, KeyType::kNumberOfSome, "of joints that turn", 0},
        {"drives.torque_limit_nm", kRequired, KeyType::kNumberOfSome, "of joints that turn",
         kAboveZero},
        {"drives.stiffness_n_per_m", kRequired, KeyType::kNumberOfSome, "of joints that slide",
         kAboveZero},
        {"drives.damping_ns_per_m", kRequired, KeyType::kNumberOfSome, "of joints that slide", 0},
        {"drives.force_limit_n", kRequired, KeyType::kNumberOfSome, "of joints that slide",
         kAboveZero},
        {"apart", "", KeyType::kList,
         "list of pairs of links that never touch each other; else none"},
        {"frames", "", KeyType::kList,
         "list of further frames of the description, for questions; else none"},
        {"frames.name", kRequired, "as the description has it"},
        {"frames.link", kRequired, "link of hand.urdf that carries it"},
        {"frames.position_m", kRequired, "in that link", -2, 2},
        {"frames.rpy_rad", "[0, 0, 0]", "its axes in that link, as in a URDF"},
        {"surfaces", "", KeyType::kList,
         "list of links whose surface is not as the session has it"},
        {"surfaces.links", kRequired, "links of hand.urdf"},
    };
    for (const FileKey& row : ListSurfaceKeys(Needed::kNo, "surfaces.")) rows.push_back(row);
    for (const FileKey& row : FileKeys{
             {"pads", "", KeyType::kList,
              "list of links with a soft layer; their patch of contact gives torsion"},
             {"pads.links", kRequired, "links of hand.urdf"},
             {"pads.youngs_modulus_pa", kRequired, "of the layer; soft rubbers have 2e5 to 4e6",
              1e4, 1e9},
             {"pads.depth_m", kRequired, "how far it can be compressed", 1e-4, 0.02},
             {"pads.source", kRequired, "where the numbers are from"},
             {"camera", "",
              "on the hand or the wrist, for positioning: camera; else none. The arm holds it "
              "above the place, looking straight down: its mount decides what of the hand it sees"},
             {"camera.link", kRequired, "link of hand.urdf that carries it"},
             {"camera.position_m", kRequired, "of its lens, in that link", -1, 1},
             {"camera.forward", kRequired, "direction in which it looks, in that link"},
             {"camera.right", kRequired, "direction to the right in its picture, in that link"},
             {"camera.width_px", "640", "of its picture", 16, 2048},
             {"camera.height_px", "480", "of its picture", 16, 2048},
             {"camera.focal_length_px", "580", "of its lens", 16, 20000},
             {"camera.radial_1", "0", "distortion that grows with the square of the slope", -1, 1},
             {"camera.radial_2", "0", "with the fourth power", -1, 1}}) {
      rows.push_back(row);
    }
    rows.push_back({"grasps", "", "the standard grasps, by g1 to g6"});
    return rows;
  }();
  return keys;
}

}  // namespace graspbench
