#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "core/hand/load_hand.h"
#include "datasets/grasps/write_grasps.h"
#include "workbench/command.h"
#include "workbench/commands/options/foreign_grasp_options.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/tables/foreign_grasp_tables.h"

namespace graspbench {
namespace {

struct InfoRequest {
  ForeignGraspOptions grasps;
  std::string hand;
  bool json = false;
};

ExitCode ShowGrasps(const InfoRequest& request) {
  const GraspCollection collection = request.grasps.Read();
  std::vector<UnmappedGrasp> unmapped;
  Json json = request.json ? MakeJson(collection) : Json();
  std::string text = FormatGraspCollection(collection);
  if (!request.hand.empty()) {
    const Hand hand = LoadHand(request.hand);
    unmapped = FindUnmapped(collection.grasps, hand);
    json["unmapped"] = Json::array();
    text += std::to_string(collection.grasps.size() - unmapped.size()) + " of " +
            FormatCount(static_cast<int64_t>(collection.grasps.size()), "grasp") +
            " can be taken by the hand " + hand.id + "\n";
    for (const UnmappedGrasp& grasp : unmapped) {
      json["unmapped"].push_back({{"grasp", grasp.name}, {"reason", grasp.reason}});
      text += "not taken: " + grasp.name + ": " + grasp.reason + "\n";
    }
  }
  request.json ? PrintJson(json) : PrintResult(text);
  return collection.unread.empty() && unmapped.empty() ? kExitOk : kExitBadInput;
}

struct ConvertRequest {
  ForeignGraspOptions grasps;
  std::string format;
  std::string out;
};

void ConvertGrasps(const ConvertRequest& request) {
  CheckOutputFile(request.out);
  const GraspCollection collection = request.grasps.Read();
  // Half a conversion would pass for a whole one.
  if (!collection.unread.empty()) {
    throw Error(ErrorKind::kFormat, "nothing was written: " + collection.unread.front().reason);
  }
  const WrittenGrasps written = WriteGrasps(collection.grasps, request.format);
  WriteOutputFile(request.out, written.bytes);
  for (const std::string& loss : written.losses) {
    PrintMessage("warning: " + request.format + " cannot store " + loss);
  }
  PrintResult(request.out + ": " +
              FormatCount(static_cast<int64_t>(collection.grasps.size()), "grasp") + "\n");
}

}  // namespace

void AddGraspsCommand(Command& program) {
  Command& group = AddSubcommand(program, "grasps", "Read, convert and judge external grasps.",
                                 "  graspbench grasps info downloaded/\n"
                                 "  graspbench grasps info mug.npy --hand shadow");
  group.RequireSubcommand();

  const auto request = std::make_shared<InfoRequest>();
  Command& info = AddSubcommand(
      group, "info", "List the contents of grasp files and the files that cannot be read.",
      "  graspbench grasps info downloaded/\n"
      "  graspbench grasps info mug.npy --hand shadow\n"
      "  graspbench grasps info mug.yaml --hand-frame panda_hand --object-frame mesh --json");
  request->grasps.AddTo(info);
  info.AddOption("--hand", request->hand,
                 "also check that this hand can take the grasps: id or folder", "HAND");
  AddJsonOption(info, request->json);
  info.SetAction([request] { return ShowGrasps(*request); });

  const auto conversion = std::make_shared<ConvertRequest>();
  Command& convert =
      AddSubcommand(group, "convert", "Write grasps in the format of another tool.",
                    "  graspbench grasps convert mug.npy --to isaac --out mug.yaml\n"
                    "  graspbench grasps convert downloaded/mug/ --to dexgraspbench --out mug.npy");
  conversion->grasps.AddTo(convert);
  convert.AddRequired("--to", conversion->format, "one of " + ListNames(ListWrittenFormats()),
                      "NAME");
  convert.AddRequired("--out", conversion->out, "new file", "FILE");
  convert.SetAction([conversion] { ConvertGrasps(*conversion); });
}

}  // namespace graspbench
