#include "datasets/grasps/grasp_files.h"

#include <algorithm>
#include <system_error>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/fence/fence.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

/** The file itself, or the files of a folder by name. */
std::vector<fs::path> ListFiles(const std::string& path) {
  if (!fs::exists(path)) {
    throw Error(ErrorKind::kNotFound, path + ": there is no such file or folder");
  }
  std::error_code broken;
  if (!fs::is_directory(path, broken)) return {path};
  std::vector<fs::path> files;
  std::error_code fault;
  fs::recursive_directory_iterator entry(path, fault);
  for (const fs::recursive_directory_iterator end; !fault && entry != end; entry.increment(fault)) {
    std::error_code none;  // of a link that leads nowhere; reading it says so
    if (!entry->is_directory(none) && entry->path().filename().string().front() != '.') {
      files.push_back(entry->path());
    }
  }
  if (fault) throw Error(ErrorKind::kIo, path + " cannot be listed: " + fault.message());
  if (files.empty()) throw Error(ErrorKind::kNotFound, path + " is a folder without files");
  std::sort(files.begin(), files.end());
  return files;
}

void OpenHand(const GraspReadOptions& options, ForeignGrasp& grasp) {
  std::vector<double> positions;
  for (const auto& [name, position] : options.open_joints) {
    grasp.joint_names.push_back(name);
    positions.push_back(position);
  }
  for (GraspStage& stage : grasp.stages) stage.joints = positions;
}

/** The format of that id, or with "auto" the one that recognises the content.
@throws Error(kUsage) for an unknown id, Error(kFormat) where none does, naming the formats. */
const GraspFormat& FindGraspFormat(const std::string& format, std::string_view bytes,
                                   const std::string& file) {
  std::vector<std::string> known;
  std::string list;
  for (const GraspFormat& candidate : ListGraspFormats()) {
    if (format == "auto" ? candidate.recognises(bytes) : format == candidate.id) return candidate;
    known.emplace_back(candidate.id);
    list += (list.empty() ? "" : ", ") + std::string(candidate.id);
  }
  if (format == "auto") {
    throw Error(ErrorKind::kFormat,
                file + (bytes.empty() ? " is empty" : " is a file of no known format of grasps") +
                    "; known: " + list + ". --format NAME reads it as one of them");
  }
  known.emplace_back("auto");
  throw Error(ErrorKind::kUsage,
              "there is no format of grasps \"" + format + "\"" + SuggestNames(format, known));
}

}  // namespace

std::string NameInside(std::string reason, const std::filesystem::path& file,
                       const std::string& name) {
  const std::string path = file.string();
  for (size_t at = reason.find(path); at != std::string::npos; at = reason.find(path, at)) {
    reason.replace(at, path.size(), name);
    at += name.size();
  }
  return reason;
}

const std::vector<GraspFormat>& ListGraspFormats() {
  static const std::vector<GraspFormat> formats = {
#define GRASPBENCH_GRASP_FORMAT(Name) Make##Name##GraspFormat(),
#include "datasets/grasps/grasp_format_list.inc"
#undef GRASPBENCH_GRASP_FORMAT
  };
  return formats;
}

std::vector<ForeignGrasp> ParseGrasps(std::string_view bytes, const std::string& file,
                                      const std::string& format, const GraspReadOptions& options) {
  const GraspFormat& found = FindGraspFormat(format, bytes, file);
  std::vector<ForeignGrasp> grasps = found.read(bytes, file, options);
  if (grasps.empty()) throw Error(ErrorKind::kFormat, file + " holds no grasp");
  const std::string name = std::filesystem::path(file).filename().string();
  for (size_t i = 0; i < grasps.size(); ++i) {
    grasps[i].source = name;
    grasps[i].index = static_cast<int>(i);
    grasps[i].format = found.id;
    if (grasps[i].joint_names.empty()) OpenHand(options, grasps[i]);
  }
  return grasps;
}

template <class Values>
void CrossMembers(Values& values, GraspStage& stage) {
  Cross(values, stage.name, stage.X_OR, stage.joints);
}

template <class Values>
void CrossMembers(Values& values, ForeignGrasp& grasp) {
  Cross(values, grasp.source, grasp.index, grasp.format, grasp.hand, grasp.root_link,
        grasp.joint_names, grasp.object, grasp.scale, grasp.X_WO, grasp.stages, grasp.label,
        grasp.assumptions);
  if constexpr (Values::kIsIncoming) {
    values.Check(!grasp.stages.empty());
    for (const GraspStage& stage : grasp.stages) {
      values.Check(stage.joints.size() == grasp.joint_names.size());
    }
  }
}

template <class Values>
void CrossMembers(Values& values, GraspReadOptions& options) {
  Cross(values, options.hand_frame, options.object_frame, options.joint_names, options.scale,
        options.open_joints);
}

FencedReader MakeGraspReader() {
  return {"grasps",
          [](const FencedInput& input, IncomingValues& arguments, OutgoingValues& answer) {
            std::string format;
            GraspReadOptions options;
            Cross(arguments, format, options);
            std::vector<ForeignGrasp> grasps =
                ParseGrasps(ReadFile(input.path()), input.name(), format, options);
            Cross(answer, grasps);
          }};
}

std::vector<ForeignGrasp> ReadGrasps(const std::string& path, const std::string& format,
                                     const GraspReadOptions& options) {
  return Fence::Shared().Read<std::vector<ForeignGrasp>>(
      "grasps", FencedFile(std::filesystem::path(path)), nullptr, kReaderSeconds, format, options);
}

GraspCollection ReadGraspCollection(const std::vector<std::string>& paths,
                                    const std::string& format, const GraspReadOptions& options) {
  if (format != "auto") FindGraspFormat(format, "", "");
  GraspCollection collection;
  std::optional<Error> missing_option;
  for (const std::string& path : paths) {
    for (const fs::path& file : ListFiles(path)) {
      ++collection.num_files;
      const std::string name = fs::is_directory(path)
                                   ? file.lexically_relative(path).generic_string()
                                   : file.filename().string();
      try {
        for (ForeignGrasp& grasp : ReadGrasps(file.string(), format, options)) {
          grasp.source = name;
          collection.grasps.push_back(std::move(grasp));
        }
      } catch (const Error& error) {
        if (error.kind() == ErrorKind::kEnvironment) throw;  // it says nothing of the file
        collection.unread.push_back({name, NameInside(error.what(), file, name)});
        if (error.kind() == ErrorKind::kUsage && !missing_option) missing_option = error;
      }
    }
  }
  if (collection.grasps.empty() && missing_option) throw Error(*missing_option);
  return collection;
}

}  // namespace graspbench
