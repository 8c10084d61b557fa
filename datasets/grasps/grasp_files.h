#pragma once
/** @file
Grasps that somebody else made, out of one file or of all that a folder holds; and the formats of
such files: one file `<id>_grasps.cc` and one line of grasp_format_list.inc each.

A grasp is kept as its file states it: what every reader gives and every protocol takes. Frames: R
is the hand's root link as the file's hand has it, O the object as its mesh is drawn (after
scaling). Nothing here is converted to a hand of graspbench; map_to_hand.h does that. */

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/pose.h"
#include "core/fence/serve_fence.h"

namespace graspbench {

/** Where root and joints are at one stage, in the order in which the hand goes through them. */
struct GraspStage {
  std::string name;            ///< "pregrasp", "grasp", "squeeze"
  Pose X_OR;                   ///< [m]
  std::vector<double> joints;  ///< by ForeignGrasp::joint_names [rad], of a prismatic joint [m]
};

struct ForeignGrasp {
  std::string source;                    ///< the file's name without its folder
  int index = 0;                         ///< of the grasp in its file, from 0
  std::string format;                    ///< id of the reader
  std::string hand;                      ///< as the file names it; empty: it does not
  std::string root_link;                 ///< R; empty: the file does not say
  std::vector<std::string> joint_names;  ///< of the file's hand, in the file's order
  std::string object;                    ///< the file's path or name of the mesh
  double scale = 1.0;                    ///< of the mesh as drawn
  Pose X_WO = Pose::Identity();          ///< in the file's world
  std::vector<GraspStage> stages;        ///< at least one
  std::optional<bool> label;             ///< the file's own verdict
  std::vector<std::string> assumptions;  ///< what the file does not say and was taken for granted
};

/** What a file does not say, or what must not be taken from it. */
struct GraspReadOptions {
  std::string hand_frame;                ///< link of the hand whose pose the file gives
  std::string object_frame;              ///< "mesh": poses are given in it; empty: not said
  std::vector<std::string> joint_names;  ///< of a file that lists positions without names
  std::optional<double> scale;           ///< of the object's mesh
  /** Positions of an open hand, for files that state none [rad], of a prismatic joint [m]. */
  std::vector<std::pair<std::string, double>> open_joints;
};

struct GraspFormat {
  const char* id;
  const char* title;
  /** Looks at the whole file; a file may be damaged behind what is looked at. */
  bool (*recognises)(std::string_view bytes);
  /** @param file  the file's name in messages and, without folder, in the records.
  @throws Error(kFormat, kRange, kUsage) with the place. */
  std::vector<ForeignGrasp> (*read)(std::string_view bytes, const std::string& file,
                                    const GraspReadOptions& options);
};

/** In the order in which content is tried. */
const std::vector<GraspFormat>& ListGraspFormats();

#define GRASPBENCH_GRASP_FORMAT(Name) GraspFormat Make##Name##GraspFormat();
#include "datasets/grasps/grasp_format_list.inc"
#undef GRASPBENCH_GRASP_FORMAT

/** Grasps out of the bytes of a file, in its order; at least one.
@throws Error(kFormat, kRange, kUsage) with file and place: nothing of a damaged file is used. */
std::vector<ForeignGrasp> ParseGrasps(std::string_view bytes, const std::string& file,
                                      const std::string& format, const GraspReadOptions& options);

/** Reads behind the fence (core/fence/fence.h), with its limits.
@throws Error(kNotFound, kIo, kEnvironment) and as ParseGrasps. */
std::vector<ForeignGrasp> ReadGrasps(const std::string& path, const std::string& format,
                                     const GraspReadOptions& options = {});

/** Of graspbench-reader: what ReadGrasps does there. */
FencedReader MakeGraspReader();

/** A file that could not be read, and why. */
struct UnreadFile {
  std::string name;
  std::string reason;
};

struct GraspCollection {
  int num_files = 0;
  std::vector<ForeignGrasp> grasps;  ///< in the order of the paths, within a folder of the names
  std::vector<UnreadFile> unread;    ///< nothing is skipped without a line here
};

/** All grasps of files and folders. ForeignGrasp::source of a file below a folder is its path from
there: two folders may each have a 0.npy. Files whose name begins with a point are no grasps.
@throws Error(kNotFound) for a path that is not there or a folder without files, Error(kIo) for a
folder that cannot be listed, Error(kEnvironment) as ReadGrasps, Error(kUsage) for an unknown
format, and for a missing option where that leaves no grasp at all. */
GraspCollection ReadGraspCollection(const std::vector<std::string>& paths,
                                    const std::string& format,
                                    const GraspReadOptions& options = {});

/** A reason that names a file by `name`, as its folder does: results hold no path of a machine. */
std::string NameInside(std::string reason, const std::filesystem::path& file,
                       const std::string& name);

}  // namespace graspbench
