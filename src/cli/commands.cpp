#include "cli/command_list.h"

namespace drude {

const std::vector<Command>& commands() {
    // The order of the help page: from a measurement to the report, then what can be listed.
    static const std::vector<Command> all = {
        eval_command(),      simulate_command(), capture_command(), reduce_command(),
        convert_command(),   fit_command(),      render_command(),  merge_command(),
        compare_command(),   tonemap_command(),  view_command(),    regress_command(),
        reproduce_command(), report_command(),   bench_command(),   materials_command(),
        devices_command(),
    };
    return all;
}

}  // namespace drude
