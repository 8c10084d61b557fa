#include <signal.h>
#include <unistd.h>

#include "workbench/experiments/pool/worker_pool.h"
#include "workbench/program.h"

int main(int argc, char** argv) {
  ::signal(SIGXFSZ, SIG_IGN);  // writing beyond a limit of the file size fails as on a full disk
  const int exit_code = graspbench::RunProgram(argc, argv);
  if (graspbench::HasAbandonedTasks()) ::_exit(exit_code);
  return exit_code;
}
