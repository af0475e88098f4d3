#include "cli/command.h"
#include "cli/parser.h"

int main(int argc, char** argv) {
    drude::prepare_process();
    return drude::run_command_line(argc, argv);
}
