// SIGINT and SIGTERM as a flag that long loops look at, so that what is finished can be saved.
#pragma once

namespace drude {

// Installs the handlers; a second signal of the same kind ends the process at once. A signal that
// the process was started to ignore (nohup, a background job of a script) stays ignored.
void catch_interrupts();

// Takes them off again, for work that has nothing to save: a signal ends the process at once.
void let_interrupts_end();

// The signal that arrived (SIGINT, SIGTERM), or 0.
int interrupted();

}  // namespace drude
