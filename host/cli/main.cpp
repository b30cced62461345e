// The program `hopscotch`.
#include "host/cli/commands.hpp"

int main(int argc, char** argv) { return hopscotch::run_program(argc, argv); }
