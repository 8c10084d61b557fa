#include "datasets/grasps/write_grasps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include "core/base/error.h"
#include "core/base/text/json.h"
#include "core/base/text/yaml.h"
#include "datasets/grasps/map_to_hand.h"
#include "datasets/grasps/pose_numbers.h"

namespace graspbench {
namespace {

[[noreturn]] void FailUnsupported(const ForeignGrasp& grasp, const std::string& what) {
  throw Error(ErrorKind::kUnsupported,
              fmt::format("{}, grasp {}: {}", grasp.source, grasp.index, what));
}

void DemandOneScene(const std::vector<ForeignGrasp>& grasps) {
  const ForeignGrasp& first = grasps.front();
  for (const ForeignGrasp& grasp : grasps) {
    if (grasp.object != first.object || grasp.root_link != first.root_link ||
        grasp.joint_names != first.joint_names) {
      FailUnsupported(grasp,
                      "is of another object, root or joints than the first; a file holds "
                      "grasps of one hand on one object");
    }
  }
}

const GraspStage* FindStage(const ForeignGrasp& grasp, std::string_view name) {
  for (const GraspStage& stage : grasp.stages) {
    if (stage.name == name) return &stage;
  }
  return nullptr;
}

// --- DexGraspBench: operations of pickle's protocol 3 ---------------------------------------------

std::string LittleEndian(uint64_t value, size_t size) {
  std::string bytes;
  for (size_t i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 255));
  return bytes;
}

std::string PickleText(const std::string& text) {
  return "X" + LittleEndian(text.size(), 4) + text;
}
std::string PickleInteger(uint64_t value) { return "J" + LittleEndian(value, 4); }

/** A dtype by its code ("f8") and byte order. */
std::string PickleType(const std::string& code, const std::string& order, int flags) {
  const std::string none = PickleInteger(0xffffffffu);  // -1
  return "cnumpy\ndtype\n" + PickleText(code) + "\x89\x88\x87R(K\x03" + PickleText(order) + "NNN" +
         none + none + "K" + static_cast<char>(flags) + "tb";
}

/** @param content  operations that leave the array's bytes, or the list of its objects. */
std::string PickleArray(const std::vector<uint64_t>& shape, const std::string& type,
                        const std::string& content) {
  std::string sizes = "(";
  for (const uint64_t size : shape) sizes += PickleInteger(size);
  static constexpr char kStart[] =
      "cnumpy.core.multiarray\n_reconstruct\ncnumpy\nndarray\nK\0\x85"
      "C\x01"
      "b\x87R(K\x01";
  return std::string(kStart, sizeof kStart - 1) + sizes + "t" + type + "\x89" + content + "tb";
}

std::string PickleNumbers(const std::vector<uint64_t>& shape, const std::vector<double>& numbers) {
  std::string bytes;
  for (const double number : numbers) {
    uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    bytes += LittleEndian(bits, sizeof bits);
  }
  return PickleArray(shape, PickleType("f8", "<", 0), "B" + LittleEndian(bytes.size(), 4) + bytes);
}

/** A file as np.save writes it, of an object that these operations leave. */
std::string MakeNpy(const std::string& object) {
  constexpr size_t kAlignment = 64;
  std::string header = "{'descr': '|O', 'fortran_order': False, 'shape': (), }";
  const size_t start = 10;
  header.append(kAlignment - (start + header.size() + 1) % kAlignment, ' ');
  header.push_back('\n');
  const std::string array = PickleArray({}, PickleType("O8", "|", 63), "]" + object + "a");
  return std::string("\x93NUMPY\x01\0", 8) + LittleEndian(header.size(), 2) + header + "\x80\x03" +
         array + ".";
}

void AppendRow(const ForeignGrasp& grasp, const GraspStage& stage, std::vector<double>& row) {
  const std::array<double, 7> pose = NumbersFromPose(stage.X_OR);
  row.insert(row.end(), pose.begin(), pose.end());
  for (const std::string& name : ListDexgraspbenchJoints()) {
    const auto found = std::find(grasp.joint_names.begin(), grasp.joint_names.end(), name);
    if (found == grasp.joint_names.end()) {
      FailUnsupported(grasp, "has no joint " + name + "; DexGraspBench's hand is the Shadow Hand");
    }
    row.push_back(stage.joints[static_cast<size_t>(found - grasp.joint_names.begin())]);
  }
}

/** Names all that the format needs and the grasp lacks. */
void DemandDexgraspbenchGrasp(const ForeignGrasp& grasp) {
  const std::vector<std::string>& joints = ListDexgraspbenchJoints();
  std::vector<std::string> found;
  if (grasp.root_link != "wrist") found.push_back("the root \"" + grasp.root_link + "\"");
  if (grasp.joint_names.size() != joints.size()) {
    found.push_back(fmt::format("{} joints", grasp.joint_names.size()));
  }
  for (const char* stage : {"pregrasp", "grasp", "squeeze"}) {
    if (!FindStage(grasp, stage)) found.push_back(fmt::format("no stage {}", stage));
  }
  if (found.empty()) return;
  FailUnsupported(grasp, fmt::format("has {}; DexGraspBench needs the root \"wrist\" and the {} "
                                     "joints of the Shadow Hand, and the stages pregrasp, grasp "
                                     "and squeeze",
                                     fmt::join(found, ", "), joints.size()));
}

WrittenGrasps WriteDexgraspbench(const std::vector<ForeignGrasp>& grasps) {
  const ForeignGrasp& first = grasps.front();
  const size_t num_joints = ListDexgraspbenchJoints().size();
  DemandDexgraspbenchGrasp(first);
  const bool is_one = grasps.size() == 1;
  const uint64_t row_size = 7 + num_joints;
  std::string dict = "}(" + PickleText("obj_path") + PickleText(first.object) +
                     PickleText("obj_pose") + PickleNumbers({7}, {0, 0, 0, 1, 0, 0, 0});
  for (const char* name : {"pregrasp", "grasp", "squeeze"}) {
    std::vector<double> rows;
    for (const ForeignGrasp& grasp : grasps) {
      const GraspStage* stage = FindStage(grasp, name);
      if (!stage) FailUnsupported(grasp, fmt::format("has no stage {}", name));
      AppendRow(grasp, *stage, rows);
    }
    dict += PickleText(std::string(name) + "_qpos") +
            PickleNumbers(is_one ? std::vector<uint64_t>{row_size}
                                 : std::vector<uint64_t>{grasps.size(), row_size},
                          rows);
  }
  std::vector<double> scales, labels;
  WrittenGrasps written;
  bool has_ways = false, stands = false;
  for (const ForeignGrasp& grasp : grasps) {
    scales.push_back(grasp.scale);
    if (grasp.label) labels.push_back(*grasp.label ? 1.0 : 0.0);
    has_ways = has_ways || grasp.stages.size() > 3;
    stands = stands || grasp.X_WO.matrix() != Pose::Identity().matrix();
  }
  const std::vector<uint64_t> count =
      is_one ? std::vector<uint64_t>{} : std::vector<uint64_t>{grasps.size()};
  dict += PickleText("obj_scale") + PickleNumbers(count, scales);
  if (labels.size() == grasps.size()) {
    dict += PickleText("succ_flag") + PickleNumbers(count, labels);
  } else if (!labels.empty()) {
    written.losses.push_back("verdicts: some of the grasps have none");
  }
  if (stands) written.losses.push_back("the object's pose in the world: it is put at the origin");
  if (has_ways) written.losses.push_back("stages between pregrasp and grasp");
  written.bytes = MakeNpy(dict + "u");
  return written;
}

// --- isaac_grasp ----------------------------------------------------------------------------------

std::string FormatNumber(double value) { return FormatJson(Json(value)); }

std::string FormatPositions(const ForeignGrasp& grasp, const GraspStage& stage) {
  std::string text;
  for (size_t i = 0; i < stage.joints.size(); ++i) {
    text += "      " + FormatYamlWord(grasp.joint_names[i]) + ": " + FormatNumber(stage.joints[i]) +
            "\n";
  }
  return text;
}

WrittenGrasps WriteIsaac(const std::vector<ForeignGrasp>& grasps) {
  WrittenGrasps written;
  std::string& text = written.bytes;
  text = "format: isaac_grasp\nformat_version: 1.0\n\nobject_frame_link: " +
         QuoteYaml(grasps.front().object) +
         "\ngripper_frame_link: " + QuoteYaml(grasps.front().root_link) + "\n\ngrasps:\n";
  std::set<std::string> losses;
  for (size_t i = 0; i < grasps.size(); ++i) {
    const ForeignGrasp& grasp = grasps[i];
    const GraspStage* stage = FindStage(grasp, "grasp");
    if (!stage || stage->joints.empty()) FailUnsupported(grasp, "has no stage grasp with joints");
    const std::array<double, 7> pose = NumbersFromPose(stage->X_OR);
    const bool is_failed = grasp.label && !*grasp.label;
    text += fmt::format("  grasp_{}:\n    confidence: {}\n", i, is_failed ? "0.0" : "1.0");
    text += "    position: [" + FormatNumber(pose[0]) + ", " + FormatNumber(pose[1]) + ", " +
            FormatNumber(pose[2]) + "]\n    orientation: {w: " + FormatNumber(pose[3]) +
            ", xyz: [" + FormatNumber(pose[4]) + ", " + FormatNumber(pose[5]) + ", " +
            FormatNumber(pose[6]) + "]}\n    cspace_position:\n" + FormatPositions(grasp, *stage);
    if (const GraspStage* pregrasp = FindStage(grasp, "pregrasp")) {
      text += "    pregrasp_cspace_position:\n" + FormatPositions(grasp, *pregrasp);
      if (pregrasp->X_OR.matrix() != stage->X_OR.matrix()) {
        losses.insert("the root's pose at pregrasp: a grasp has one pose");
      }
    }
    for (const GraspStage& other : grasp.stages) {
      if (other.name != "grasp" && other.name != "pregrasp") losses.insert("stage " + other.name);
    }
    if (grasp.X_WO.matrix() != Pose::Identity().matrix()) {
      losses.insert("the object's pose in the world");
    }
    if (grasp.scale != 1.0) {
      losses.insert("the mesh's scale " + FormatNumber(grasp.scale) + ": give it by --scale");
    }
    if (grasp.label) losses.insert("the verdict but as a confidence of 1 or 0");
  }
  written.losses.assign(losses.begin(), losses.end());
  return written;
}

}  // namespace

std::vector<std::string> ListWrittenFormats() { return {"dexgraspbench", "isaac"}; }

WrittenGrasps WriteGrasps(const std::vector<ForeignGrasp>& grasps, const std::string& format) {
  GRASPBENCH_DEMAND(!grasps.empty(), "no grasps to write");
  if (format != "dexgraspbench" && format != "isaac") {
    throw Error(ErrorKind::kUsage, "grasps cannot be written as \"" + format + "\"" +
                                       SuggestNames(format, ListWrittenFormats()));
  }
  DemandOneScene(grasps);
  return format == "isaac" ? WriteIsaac(grasps) : WriteDexgraspbench(grasps);
}

}  // namespace graspbench
