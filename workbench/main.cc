#include "workbench/program.h"

int main(int argc, char** argv) { return graspbench::RunProgram(argc, argv); }
