// The program `brushfire`: every verb is described in the file of its name.
#include "command_line.h"

int main(int argc, char** argv) {
  brushfire::tool::CommandLine command_line;
  brushfire::tool::add_verbs(command_line);
  return command_line.run(argc, argv);
}
