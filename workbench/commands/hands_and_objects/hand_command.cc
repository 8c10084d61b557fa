#include <memory>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/import/write_hand.h"
#include "core/hand/load_hand.h"
#include "core/trial/measures/grasp_types.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/pictures/trial_picture.h"
#include "workbench/tables/grasp_tables.h"
#include "workbench/tables/hand_tables.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

ExitCode CheckHandCommand(const std::string& path, bool json) {
  Diagnostics problems;
  const Hand hand = CheckHand(path, problems);
  if (problems.num_errors() == 0) {
    try {
      for (const Grasp& grasp : LoadStandardGrasps(hand)) {
        for (const std::string& fault : ListTypeFaults(hand, grasp)) problems.Warn(path, 0, fault);
        if (grasp.held_share == 0.0) {
          problems.Warn(path, 0, grasp.id + ": held none of the unseen shapes of its development");
        }
      }
    } catch (const Error& error) {
      problems.Fail(path, 0, error.what());
    }
  }
  std::vector<ContactFit> fits, picture;  // of an import against its description's shapes
  if (problems.num_errors() == 0) {
    fits = ReadContactFits(path);
    picture = MeasureContact(hand);
  }
  const bool is_imported = !fits.empty();
  const std::string off = DescribeCoarseContact(picture, "the picture");
  const std::string coarse =
      is_imported ? DescribeCoarseContact(fits, "the description's shapes") : off;
  const std::string thin = DescribeThinSelfContact(is_imported ? fits : picture);
  for (const std::string& told : {coarse, thin}) {
    if (!told.empty()) problems.Warn(path, 0, told);
  }
  if (json) {
    PrintJson({{"usable", problems.num_errors() == 0},
               {"problems", MakeJson(problems)},
               {"contact", MakeContactJson(is_imported ? fits : picture)},
               {"picture", MakeContactJson(picture)}});
  } else {
    PrintFindings(problems);
    PrintResult(path + ": " + (problems.num_errors() == 0 ? "can be used" : "cannot be used") +
                FormatFindingCounts(problems) + "\n" + FormatContact(is_imported ? fits : picture));
    if (is_imported && !off.empty()) {
      PrintResult("Visual and contact shapes of the description differ: " + off + "\n");
    }
  }
  return problems.num_errors() == 0 ? kExitOk : kExitBadInput;
}

void ShowGrasps(const Hand& hand, const std::string& csv) {
  const std::vector<Grasp> grasps = LoadStandardGrasps(hand);
  const std::vector<GraspNumber> numbers = ListGraspNumbers(hand, grasps);
  if (!csv.empty()) WriteOutputFile(csv, FormatGraspCsv(numbers));
  PrintResult(FormatGraspNumbers(grasps, numbers) + (csv.empty() ? "" : "\n" + csv + "\n"));
}

}  // namespace

void AddHandCommand(Command& program) {
  Command& group = AddSubcommand(program, "hand", "Show and check hands.",
                                 "  graspbench hand list\n"
                                 "  graspbench hand check my_hand/");
  group.RequireSubcommand();
  const auto id = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  const auto add = [&](const char* name, const char* description, const char* examples) {
    Command& command = AddSubcommand(group, name, description, examples);
    AddJsonOption(command, *json);
    return &command;
  };
  const auto add_hand = [&](Command* command) {
    command->AddRequired("hand", *id, "id, or folder with hand.urdf and hand.yaml", "HAND");
  };

  Command* list = add("list", "List the hands of the program.",
                      "  graspbench hand list\n"
                      "  graspbench hand list --json");
  list->SetAction([json] {
    const DescribedHands hands = DescribeHands();
    *json ? PrintJson(hands.json) : PrintResult(hands.table);
  });

  Command* show = add("show", "Show joints, limits, drives and grasps of a hand.",
                      "  graspbench hand show shadow\n"
                      "  graspbench hand show my_hand/ --render my_hand.png --shapes --axes\n"
                      "  graspbench hand show tum --grasps --csv grasps.csv\n"
                      "  graspbench hand show my_hand/ --json");
  add_hand(show);
  const auto picture = std::make_shared<std::string>();
  const auto parts = std::make_shared<HandPictureParts>();
  Option* render =
      show->AddOption("--render", *picture, "also draw the hand into a new PNG file", "FILE");
  show->AddFlag("--shapes", parts->has_shapes,
                "with --render: also the contact shapes, inside transparent links and alone")
      ->Needs(render);
  show->AddFlag("--axes", parts->has_axes,
                "with --render: also the joint axes as arrows inside transparent links")
      ->Needs(render);
  const auto grasps = std::make_shared<bool>(false);
  const auto csv = std::make_shared<std::string>();
  Option* show_grasps =
      show->AddFlag("--grasps", *grasps,
                    "show placement, pre-grasp and target posture of all standard grasps instead");
  show->AddOption("--csv", *csv, "also write those numbers into a new file", "FILE")
      ->Needs(show_grasps);
  show_grasps->Excludes("--json");
  show->SetAction([id, picture, parts, grasps, csv, json] {
    const auto hand = std::make_shared<const Hand>(LoadHand(*id));
    if (*grasps) return ShowGrasps(*hand, *csv);
    if (!picture->empty()) CheckOutputFile(*picture);
    if (!picture->empty()) WriteFileAtomically(*picture, EncodePng(DrawHand(hand, *parts)));
    *json ? PrintJson(MakeHandJson(*hand)) : PrintResult(FormatHand(*hand));
    if (!*json && !picture->empty()) {
      PrintResult("\n" + *picture + ": " + DescribeHandPicture(*parts));
    }
  });

  Command* check =
      add("check", "Check a hand: problems with file and line, and the contact fit of each link.",
          "  graspbench hand check my_hand/\n"
          "  graspbench hand check my_hand/ --json");
  add_hand(check);
  check->SetAction([id, json] { return CheckHandCommand(*id, *json); });
}

}  // namespace graspbench
