// The commands of an SCPI instrument in a bench file.
//
//   "scpi": {"psi_delta": "READ:ELL?", "angle": "SOUR:ANG {} DEG", "next_error": "",
//            "setup": ["FORM REAL,64"], "format": "real64", "measure_s": 600}
//
// Keys are the members of ScpiCommands (scpi_commands.h); what is not given keeps its default, and
// an empty string is a command that the instrument does not need where that is allowed there.
#pragma once

#include "device/instruments/scpi_commands.h"
#include "materials/json_tree.h"

namespace drude {

// Throws Error (user) with file:line:column: unknown keys and formats with the nearest one, a
// question that is empty, a command whose value has no {} to go to, and times that are no times.
ScpiCommands read_scpi_commands(const JsonValue& object);

}  // namespace drude
