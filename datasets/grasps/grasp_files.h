#pragma once
/** @file
Files of grasps that somebody else made: one file, or all that a folder holds. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/grasps/foreign_grasp.h"
#include "datasets/grasps/grasp_format.h"

namespace graspbench {

/** The format of that id, or with "auto" the one that recognises the content.
@throws Error(kUsage) for an unknown id, Error(kFormat) where none does, naming the formats. */
const GraspFormat& FindGraspFormat(const std::string& format, std::string_view bytes,
                                   const std::string& file);

/** Grasps out of the bytes of a file, in its order; at least one.
@throws Error(kFormat, kRange, kUsage) with file and place: nothing of a damaged file is used. */
std::vector<ForeignGrasp> ParseGrasps(std::string_view bytes, const std::string& file,
                                      const std::string& format, const GraspReadOptions& options);

/** @throws Error(kNotFound, kIo) and as ParseGrasps. */
std::vector<ForeignGrasp> ReadGrasps(const std::string& path, const std::string& format,
                                     const GraspReadOptions& options = {});

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
folder that cannot be listed, Error(kUsage) for an unknown format, and for a missing option where
that leaves no grasp at all. */
GraspCollection ReadGraspCollection(const std::vector<std::string>& paths,
                                    const std::string& format,
                                    const GraspReadOptions& options = {});

/** A reason that names a file by `name`, as its folder does: results hold no path of a machine. */
std::string NameInside(std::string reason, const std::filesystem::path& file,
                       const std::string& name);

}  // namespace graspbench
