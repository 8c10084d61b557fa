// graspbench-reader: reads foreign files in a process of its own, so that a malicious or damaged one
// can neither crash, stop nor fill the program that asks (core/fence).

#include <unistd.h>

#include "core/hand/import/fenced_import.h"
#include "datasets/grasps/grasp_files.h"
#include "human_study/recording/importers/importer.h"
#include "objects/load_mesh.h"
#include "objects/read_foreign_mesh.h"

#ifdef GRASPBENCH_ADDRESS_SANITIZED
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=1024:soft_rss_limit_mb=1536:handle_abort=1";
}
#endif

int main() {
  using namespace graspbench;
  std::vector<FencedReader> readers = MakeRecordingReaders();
  readers.push_back(MakeMeshReader());
  readers.push_back(MakeGraspReader());
  readers.push_back(MakeHandReader(&LoadPictureMesh));
  ::_exit(ServeFence(readers));  // the process goes, and its memory with it
}
