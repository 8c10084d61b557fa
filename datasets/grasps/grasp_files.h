#pragma once
/** @file
Reads foreign grasps from a file or from all files of a folder. Each format has one file
`<id>_grasps.cc` and one line in grasp_format_list.inc.

A grasp is stored as its file states it; all readers return this form and all protocols accept it. R
is the frame of the root link of the file's hand, O the object's mesh frame (after scaling).
Conversion to a hand of graspbench is done by map_to_hand.h. */

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/pose.h"
#include "core/fence/serve_fence.h"

namespace graspbench {

/** Poses of root and joints at one stage of a grasp; stages are in the order of execution. */
struct GraspStage {
  std::string name;            ///< "pregrasp", "grasp", "squeeze"
  Pose X_OR;                   ///< [m]
  std::vector<double> joints;  ///< by ForeignGrasp::joint_names [rad]; prismatic joints [m]
};

struct ForeignGrasp {
  std::string source;                    ///< the file's name without its folder
  int index = 0;                         ///< of the grasp in its file, from 0
  std::string format;                    ///< id of the reader
  std::string hand;                      ///< name in the file; empty: none
  std::string root_link;                 ///< R; empty: not stated
  std::vector<std::string> joint_names;  ///< of the file's hand, in the file's order
  std::string object;                    ///< path or name of the mesh in the file
  double scale = 1.0;                    ///< factor on the mesh's coordinates
  Pose X_WO = Pose::Identity();          ///< in the file's world
  std::vector<GraspStage> stages;        ///< at least one
  std::optional<bool> label;             ///< the file's own verdict
  std::vector<std::string> assumptions;  ///< assumed values that the file does not state
};

/** Values that a file does not state, or that override it. */
struct GraspReadOptions {
  std::string hand_frame;                ///< link of the hand whose pose the file gives
  std::string object_frame;              ///< "mesh": frame of the poses; empty: not stated
  std::vector<std::string> joint_names;  ///< for files that list positions without names
  std::optional<double> scale;           ///< of the object's mesh
  /** Joint positions of the open hand, for files that state none [rad]; prismatic joints [m]. */
  std::vector<std::pair<std::string, double>> open_joints;
};

struct GraspFormat {
  const char* id;
  const char* title;
  /** Whether the whole file `bytes` looks like this format; parts that are not inspected may be
  damaged. */
  bool (*recognises)(std::string_view bytes);
  /** @param file  the file's name in messages and, without folder, in the records.
  @throws Error(kFormat, kRange, kUsage) with the location. */
  std::vector<ForeignGrasp> (*read)(std::string_view bytes, const std::string& file,
                                    const GraspReadOptions& options);
};

/** Lists the formats in the order in which files are tested. */
const std::vector<GraspFormat>& ListGraspFormats();

#define GRASPBENCH_GRASP_FORMAT(Name) GraspFormat Make##Name##GraspFormat();
#include "datasets/grasps/grasp_format_list.inc"
#undef GRASPBENCH_GRASP_FORMAT

/** Parses the grasps of a file, in its order; at least one.
@throws Error(kFormat, kRange, kUsage) with file and location: no part of a damaged file is used. */
std::vector<ForeignGrasp> ParseGrasps(std::string_view bytes, const std::string& file,
                                      const std::string& format, const GraspReadOptions& options);

/** Reads a file behind the fence (core/fence/fence.h), with its limits.
@throws Error(kNotFound, kIo, kEnvironment) and as ParseGrasps. */
std::vector<ForeignGrasp> ReadGrasps(const std::string& path, const std::string& format,
                                     const GraspReadOptions& options = {});

/** Makes the reader that graspbench-reader runs for ReadGrasps. */
FencedReader MakeGraspReader();

/** A file that could not be read, and why. */
struct UnreadFile {
  std::string name;
  std::string reason;
};

struct GraspCollection {
  int num_files = 0;
  std::vector<ForeignGrasp> grasps;  ///< in the order of paths, within a folder by name
  std::vector<UnreadFile> unread;    ///< lists every file that was skipped
};

/** Reads all grasps of files and folders. ForeignGrasp::source of a file in a folder is its path
relative to that folder, since two folders may each have a 0.npy. Hidden files are ignored.
@throws Error(kNotFound) for a missing path or a folder without files; Error(kIo) for a folder that
cannot be listed; Error(kEnvironment) as ReadGrasps; Error(kUsage) for an unknown format, or for a
missing option if it leaves no grasp at all. */
GraspCollection ReadGraspCollection(const std::vector<std::string>& paths,
                                    const std::string& format,
                                    const GraspReadOptions& options = {});

/** Replaces the file's path in `reason` by `name`, its name in the folder: results must not contain
paths of a machine. */
std::string NameInside(std::string reason, const std::filesystem::path& file,
                       const std::string& name);

}  // namespace graspbench
