// The command line, read: which command, with which options.
#pragma once

#include <vector>

#include "cli/command.h"

namespace drude {

// run_command_line with the commands given; "help", "completion" and "version" are added to them.
//
// The result is the exit status: what the command returned, or that of an Error's cause, its
// message printed on stderr after "drude: ". 3 also where standard output cannot be written, memory
// runs out, or the program itself is at fault; 128 + signal after an interrupt, and 141 (128 +
// SIGPIPE), silently, where whoever read standard output went away.
int run_command_line(const std::vector<Command>& commands, int argc, char** argv);

// What main() does first, once for the process: interrupts are caught (base/interrupt.h), a closed
// pipe becomes a write error, and the three standard descriptors are taken, so that no file that is
// opened later gets the number of a closed standard output.
void prepare_process();

}  // namespace drude
