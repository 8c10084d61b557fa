#pragma once
/** @file
Descriptions of hands in files, imported and loaded again as a user does. */

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "core/base/files/files.h"
#include "core/hand/import/import_hand.h"
#include "core/hand/load_hand.h"
#include "core/shape/obj_file.h"
#include "tests/support/shared_data.h"

namespace graspbench {

/** "claw.urdf" among the right descriptions of testdata; "maker/hand.urdf" among the published
hands, which a machine may lack. */
inline std::filesystem::path FindDescription(const std::string& name) {
  return name.find('/') == std::string::npos
             ? FindDataRoot() / "tests/core/hand/import/testdata/right" / name
             : FindSharedData() / "hands" / name;
}

/** Meshes are OBJ files. @param covers  packs the links with balls, in a second or so each. */
inline HandSource MakeFileSource(const std::filesystem::path& file, bool covers = false) {
  HandSource source;
  if (!covers) source.num_cover_points = 0;
  source.file = file.string();
  source.folder = file.parent_path();
  source.load_mesh = [](const std::filesystem::path& path) {
    Diagnostics problems;
    const TriMesh mesh = ParseObj(ReadFile(path), path.string(), problems);
    problems.ThrowIfErrors(ErrorKind::kFormat, "broken");
    return mesh;
  };
  return source;
}

/** The imported hand as the loader has it, written to a folder; it must load without a problem. */
inline Hand WriteAndLoad(const ImportedFiles& imported) {
  const std::filesystem::path out =
      std::filesystem::path(testing::TempDir()) / ("imported_hand_" + std::to_string(::getpid()));
  std::filesystem::remove_all(out);
  for (const auto& [name, content] : imported.files) {
    MakeFolder((out / name).parent_path());
    WriteFile(out / name, content);
  }
  Diagnostics problems;
  const Hand hand = CheckHand(out.string(), problems);
  EXPECT_EQ(problems.Format(), "");
  std::filesystem::remove_all(out);
  return hand;
}

}  // namespace graspbench
