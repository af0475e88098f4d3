// One function a command; each stands in the command's own file and is listed in commands.cpp.
#pragma once

#include "cli/command.h"

namespace drude {

Command eval_command();
Command simulate_command();
Command capture_command();
Command reduce_command();
Command convert_command();
Command fit_command();
Command render_command();
Command merge_command();
Command compare_command();
Command tonemap_command();
Command view_command();
Command regress_command();
Command reproduce_command();
Command report_command();
Command bench_command();
Command materials_command();
Command devices_command();

}  // namespace drude
