#include <unistd.h>

#include "workbench/experiments/pool/worker_pool.h"
#include "workbench/program.h"

int main(int argc, char** argv) {
  const int exit_code = graspbench::RunProgram(argc, argv);
  if (graspbench::HasAbandonedTasks()) ::_exit(exit_code);
  return exit_code;
}
