// Writes the page of what is measured:   write_validation ROWS-FOLDER PAGE
// The target `validation` calls it for workbench/manual.

#include <cstdio>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/physics/sim_config.h"
#include "tests/validation/validation_page.h"

int main(int argc, char** argv) {
  using namespace graspbench;
  if (argc != 3) {
    std::fprintf(stderr, "write_validation: two arguments are needed: ROWS-FOLDER PAGE\n");
    return kExitUsage;
  }
  try {
    Diagnostics problems;
    const std::vector<ValidationRow> rows = LoadValidationRows(argv[1], problems);
    problems.ThrowIfErrors(ErrorKind::kFormat, "the page is not written");
    WriteFileAtomically(argv[2], FormatValidationPage(rows, kPhysicsVersion));
  } catch (const Error& error) {
    std::fprintf(stderr, "write_validation: %s\n", error.what());
    return ExitCodeOf(error.kind());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_validation: %s\n", error.what());
    return kExitEnvironment;
  }
  return kExitOk;
}
